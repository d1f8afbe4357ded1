"""Claim: the package has a word for each shape of the engine, with arguments by position or by name."""

from typing import Any

import niwaki as nw
import pytest
from niwaki import _engine
from niwaki.words.shapes import SHAPES


def test_every_word_of_the_engine_is_a_word_of_the_package() -> None:
    assert [word.__name__ for word in SHAPES] == list(_engine.SHAPES)
    assert all(getattr(nw, word.__name__) is word for word in SHAPES)


def test_arguments_have_a_position_or_a_name_and_others_are_refused() -> None:
    shape: Any = _engine.shape
    by_name = shape("cylinder", radius=1.0, center=(0, 0, 0), length=2.0, color=(1, 0, 0))
    assert by_name == shape("cylinder", (0, 0, 0), 1.0, 2.0, color=(1, 0, 0))
    with pytest.raises(TypeError, match="`box` has no parameter side"):
        shape("box", (0, 0, 0), side=1.0)
    with pytest.raises(TypeError, match="`box` takes 2 to 10 arguments, found 11"):
        shape("box", *[(0, 0, 0)] * 11)
    with pytest.raises(ValueError, match="argument 2 of `box` cannot be None") as missing:
        shape("box", (0, 0, 0))
    assert missing.value.code == "bad-argument"  # type: ignore[attr-defined]
    with pytest.raises(TypeError, match="no shape `blob`"):
        shape("blob")
