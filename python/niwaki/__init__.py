"""Niwaki grows procedural models into the shapes you ask for.

A model is a Python function:

    model                                       marks it
    sample, flip, uniform, gaussian             make a random choice
    condition, factor, observe                  forbid a run, weigh it, score it by data
    emit, box, cylinder, vec                    add shapes to the scene, at points
    future, force                               leave a call for later, and wait for its value
    mem                                         call a function once for each value of its arguments

Searching a model:

    grow, run                                   grow a model into a target; run a model by any method
    smc                                         method: particles
    ais                                         method: particles on a ladder from the prior to the posterior
    mh, hmc, nuts                               methods: Markov chains; those that follow the gradient
    vi                                          method: a normal near the model's distribution, and weighed draws
    kernels                                     the kernels of Markov chains
    batch                                       many searches on all processors, or on many machines
    train_guide, Guide                          a network that has learnt which choices lead where
    Checkpoint                                  where a search keeps what it needs to go on after a kill
    Search                                      what `grow` and `run` run, as a value: JSON, a hash

What a scene should be like:

    Target, match_volume                        a mesh, and the score for filling it
    Camera, match_image                         a point of view, and the score for a silhouette from there
    match_drawing, fill_drawing                 scores of what a scene draws in the plane
    no_self_intersection                        score: parts must not overlap

The results of a search:

    Result, Sample                              all runs, and one: its value, choices, scores, picture, files
    view                                        results to turn, in a notebook or as a page of one file
    run_python                                  one run as plain Python, for a debugger
    doctor                                      what is installed, what works, what is missing for what

Everything else:

    niwaki.words      what a model may use: distributions as values, colours, vectors, polygons, soft constraints
    niwaki.methods    all methods and their settings
    niwaki.targets    what a scene should match
    niwaki.batches    batches: their folders, and their results
    niwaki.guides     training guides, and those that come with the package
    niwaki.result     results, diagnostics, gradients
    niwaki.draw       scenes as pictures and files
    niwaki.gallery    models
    niwaki.errors     every error
    niwaki.stacks     structures of blocks that stand
    niwaki.notebook   results to turn, in a notebook or as a page of one file
    niwaki.letters    words in vines or lightning
    niwaki.color      colours for drawings

Every name is imported when it is first used; `__init__.pyi` lists them all.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
