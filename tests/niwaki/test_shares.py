"""Shares for people: whole percents, where only all is 100 % and only nothing is 0 %."""

import pytest
from niwaki.shares import coverage, percent
from niwaki.studio.messages import Key, Outcome
from niwaki.targets.fit import Fit


@pytest.mark.parametrize(
    ("share", "text"),
    [
        (1.0, "100 %"),
        (0.996, "99 %"),
        (1.0 - 1e-7, "99 %"),
        (0.966, "97 %"),
        (0.125, "13 %"),
        (0.004, "1 %"),
        (1e-7, "1 %"),
        (0.0, "0 %"),
        (-1e-17, "0 %"),
        (1.0 + 1e-15, "100 %"),
        (1.5, "150 %"),
    ],
)
def test_only_all_is_100_and_only_nothing_is_0(share, text):
    assert percent(share) == text


def test_a_fit_and_the_gallery_of_the_studio_have_the_same_words():
    assert str(Fit(0.966, 0.004)) == coverage(0.966, 0.004) == "97 % covered, 1 % outside"
    assert Outcome(Key(0), 0.0, None, 1, 1, covered=0.966, outside=0.004).fit == str(Fit(0.966, 0.004))
    assert Outcome(Key(0), 0.0, None, 1, 1).fit == ""
