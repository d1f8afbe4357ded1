"""Advice of `niwaki check` about models that are right: how a search of them could be more efficient."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

ADVICE = (
    Message(
        "decides-in-place",
        "a random branch builds parts here, and the code after it does not depend on it",
        label="decided and built before the rest continues",
        second="the rest, which could run first",
        why="the search compares particles as soon as this branch is built, before the rest exists; a future can run after the "
        "rest. A future takes a little time, and makes a search worse where its parts block other parts",
        help="put the decision and its parts into a function, write `future(function, ...)`, and measure both: `niwaki "
        "check before.py:m --try after.py:m`",
        example=(
            "@model\ndef m():\n    if flip(0.5):\n        emit(box((0, 0, 0), (1, 1, 1)))\n    emit(box((9, 0, 0), (1, 1, 1)))\n"
        ),
        cure=(
            "@model\ndef m():\n    future(ball)\n    emit(box((9, 0, 0), (1, 1, 1)))\n\n"
            "def ball():\n    if flip(0.5):\n        emit(box((0, 0, 0), (1, 1, 1)))\n"
        ),
    ),
    Message(
        "calls-in-place",
        "`{name}` builds parts by a random decision, and the code after the call does not depend on it",
        label="built before the rest continues",
        second="the rest, which could run first",
        why="the search compares particles as soon as the call has built its parts, before the rest exists; a future can run after "
        "the rest. A future takes a little time, and makes a search worse where its parts block other parts",
        help="write `{cure}`, and measure both: `niwaki check before.py:m --try after.py:m`",
        example=(
            "@model\ndef m():\n    ball()\n    emit(box((9, 0, 0), (1, 1, 1)))\n\n"
            "def ball():\n    if flip(0.5):\n        emit(box((0, 0, 0), (1, 1, 1)))\n"
        ),
        cure=(
            "@model\ndef m():\n    future(ball)\n    emit(box((9, 0, 0), (1, 1, 1)))\n\n"
            "def ball():\n    if flip(0.5):\n        emit(box((0, 0, 0), (1, 1, 1)))\n"
        ),
    ),
    Message(
        "chosen-early",
        "`{name}` is chosen before a part that does not need it",
        label="chosen here",
        second="built or scored without `{name}`",
        why="every particle draws the value before any part can show whether the value is good",
        help="choose `{name}` right before its first use, and measure both: `niwaki check before.py:m "
        "--try after.py:m`",
        example=(
            "@model\ndef m():\n    a = uniform(1, 2)\n    b = uniform(1, 2)\n"
            "    emit(box((0, 0, 0), (a, 1, 1)))\n    emit(box((9, 0, 0), (b, 1, 1)))\n"
        ),
        cure=(
            "@model\ndef m():\n    a = uniform(1, 2)\n    emit(box((0, 0, 0), (a, 1, 1)))\n"
            "    b = uniform(1, 2)\n    emit(box((9, 0, 0), (b, 1, 1)))\n"
        ),
    ),
)
