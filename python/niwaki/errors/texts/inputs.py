"""Errors about settings and arguments; the table of files is `files`."""

from __future__ import annotations

from niwaki.errors.texts.guides import GUIDES
from niwaki.errors.texts.message import Message
from niwaki.errors.texts.views import VIEWS

INPUTS = (
    *VIEWS,
    *GUIDES,
    Message(
        "no-cell-filled",
        "`{path}` fills no cell of the grid",
        why="the mesh is smaller than one cell, or empty inside",
        help="make the cells smaller than {size}, or scale the mesh up",
        example="grow(ship, target, voxel=10)   # a target of size 1",
        cure="grow(ship, target, voxel=0.05)",
    ),
    Message(
        "too-many-cells",
        "a grid of {found} cells is too large",
        help="make the cells larger than {size}, or scale the mesh down",
        example="grow(ship, target, voxel=0.0001)   # a target of size 100",
        cure="grow(ship, target, voxel=0.5)",
    ),
    Message(
        "too-many-runs",
        "the model has more runs than can be listed",
        why="enumeration visits every run",
        help="make the model smaller, raise the limit, or use `smc` or `importance`",
        example="run(model, method=enumerate_all())   # a model of 40 flips",
        cure="run(model, method=importance(1000))",
    ),
    Message(
        "rejection-budget",
        "rejection accepted too few runs",
        why="most runs of the model are rejected",
        help="use `smc` or `importance`, or loosen the conditions",
        example="x = gaussian(0, 1)\ncondition(x == 0.5)",
        cure="x = gaussian(0, 1)\nobserve(Gaussian(x, 0.1), 0.5)",
    ),
    Message(
        "rejection-bound",
        "a run scores above the bound of rejection",
        why="rejection is correct only if no run scores above its bound",
        help="raise the bound to the greatest score that a run can have",
        example="run(model, method=rejection(bound=0))   # a model with factor(1)",
        cure="run(model, method=rejection(bound=1))",
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
        "every run of the search is impossible",
        why="at {barrier}, all {count} runs had a score of minus infinity because of {constraint}",
        help="{cure}",
        example="niwaki grow tower.py:tower --floor 1        # the tower's first block stands at y = 0",
        cure="niwaki grow tower.py:tower --floor 0",
        about=(
            "A constraint forbids a scene: the score is then minus infinity, whatever the rest of the scene is. Every run of the "
            "search broke a constraint, so there is no result. The message names the constraint, the number of runs that broke it, "
            "and the parts that broke it most often, with their lines.\n\n"
            "| constraint | forbidden scene | remedy |\n| --- | --- | --- |\n{constraints}"
            "| `condition`, `factor`, `observe` | the model forbids it | a condition that more runs meet, or a `factor` in its "
            "place, which only lowers the score |\n\n"
            "With `--rule surface`, a part may lie inside another part.\n\n"
            "If the first part of every run breaks the constraint, more particles change nothing. If runs become impossible "
            "later, one after the other, more particles (`--particles`) or futures can help."
        ),
    ),
    Message(
        "weights-of-runs",
        "samples of {runs} separate searches have no common weights",
        why="a particle's weight is relative to its own population",
        help="use `smc(particles, populations=n)`, which weighs its populations by their evidence, or read each search's samples",
        example="grow(ship, target, runs=4).weights",
        cure="run(ship, method=smc(300, populations=4), score=match_volume(target)).weights",
    ),
    Message(
        "not-enumerable",
        "the model has a choice whose values cannot be listed",
        why="enumeration visits every value of every choice, so each choice needs a finite list of values",
        help="use `smc`, `importance` or `rejection` instead of `enumerate_all`",
        example="run(model, method=enumerate_all())   # a model with a gaussian",
        cure="run(model, method=importance(1000))",
    ),
    Message(
        "sketch-without-slope",
        "the score of the scene has no gradient",
        why="sketches count cells and pixels, and a count has no slope",
        help="use `mh()` or particles, or describe the wanted shapes in the model with `factor`",
        example="log_density(grow(ship, target).best)",
        cure="log_density(run(ship).best)",
    ),
    Message(
        "no-continuous-choices",
        "this run makes no continuous choices",
        why="a gradient moves real numbers, and every choice of this run is discrete",
        help="use a method for discrete choices, such as `enumerate_all` or particles",
        example="log_density(run(coins).best)   # a model of flips",
        cure="log_density(run(tree).best)   # a model with a gaussian",
    ),
    Message(
        "no-normal-fits",
        "a normal distribution cannot approximate `{name}`",
        why="a normal needs the same real numbers in every run, and this model {found}",
        help="use `smc()` or `mh()`; `smc` can learn: give it a guide of `train_guide`",
        example="run(tree, method=vi())",
        cure="run(tree, method=smc())",
    ),
    Message(
        "out-of-time",
        "the search had no result within its time",
        help="give it more time or fewer particles",
        example="run(ship, method=smc(300, seconds=0.001))",
        cure="run(ship, method=smc(300, seconds=10))",
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
        why="the compiler reads the text of a model",
        help="keep `{name}` in a file; a function from Python's prompt or from `exec` has no text",
        example="a model typed at Python's prompt",
        cure="the same model in ship.py",
    ),
    Message(
        "outside-a-model",
        "`{word}` is used outside of a model",
        why="only a run of a model can make choices, add scores and add shapes",
        help="put `{word}` into a function with `@model` and run that function",
        example="x = gaussian(0, 1)",
        cure="@model\ndef m():\n    return gaussian(0, 1)",
    ),
    Message(
        "no-example",
        "there is no target `{name}`",
        why="`gallery:` stands before the name of an example target; `niwaki models` shows the target of each model",
        help="write one of {examples}",
        example="niwaki grow castle --target gallery:castle",
        cure="niwaki grow castle --target gallery:fortress",
    ),
    Message(
        "missing-choice",
        '`choices` has no value for "{address}"',
        why="the nearest addresses in `choices` are {nearest}",
        help="add the address to `choices`, or give a seed to draw missing choices",
        example="run_python(ship, choices={})",
        cure="run_python(ship, choices={}, seed=1)",
    ),
    Message(
        "nothing-offered",
        "the last drag did not offer this difference",
        why="the studio writes only a change that a drag computed for the file's text",
        help="drag the part again, and accept a difference of the new offers",
        example="client.ask('rewrite', difference='...')",
        cure="client.ask('rewrite', difference=dragged['offers'][0]['difference'])",
    ),
    Message(
        "edited-meanwhile",
        "`{path}` has changed since this difference was computed, and was not written",
        why="a difference applies only to the text for which it was computed",
        help="drag the part again, or repair the script again",
        example="change.apply()   # after an edit of the file",
        cure="dragging.source(to)[0].apply()",
    ),
    Message(
        "no-part",
        "`{pattern}` matches no part of `{name}`",
        why="a part is a call or an iteration of a loop with choices; a pattern without `/` must match the last part of "
        "an address, and a pattern with `/` the whole address",
        help="{parts}",
        example='result.regrow("wnig[1]")',
        cure='result.regrow("wing[1]")',
    ),
    Message(
        "many-parts",
        "`{pattern}` matches several parts of `{name}`",
        why="`regrow` grows one part again, and leaves all other parts as they are",
        help="name one of these parts: {parts}",
        example='result.regrow("wing[*]")',
        cure='result.regrow("wing[1]")',
    ),
)
