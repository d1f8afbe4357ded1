"""Niwaki grows procedural models into the shapes you ask for.

A model is a Python function that makes random choices and adds shapes to a scene. A search finds runs of the model
whose scenes match a target:

    import niwaki as nw

    @nw.model
    def tower():
        for level in range(nw.discrete_uniform(2, 8)):
            size = nw.uniform(0.5, 2.0)
            nw.emit(nw.box((0.0, level + 0.5, 0.0), (size, 1.0, size)))

    result = nw.grow(tower, "vase.obj", seed=1)
    result.best.save("tower.png")
    result.best.export("tower.glb")

The names that you meet first:

    model                             marks a function as a model
    uniform, gaussian, flip, choose   draw a random choice
    box, cylinder, emit               make shapes, and add them to the scene
    future                            postpones a call, so that the search can choose the order
    condition, factor, observe        forbid a run, or change its score
    Target, Camera                    a mesh to fill, and a point of view
    match_volume, match_image         score a scene against a mesh or a picture
    grow, run                         search for a target, or by any method
    smc, mh, hmc                      methods: particles and Markov chains
    Result, Sample                    all runs that a search returns; one run, with its picture and files
    batch, view, doctor               many searches; results to turn; a check of the installation

`help(niwaki.grow)` explains a name, and `dir(niwaki)` lists all names. `niwaki.words` has all words for models,
`niwaki.gallery` has models to start from. The manual is in the project's folder `docs` and begins with `docs/index.md`.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
