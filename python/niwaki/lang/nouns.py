"""English nouns from the names in a source: words with blanks, one and many, first and second."""

from __future__ import annotations

import re

#: Nouns with a plural of their own.
_PLURALS = {
    "child": "children",
    "foot": "feet",
    "half": "halves",
    "leaf": "leaves",
    "person": "people",
    "shelf": "shelves",
    "tooth": "teeth",
    "vertex": "vertices",
}
_SINGULARS = {many: noun for noun, many in _PLURALS.items()}
#: Endings that take `es`.
_HISSING = ("s", "x", "z", "ch", "sh")
#: Endings of nouns in `s` that are not plurals: axis, radius, glass.
_ENDS_IN_S = ("ss", "us", "is")
_ORDINALS = "first second third fourth fifth sixth seventh eighth ninth tenth".split()


def words(name: str) -> str:
    """Write a name of the source as words: `box_section` and `boxSection` are "box section"."""
    parts = re.sub(r"(?<=[a-z])(?=[A-Z][a-z])", "_", name).replace("-", "_").split("_")
    return " ".join(part.lower() if part[1:].islower() else part for part in parts if part) or name


def plural(noun: str) -> str:
    """Return the plural: "storey" becomes "storeys", "box section" becomes "box sections"."""
    head, blank, last = noun.rpartition(" ")
    if last in _PLURALS:
        many = _PLURALS[last]
    elif last in _SINGULARS or singular(last) != last:
        many = last
    elif last.endswith(_HISSING):
        many = last + "es"
    elif re.search(r"[^aeiou]y$", last):
        many = last[:-1] + "ies"
    else:
        many = last + "s"
    return head + blank + many


def singular(noun: str) -> str:
    """Return the singular of a plural, and any other noun as it is: "wings" becomes "wing"."""
    head, blank, last = noun.rpartition(" ")
    if last in _SINGULARS:
        one_noun = _SINGULARS[last]
    elif len(last) < 3 or not last.endswith("s") or last.endswith(_ENDS_IN_S):
        one_noun = last
    elif last.endswith("ies") and len(last) > 4:
        one_noun = last[:-3] + "y"
    elif last.endswith(tuple(f"{ending}es" for ending in ("ss", "x", "ch", "sh"))):
        one_noun = last[:-2]
    else:
        one_noun = last[:-1]
    return head + blank + one_noun


def ordinal(number: int) -> str:
    """Return the ordinal of a number from 1: "first", "second", and "11th" after "tenth"."""
    if number <= len(_ORDINALS):
        return _ORDINALS[number - 1]
    end = "th" if number % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(number % 10, "th")
    return f"{number}{end}"
