"""Claim: numbers of settings are checked against their bounds, and the message has the bounds."""

from __future__ import annotations

from math import inf, nan
from typing import Any

import pytest
from niwaki.errors import InputError
from niwaki.errors.settings import real


@pytest.mark.parametrize(
    ("bounds", "good", "bad", "expected"),
    [
        ((), [0, -3, 1e300], [inf, -inf, nan, True, "1", None, 10**400], "a finite number"),
        ((0,), [1e-300, 5], [0, -1, inf, nan], "a finite number above 0"),
        ((0, inf, "[)"), [0, 5], [-1e-9, inf], "a finite number from 0 on"),
        ((0, 1), [0.5], [0, 1, -1, inf, nan], "a number between 0 and 1"),
        ((0, 1, "[]"), [0, 1], [-0.1, 1.1], "a number from 0 to 1"),
        ((0, 1, "(]"), [0.1, 1], [0, 1.1], "a number above 0, at most 1"),
        ((0, 1, "[)"), [0, 0.9], [-0.1, 1], "a number from 0 to below 1"),
    ],
)
def test_bounds(bounds: tuple[Any, ...], good: list[Any], bad: list[Any], expected: str) -> None:
    for value in good:
        number = real("x", value, *bounds)
        assert isinstance(number, float) and number == value
    for value in bad:
        with pytest.raises(InputError) as refused:
            real("x", value, *bounds)
        assert refused.value.code == "bad-setting" and f"expected {expected}\n" in str(refused.value)
