"""Errors about the arguments of commands: arguments of a model, runs by number, folders."""

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
        "`{path}` already exists",
        why="files that would be replaced: {count}; Niwaki replaces no file unless you say so",
        help="name another place with `-o`, or {cure}",
        example="niwaki grow ship -o out, a second time",
        cure="niwaki grow ship -o out --force",
    ),
    Message(
        "bad-requirements",
        "`{path}` does not describe requirements",
        why="{reason}",
        help="requirements are `covered`, `outside`, `height`, `within`, `thinnest`, `stands`, `supported` and `collisions`: "
        "write those that you need, for instance `height = [2.0, 3.0]` or `collisions = false`",
        example="height = [3.0, 2.0]",
        cure="height = [2.0, 3.0]",
    ),
    Message(
        "every-run-impossible",
        "none of {count} runs of `{name}` is possible",
        why="each run breaks a constraint of the model: {constraint}",
        help="use `niwaki grow`, which searches for runs that keep the constraint; `show` does not search",
        example="niwaki show, of a model with a condition that almost no run keeps",
        cure="niwaki grow, of the same model",
    ),
    Message(
        "hold-without-run",
        "`{flag}` needs {other}",
        why="only parts of an existing result can be held or grown again",
        help="give {cure}",
        example="niwaki grow spaceship --hold 'wings*'",
        cure="niwaki grow spaceship --from out/run.json --hold 'wings*'",
    ),
    Message(
        "nothing-fits",
        "none of the {count} choices of this run fits `{model}`",
        why="a choice fits if the model has a choice at the same address that can have its value",
        help="name the right file with `--model`, or grow the model again",
        example="niwaki replay out/run.json --anyway, after every function was renamed",
        cure="niwaki grow tower.py:tower",
    ),
)
