"""Each family of the engine has a class of the same parameters, a word that draws from it and a row in the guide."""

import inspect
from pathlib import Path

import niwaki as nw
import pytest
from niwaki import _engine
from niwaki.errors import InputError
from niwaki.words.distributions import FAMILIES

GUIDE = (Path(__file__).parents[3] / "docs" / "guide" / "language.md").read_text(encoding="utf-8")

WORDS = {"bernoulli": "flip"}


@pytest.mark.parametrize("family", _engine.family_names())
def test_a_family_has_a_class_a_word_and_a_row_in_the_guide(family: str) -> None:
    classes = {one.family: one for one in FAMILIES}
    assert family in classes, f"`{family}` has no class in niwaki.words.distributions"
    parameters = inspect.signature(classes[family]).parameters
    assert list(parameters) == _engine.parameter_names(family)
    if family == "delta":
        return
    word = getattr(nw, WORDS.get(family, family))
    assert getattr(nw.words, classes[family].__name__) is classes[family]
    assert inspect.signature(word).parameters == parameters
    assert word.__doc__ == classes[family].__doc__
    with pytest.raises(InputError, match="outside"):
        word(*[0.5] * len(parameters))
    row = next((line for line in GUIDE.splitlines() if line.startswith(f"| `{word.__name__}`")), None)
    assert row is not None, f"`{word.__name__}` has no row in docs/guide/language.md"
    assert all(name in row for name in parameters)
