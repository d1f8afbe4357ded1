"""Niwaki grows procedural models into the shapes you ask for.

A model is a Python function marked with `@model`. It may use:

    sample, flip, uniform, gaussian, ...        make a random choice
    condition, factor, observe                  forbid a run, weigh it, score it by data
    softeq, soft_at_least, soft_at_most         scores of numbers that should agree or be in order
    emit                                        add shapes to the scene
    box, cylinder, limb, segment, mesh          shapes
    vec, dot, cross, norm, rotate, ...          vectors
    future, force                               leave a call for later, and wait for its value
    infer                                       search another model

Searching a model:

    grow                                        grow a model into a target
    run                                         run a model by any method
    Search                                      what `grow` and `run` run, as a value: JSON, a hash
    smc, particle_gibbs, pimh                   methods: particles
    mh, kernels                                 methods: Markov chains and their kernels
    hmc, nuts, explore                          methods: chains that follow the gradient
    enumerate_all, rejection, importance        methods: exact answers, and independent runs

What a scene should be like:

    Target, Receiver, Camera                    a mesh to fill, a surface for shadows, a point of view
    match_volume, match_image, match_shadow     scores: fill a volume, have a silhouette, cast a shadow
    no_self_intersection, avoid, floor          scores: what a scene must not do

The results of a search:

    Result, Sample                              all runs, and one: its value, choices, scores, picture, files
    residuals                                   how far soft constraints are from holding
    log_density                                 a run as a function of its numbers, with its gradient
    diagnostics                                 whether draws of chains can be trusted
    run_python                                  one run as plain Python, for a debugger

Every name is imported when it is first used; `__init__.pyi` lists them all.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
