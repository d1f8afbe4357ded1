"""Errors about settings, models and run files, given in Python or in a shell."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

SETTINGS = (
    Message(
        "bad-setting",
        "`{name}` cannot be {found}",
        why="expected {expected}",
        help="set `{name}` to {suggestion}",
        example="grow(ship, target, voxel=-1)",
        cure="grow(ship, target, voxel=0.2)",
    ),
    Message(
        "machine-limit",
        "the model is too large for the machine",
        why="the compiler says: {found}",
        help="split the largest function into smaller ones",
        example="a function with twenty thousand variables",
        cure="ten functions with two thousand each",
    ),
    Message(
        "value-too-deep",
        "the model's value is nested too deep to return to Python",
        why="it is {found}; Python's own functions fail at such depths too",
        help="return a list instead of tuples inside of tuples",
        example="xs = ()\nfor i in range(1000):\n    xs = (xs, i)",
        cure="xs = []\nfor i in range(1000):\n    xs = xs + [i]",
    ),
    Message(
        "no-runs",
        "there is no best sample",
        why="the search keeps a table of values, not runs",
        help="read `result.distribution()` after an enumeration, or take samples with another method",
        example="run(model, method=enumerate_all()).best",
        cure="run(model, method=enumerate_all()).distribution()",
    ),
    Message(
        "unknown-model",
        "there is no model `{name}`",
        why="{reason}",
        help="write a name that `niwaki models` lists, or `file.py:function`",
        example="niwaki grow spacship",
        cure="niwaki grow spaceship",
    ),
    Message(
        "model-file-failed",
        "`{path}` cannot be run",
        why="{reason}",
        help="a model's file is ordinary Python: run `python {path}` to see where it stops",
        example="a file that imports a module that is not installed",
        cure="the same file after its imports are installed",
    ),
    Message(
        "no-target",
        "the model `{name}` has no target of its own",
        why="`grow` needs a target",
        help="name one with `--target FILE`, or a picture with `--match-image` or `--match-shadow`; in Python `target` or `score`",
        example="niwaki grow garden.py:tree",
        cure="niwaki grow garden.py:tree --target cloud.obj",
    ),
    Message(
        "bad-run-file",
        "`{path}` is not a run that can be replayed",
        why="{reason}",
        help="give the run.json that `niwaki grow` wrote",
        example="niwaki replay best.glb",
        cure="niwaki replay out/run.json",
    ),
    Message(
        "chains-gone",
        "the chains of this result of `{name}` cannot go on",
        why="a pickled result holds the samples of its chains, and not the chains",
        help="start chains again from its best: `niwaki.run(model, method, choices=result.best.choices)`",
        example="pickle.loads(pickle.dumps(result)).more(1000)",
        cure="result.more(1000)",
    ),
    Message(
        "changed-mesh",
        "the mesh `{path}` has changed since this search was saved",
        why="a search is the same only with the same target, so the mesh is identified by a hash of its triangles",
        help="restore the old file, or search again with the new one",
        example="niwaki.Search.of_json(text) after an edit of the target",
        cure="the file as it was",
    ),
    Message(
        "untrusted-function",
        "the model calls a Python function that is not trusted: `{name}`",
        why="{reason}",
        help='name its module when the search is read, such as `Search.of_json(text, trust=("my_module",))`, if you '
        "trust what it does",
        example="niwaki.Search.of_json(text)",
        cure='niwaki.Search.of_json(text, trust=("my_module",))',
    ),
    Message(
        "flag-alone",
        "`{flag}` needs {other}",
        why="{reason}",
        help="give {other} too, or leave `{flag}` out",
        example="niwaki grow blocks --match-shadow face.png",
        cure="niwaki grow blocks --match-shadow face.png --light 0,-1,0 --receiver floor.obj",
    ),
    Message(
        "flags-exclude",
        "`{flag}` and `{other}` cannot be used together",
        why="{reason}",
        help="{cure}",
        example="niwaki grow blocks --match-image front.png --match-shadow face.png",
        cure="niwaki grow blocks --match-image front.png --camera cam.json",
    ),
)
