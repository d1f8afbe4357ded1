"""Errors about settings and arguments; files have their own table."""

from __future__ import annotations

from niwaki.errors.texts.guides import GUIDES
from niwaki.errors.texts.message import Message
from niwaki.errors.texts.views import VIEWS

INPUTS = (
    *VIEWS,
    *GUIDES,
    Message(
        "no-cell-filled",
        "no cell of the grid is filled by `{path}`",
        why="the mesh is smaller than one cell, or empty inside",
        help="make the cells smaller than {size}, or scale the mesh up",
        example="voxel_size=10 for a mesh of size 1",
        cure="voxel_size=0.05",
    ),
    Message(
        "too-many-cells",
        "a grid of {found} cells is too large",
        help="make the cells larger than {size}, or scale the mesh down",
        example="voxel_size=0.0001 for a mesh of size 100",
        cure="voxel_size=0.5",
    ),
    Message(
        "too-many-runs",
        "the model has more runs than can be listed",
        why="enumeration visits every one",
        help="make the model smaller, raise the limit, or use `smc` or `importance`",
        example="run(model, method=enumerate_all()) with 40 flips",
        cure="run(model, method=importance(1000))",
    ),
    Message(
        "rejection-budget",
        "rejection accepted too few runs",
        why="most runs of the model are rejected",
        help="use `smc` or `importance`, or loosen the conditions",
        example="condition(x == 0.5) for a gaussian x",
        cure="observe(Gaussian(x, 0.1), 0.5)",
    ),
    Message(
        "rejection-bound",
        "a run scores above the bound of rejection",
        why="rejection is only correct if no run scores above its bound",
        help="raise the bound to the greatest score that a run can have",
        example="rejection(bound=0) of a model with factor(1)",
        cure="rejection(bound=1)",
    ),
    Message(
        "unknown-setting",
        "there is no setting `{name}`",
        help="{suggestion}",
        example="grow(ship, target, particels=300)",
        cure="grow(ship, target, particles=300)",
    ),
    Message(
        "everything-impossible",
        "every run is impossible",
        why="at {barrier}, all {count} runs had a score of minus infinity because of {constraint}",
        help="{cure}",
        example="niwaki grow tower.py:tower --floor 1        # the tower's first block stands at y = 0",
        cure="niwaki grow tower.py:tower --floor 0",
        about=(
            "A constraint forbids a scene: its score is then minus infinity, which no other part makes good. Every run that "
            "was tried broke one, so that there is no result. The message says which constraint it was, how often, and which "
            "parts broke it most often, with their lines.\n\n"
            "| constraint | what forbids a scene | what helps |\n| --- | --- | --- |\n"
            "| `floor` | a part reaches below the height | a lower `--floor`, or a model that starts above it |\n"
            "| `avoid` | a part reaches into the obstacle | another place to start, a smaller obstacle |\n"
            "| `no_self_intersection` | two primitives overlap | one `emit` for parts that belong together, a distance "
            "between others, or `--rule surface` |\n"
            "| `condition`, `factor`, `observe` | the model's own | a condition that more runs meet, or a `factor` in its "
            "place, which only lowers the score |\n\n"
            "Where the first part of every run breaks the constraint, more particles change nothing. Where runs become "
            "impossible later, one after the other, more particles (`-n`) or futures can help."
        ),
    ),
    Message(
        "weights-of-runs",
        "samples of {runs} separate runs have no common weights",
        why="a particle's weight is relative to its own population",
        help="use `smc(particles, populations=n)`, which weighs its populations by their evidence, or look at each run",
        example="grow(ship, target, runs=4).weights",
        cure="run(ship, smc(300, populations=4), sketch=target).weights",
    ),
    Message(
        "not-enumerable",
        "not every choice of the model can be listed",
        why="an exact answer visits every value of every choice, so each choice needs a finite list of values",
        help="use `smc`, `importance` or `rejection` instead of `enumerate_all`",
        example="run(model, method=enumerate_all()) with a gaussian",
        cure="run(model, method=importance(1000))",
    ),
    Message(
        "sketch-without-slope",
        "the score of the scene has no gradient",
        why="sketches count cells and pixels, and a count has no slope",
        help="use `mh()` or particles for it, or describe with `factor` in the model what the shapes should be like",
        example="log_density(grow(ship, target).best)",
        cure="log_density(run(ship).best)",
    ),
    Message(
        "no-continuous-choices",
        "this run makes no continuous choices",
        why="a gradient moves real numbers, and every choice of this run is discrete",
        help="use a method for discrete choices, such as `enumerate_all` or particles",
        example="log_density of a model of flips",
        cure="log_density of a model with a gaussian",
    ),
    Message(
        "no-normal-fits",
        "a normal distribution does not suit `{name}`",
        why="a normal is over the same real numbers in every run, and this model {found}",
        help="use `smc()`, with a guide of `train_guide` as its `proposal` where it should learn, or `mh()`",
        example="run(tree, method=vi())",
        cure="run(tree, method=smc())",
    ),
    Message(
        "out-of-time",
        "the search had no result within its time",
        help="give it more time or fewer particles",
        example="budget of 0.001 s",
        cure="budget of 10 s",
    ),
    Message(
        "model-arguments",
        "`{name}` takes {expected}, found {found}",
        help="its parameters are {parameters}",
        example="run(tree, (1, 2, 3))",
        cure="run(tree, (1,))",
    ),
    Message(
        "argument-value",
        "argument {number} of `{name}` is {found}, which cannot be a value of a model",
        help="pass numbers, strings, tuples, lists, dicts with constant keys, arrays, vectors, shapes or records",
        example="run(tree, (open('x'),))",
        cure="run(tree, (3,))",
    ),
    Message(
        "model-of-a-value",
        "a model is a Python function, found {found}",
        help="write `@model` above a `def`",
        example="model(3)",
        cure="@model\ndef ship():\n    ...",
    ),
    Message(
        "no-source-file",
        "the source of `{name}` cannot be read",
        why="a model is compiled from its text",
        help="keep it in a file; a function that was typed at the prompt or created by `exec` has no text",
        example="a model typed at Python's prompt",
        cure="the same model in ship.py",
    ),
    Message(
        "outside-a-model",
        "`{word}` is used outside of a model",
        why="only a run of a model can make choices, add scores and add shapes",
        help="put it into a function with `@model` and run that function",
        example="x = gaussian(0, 1)",
        cure="@model\ndef m():\n    return gaussian(0, 1)",
    ),
    Message(
        "missing-choice",
        'no choice was given for "{address}"',
        why="the nearest addresses given are {nearest}",
        help="add it to `choices`, or give a seed to draw the missing choices",
        example="run_python(ship, choices={})",
        cure="run_python(ship, choices={}, seed=1)",
    ),
    Message(
        "nothing-offered",
        "the last drag has not offered this difference",
        why="only a change that was found for the text of the file can be written",
        help="drag the part again, and accept what is offered then",
        example="one.ask('rewrite', difference='...')",
        cure="one.ask('rewrite', difference=dragged['offers'][0]['difference'])",
    ),
    Message(
        "edited-meanwhile",
        "`{path}` has changed since this difference was found, and was not written",
        why="a change is written only into the text that it was found for",
        help="drag the part again",
        example="change.apply()   # after an edit of the file",
        cure="dragging.source(to)[0].apply()",
    ),
    Message(
        "no-part",
        "`{pattern}` matches no part of `{name}`",
        why="a part is a call or an iteration of a loop with choices; a pattern without `/` is compared with the last part of "
        "an address, any other with the whole address",
        help="the nearest are {parts}",
        example='result.regrow("wnig[1]")',
        cure='result.regrow("wing[1]")',
    ),
    Message(
        "many-parts",
        "`{pattern}` matches several parts of `{name}`",
        why="one part is grown again in place, with all the others as they are",
        help="name one of {parts}",
        example='result.regrow("wing[*]")',
        cure='result.regrow("wing[1]")',
    ),
)
