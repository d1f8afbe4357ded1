"""What could be better in a model that is right: advice, not errors."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

ADVICE = (
    Message(
        "decides-in-place",
        "a random branch builds parts here, and the code after it does not depend on it",
        label="decided and built before the rest continues",
        second="the rest, which could run first",
        why="particles are compared while this branch is built, and the rest waits; a future can also run after the rest; it costs "
        "a little time, and where its parts are in the way of others it can make a search worse",
        help="put the decision and what it builds into a function, write `future(function, ...)`, and measure both: `niwaki "
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
        "`{name}` decides at random what it builds, and the code after it does not depend on it",
        label="built before the rest continues",
        second="the rest, which could run first",
        why="particles are compared while the call runs, and the rest waits; a future can also run after the rest; it costs "
        "a little time, and where its parts are in the way of others it can make a search worse",
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
        second="built, or scored, without it",
        why="every particle has a value before any part shows whether the value is good",
        help="choose `{name}` after that part, right before it is first used, and measure both: `niwaki check before.py:m "
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
