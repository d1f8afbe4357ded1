"""The words for shapes, their signatures and the engine's description of them agree."""

import inspect
from pathlib import Path

import pytest
from niwaki import _engine
from niwaki.words.shapes import SHAPES

GUIDE = (Path(__file__).parents[3] / "docs" / "guide" / "language.md").read_text(encoding="utf-8")


def test_the_engine_has_each_word_with_the_same_parameters() -> None:
    words = {word.__name__: list(inspect.signature(word).parameters) for word in SHAPES}
    assert words == _engine.SHAPES


@pytest.mark.parametrize("word", SHAPES, ids=lambda word: word.__name__)
def test_the_guide_has_each_signature(word) -> None:
    signature = inspect.signature(word)
    plain = [one.replace(annotation=one.empty) for one in signature.parameters.values()]
    text = f"{word.__name__}{inspect.Signature(plain)}".replace("'", '"')
    assert " ".join(text.split()) in " ".join(GUIDE.split())


def test_arguments_go_by_position_or_name_and_others_are_refused() -> None:
    by_name = _engine.Shape.cylinder(radius=1.0, center=(0, 0, 0), length=2.0, color=(1, 0, 0))
    assert by_name == _engine.Shape.cylinder((0, 0, 0), 1.0, 2.0, color=(1, 0, 0))
    with pytest.raises(TypeError, match="`box` has no parameter side"):
        _engine.Shape.box((0, 0, 0), side=1.0)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="`box` takes 2 to 9 arguments, found 10"):
        _engine.Shape.box(*[(0, 0, 0)] * 10)  # type: ignore[call-arg, arg-type]
    with pytest.raises(ValueError, match="argument 2 of `box` cannot be None") as missing:
        _engine.Shape.box((0, 0, 0))  # type: ignore[call-arg]
    assert missing.value.code == "bad-argument"  # type: ignore[attr-defined]
