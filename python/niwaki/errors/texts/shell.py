"""Errors about the words of a shell: arguments of a model, runs by number, folders."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

SHELL = (
    Message(
        "unknown-argument",
        "the model `{model}` has no argument `{name}`",
        why="{reason}",
        help="its arguments are: {has}",
        example="niwaki grow tower.py:tower widht=3.0",
        cure="niwaki grow tower.py:tower width=3.0",
    ),
    Message(
        "already-there",
        "`{path}` is there already",
        why="files in the way: {count}; nothing is replaced without a word",
        help="name another place with `-o`, or {cure}",
        example="niwaki grow ship -o out, a second time",
        cure="niwaki grow ship -o out --force",
    ),
    Message(
        "every-run-impossible",
        "none of {count} runs of `{name}` is possible",
        why="each breaks a constraint of the model: {constraint}",
        help="`niwaki grow` searches for the runs that keep it; `show` only draws runs as they come",
        example="niwaki show, of a model with a condition that almost no run keeps",
        cure="niwaki grow, of the same model",
    ),
    Message(
        "hold-without-run",
        "`{flag}` needs {other}",
        why="what is held or grown again is a part of a result that is there",
        help="give {cure}",
        example="niwaki grow spaceship --hold 'wings*'",
        cure="niwaki grow spaceship --from out/run.json --hold 'wings*'",
    ),
    Message(
        "nothing-fits",
        "none of the {count} choices of this run fits `{model}`",
        why="a choice fits where the model has one at the same address, and its value is possible there",
        help="name the right file with `--model`, or grow the model again",
        example="niwaki replay out/run.json --anyway, after every function was renamed",
        cure="niwaki grow tower.py:tower",
    ),
)
