"""Claim: advice reports code that can move, and no code that the next part needs."""

from __future__ import annotations

import linecache
from pathlib import Path
from typing import Any

import pytest
from niwaki.errors.messages import ADVICE, Message
from niwaki.gallery import entries
from niwaki.gallery.spaceship import __file__ as SHIP
from niwaki.lang.advice import advise

GOLDEN = Path(__file__).parents[2] / "golden"


def load(text: str, name: str) -> Any:
    """The model `m` of a program."""
    whole = (
        text if "import" in text else f"from niwaki import host, model; from niwaki.words import *\n\n{text}"
    )
    linecache.cache[name] = (len(whole), None, whole.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "advice"}
    exec(compile(whole, name, "exec"), space)
    return space.get("m") or space["spaceship"]


def codes(text: str, name: str) -> list[str]:
    return [advice.code for advice in advise(load(text, name).function)]


@pytest.mark.parametrize("message", ADVICE, ids=lambda message: message.code)
def test_examples_get_advice_and_cures_get_none(message: Message) -> None:
    assert codes(message.example, f"{message.code}.py") == [message.code]
    assert codes(message.cure, f"{message.code}_cured.py") == []


def test_models_of_the_gallery_get_no_advice() -> None:
    grown = [entry for entry in entries() if entry.target_name is not None]
    assert [(entry.name, str(advice)) for entry in grown for advice in advise(entry.model.function)] == []


def test_each_call_of_a_ship_without_futures_gets_advice() -> None:
    text = Path(SHIP).read_text()
    for callee in ("wings", "guns", "fins"):
        text = text.replace(f"future({callee}, ", f"{callee}(")
    advice = advise(load(text, "plain_ship.py").function)
    # The guns are the last of their branch, but not of the loop around it.
    assert [(entry.code, entry.values["name"]) for entry in advice] == [
        ("calls-in-place", "wings"),
        ("calls-in-place", "fins"),
        ("calls-in-place", "guns"),
    ]


LEFT_ALONE = {
    "what follows reads what the branch assigned": """
    x = 1.0
    if flip(0.5):
        x = 2.0
        emit(box((0, 0, 0), (x, 1, 1)))
    emit(box((9, 0, 0), (x, 1, 1)))
""",
    "the branch is the last": """
    emit(box((9, 0, 0), (1, 1, 1)))
    if flip(0.5):
        emit(box((0, 0, 0), (1, 1, 1)))
""",
    "the test is not random": """
    for i in range(3):
        if i == 1:
            emit(box((0, 0, 0), (1, 1, 1)))
        emit(box((i, 0, 0), (1, 1, 1)))
""",
    "the branch returns": """
    if flip(0.5):
        emit(box((0, 0, 0), (1, 1, 1)))
        return 0
    emit(box((9, 0, 0), (1, 1, 1)))
""",
    "the branch builds nothing": """
    side = flip(0.5)
    x = 2 if side else 3
    if side:
        x = x + 1
    emit(box((9, 0, 0), (x, 1, 1)))
""",
    "the loop carries it": """
    x = 1.0
    for i in range(3):
        emit(box((i, 0, 0), (x, 1, 1)))
        x = x * uniform(0.5, 1)
""",
    "each choice is used at once": """
    a = uniform(1, 2)
    b = 2 * a
    emit(box((0, 0, 0), (b, 1, 1)))
    emit(box((9, 0, 0), (a, 1, 1)))
""",
}


@pytest.mark.parametrize("why", LEFT_ALONE)
def test_code_that_cannot_move_gets_no_advice(why: str) -> None:
    assert codes(f"@model\ndef m():{LEFT_ALONE[why]}", f"{why}.py") == []


POINTED_AT = {
    "a branch in a loop, told of the next round": """
    for i in range(3):
        if flip(0.5):
            emit(box((i, 0, 0), (1, 1, 1)))
""",
    "a call whose callee's callee decides": """
    twig(3)
    factor(0.0)

def twig(n):
    leaf(n)

def leaf(n):
    if n > gaussian(0, 1):
        emit(box((n, 0, 0), (1, 1, 1)))
""",
    "a value that is made of an early choice": """
    a, b = uniform(1, 2), uniform(1, 2)
    twice = 2 * b
    observe(Gaussian(0, 1), 0.3)
    emit(box((9, a, 0), (twice, 1, 1)))
""",
}


def test_messages_of_advice(golden: Any) -> None:
    texts = []
    for title, body in POINTED_AT.items():
        advice = advise(load(f"@model\ndef m():{body}", "hedge.py").function)
        texts.append(f"## {title}\n\n" + "\n\n".join(map(str, advice)) + "\n")
    golden(GOLDEN / "advice.txt", "\n".join(texts))
