"""Claim: each family of the engine has a class with the same parameters, and a word that draws from it."""

import inspect

import niwaki as nw
import pytest
from niwaki import _engine
from niwaki.errors import InputError
from niwaki.words.distributions import FAMILIES

WORDS = {"bernoulli": "flip"}


@pytest.mark.parametrize("family", _engine.FAMILIES)
def test_a_family_has_a_class_and_a_word(family: str) -> None:
    classes = {family_class.family: family_class for family_class in FAMILIES}
    assert family in classes, f"`{family}` has no class in niwaki.words.distributions"
    parameters = inspect.signature(classes[family]).parameters
    assert list(parameters) == [row[0] for row in _engine.FAMILIES[family][2]]
    if family == "delta":
        return
    word = getattr(nw, WORDS.get(family, family))
    assert getattr(nw.words, classes[family].__name__) is classes[family]
    *arguments, label = inspect.signature(word).parameters.values()
    assert [(p.name, p.default) for p in arguments] == [(p.name, p.default) for p in parameters.values()]
    assert label.name == "label" and classes[family].__doc__.rstrip() in word.__doc__
    with pytest.raises(InputError, match="outside"):
        word(*[0.5] * len(parameters))
