"""Errors about models that somebody else wrote: their parameters, their processes, and the archives of their searches."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

FITTING = (
    Message(
        "no-ranges",
        "`{name}` cannot be searched without ranges of its parameters",
        why="{reason}",
        help="{cure}",
        example="def bracket(width, holes=4): ...\nniwaki.fit(bracket, goal)",
        cure="def bracket(width=niwaki.Uniform(20, 80), holes=niwaki.DiscreteUniform(0, 6)): ...",
    ),
    Message(
        "no-emulator",
        "the emulator cannot search `{name}`",
        why="{reason}",
        help='leave out `engine` and `evaluations`, or write `engine="sampler"`: particles search every model',
        example='niwaki.grow(tower, target, engine="emulator"), of a model with `uniform(0, height)` of a drawn height',
        cure="share = niwaki.uniform(0, 1)        # and share * height in the model",
    ),
    Message(
        "bad-command",
        "this command cannot make a mesh: {reason}",
        why="each evaluation writes the values of the parameters into the words of the command, runs it, and reads the file "
        "`{{out}}` that it writes",
        help="{cure}",
        example='niwaki.command("tool --w {w} -o {out}.stl", w=niwaki.Uniform(20, 80))',
        cure='niwaki.command(["tool", "--w", "{w}", "-o", "{out}.stl"], w=niwaki.Uniform(20, 80))',
    ),
    Message(
        "no-openscad",
        "`{name}` cannot be evaluated: there is no OpenSCAD here",
        why="the parameters are written into the file, and OpenSCAD makes the mesh",
        help="install the program `openscad`, or the faster library with `pip install openscad-evaluator manifold3d`",
        example="niwaki fit box.scad --target bracket.stl, on a machine without OpenSCAD",
        cure="pip install openscad-evaluator manifold3d",
    ),
    Message(
        "no-blender",
        "`{name}` cannot be opened: there is no Blender here",
        why="{reason}; Geometry Nodes are evaluated by your own Blender, in worker processes without a window",
        help="install Blender 4.2 or later from blender.org, and name it: `NIWAKI_BLENDER=/path/to/blender`, or "
        "`blender=` in Python; a Python with the package `bpy` does, too",
        example="niwaki fit chair.blend --target chair.stl, on a machine without Blender",
        cure="NIWAKI_BLENDER=/path/to/blender niwaki fit chair.blend --target chair.stl",
    ),
    Message(
        "blender-failed",
        "`{name}` does not open in Blender",
        why="{reason}",
        help="open the file in this Blender by hand; a file of a later version needs a later Blender",
        example="niwaki fit chair.blend --target chair.stl, of a file that is no .blend",
        cure="niwaki fit chair.blend --target chair.stl, after the file was saved by Blender",
    ),
    Message(
        "bad-node-tree",
        "`{name}` cannot be fitted: {reason}",
        why="the parameters are the sockets of one Geometry Nodes modifier of one object",
        help="{cure}",
        example='niwaki.blend("chair.blend", object="Chiar")',
        cure='niwaki.blend("chair.blend", object="Chair", modifier="GeometryNodes")',
    ),
    Message(
        "no-literals",
        "nothing in `{path}` may change",
        why="a repair changes numbers of the script; sizes, counts, colours and strings stay unless they are named",
        help="name literals that may change by `free=`, or `--free`: an argument, a variable, a called function or a line",
        example='niwaki.repair("room.py", keep), of a script that has only sizes',
        cure='niwaki.repair("room.py", keep, free=["width"])',
    ),
    Message(
        "script-failed",
        "`{path}` fails as it is written",
        why="{reason}",
        help="run it once by hand; it has to show its parts: a variable `scene` or `parts`, or a function that returns them",
        example='niwaki.repair("room.py", keep), of a script that only draws',
        cure="parts = {{'table': niwaki.box((0, 0.4, 0), (1.2, 0.8, 0.7))}}",
    ),
    Message(
        "all-failed",
        "the first {count} evaluations of `{name}` all failed",
        why="the first: {reason}",
        help="call the model once by hand with parameters in the middle of their ranges; the table of the folder has the text "
        "of each failure",
        example="niwaki.fit(bracket, goal), of a function that returns no mesh",
        cure="def bracket(width=niwaki.Uniform(20, 80)):\n    return trimesh.creation.box((width, 10, 10))",
    ),
    Message(
        "fit-worker-ended",
        "a worker process cannot load the model: {reason}",
        why="each worker imports the module of the function, or runs its file up to the call of `fit`",
        help="run the file alone: `python -i FILE`; a function that is defined inside of another runs in this process",
        example="niwaki.fit(bracket, goal), where the file of bracket imports a package that is missing",
        cure="the package installed, or its import inside of the function",
    ),
    Message(
        "other-fit",
        "the folder `{path}` has the evaluations of another search",
        why="{differences}; an archive has evaluations of equal searches only",
        help="name another folder; or undo the change, to go on with this one",
        example='niwaki.fit(bracket, goal, folder="bracket"), after an edit of the function',
        cure='niwaki.fit(bracket, goal, folder="bracket-2")',
    ),
    Message(
        "bad-archive",
        "`{path}` cannot be read as the archive of a fit",
        why="{reason}",
        help="restore the file, or name another folder: the same seed gives the same evaluations",
        example="an archive that was edited by hand",
        cure='niwaki.fit(bracket, goal, folder="bracket-2")',
    ),
)
