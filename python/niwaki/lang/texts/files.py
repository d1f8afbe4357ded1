"""What is wrong with the files that come in and go out, and with the settings of targets and pictures."""

from __future__ import annotations

from niwaki.lang.texts.drawings import DRAWINGS
from niwaki.lang.texts.message import Message

FILES = (
    *DRAWINGS,
    Message(
        "file-missing",
        "there is no file at this path",
        why="nothing was found at {absolute}",
        help="check the spelling, or give the path from the folder you are in: {folder}",
        example='Target.load("shp.obj")',
        cure='Target.load("ship.obj")',
    ),
    Message(
        "file-format",
        "`{suffix}` is not a format that can be {done} here",
        why="the format is chosen by the end of the file's name",
        help="use one of {formats}",
        example='result.export("ship.txt")',
        cure='result.export("ship.glb")',
    ),
    Message(
        "file-unreadable",
        "this file cannot be read as {suffix}",
        why="{reason}",
        help="open it in the program that made it and export it again; a broken download is cut short",
        example="a truncated ship.glb",
        cure="the whole file",
    ),
    Message(
        "target-empty",
        "this target has no triangles",
        why="{reason}",
        help="export a mesh with faces; points and curves alone have no volume to fill",
        example="an obj file with points only",
        cure="an obj file with faces",
    ),
    Message(
        "target-not-finite",
        "this target has coordinates that are not finite numbers",
        why="{count} of {total} vertices hold nan or inf, the first is number {first}",
        help="clean the mesh in the program that made it; often a modifier divided by zero",
        example="a vertex at nan",
        cure="every vertex at finite coordinates",
    ),
    Message(
        "target-flat",
        "this target has no thickness along {axis}",
        why="its extent is {extent}",
        help="give it a volume, such as by thickening or extruding it",
        example="a mesh of one square",
        cure="a box",
    ),
    Message(
        "setting",
        "`{name}` cannot be {found!r}",
        why="found {found!r}, expected {expected}",
        help="choose one of these",
        example='volume_match(target, rule="sharp")',
        cure="one of the rules that the message lists",
    ),
    Message(
        "scene-empty",
        "there is nothing to {verb}",
        why="the scene has no parts",
        help="let the model `emit` at least one shape",
        example="@model\ndef m():\n    return 1",
        cure="@model\ndef m():\n    emit(box((0, 0, 0), (1, 1, 1)))",
    ),
    Message(
        "file-unwritable",
        "this file cannot be written",
        why="{reason}",
        help="check that the folder exists, that you may write there and that the disk has room",
        example="a folder that is not there",
        cure="a folder that is there",
    ),
    Message(
        "polygon",
        "this file holds no polygon that can be used",
        why="{reason}",
        help="give one closed outline of straight lines with at least three corners that does not cross itself",
        example='load_polygon("two-rooms.svg")',
        cure='load_polygon("room.svg")',
    ),
    Message(
        "not-a-solid",
        "{count} of {total} shapes are not solids that can be printed",
        why="{listed}",
        help="close these meshes in the program that made them, or write .glb, .obj or .ply, which take any mesh",
        example='a mesh with a hole, and result.export("ship.stl")',
        cure='result.export("ship.glb")',
    ),
    Message(
        "missing-extra",
        "{task} needs the extra `{extra}`, which is not installed",
        why="the core install is kept small",
        help="install it with `pip install 'niwaki[{extra}]'`",
        example='result.export("ship.stl") where manifold3d is not installed',
        cure="the same after installing the extra",
    ),
)
