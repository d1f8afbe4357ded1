"""Texts do not become harder to read: the numbers of `english.toml` only go down."""

import checkout
import english
import pytest

SAMPLES = {
    "python": (
        "a.py",
        '''"""Sizes of a part."""


def found(one):
    """What was found."""
    told = [one for one in one]
''',
        {"names": 4, "openings": 1},
    ),
    "rust": (
        "a.rs",
        """/// The same, of a run.
pub fn size(own: &Run) -> usize {
    let found = "let told = 1"; // let given = 1;
    own.iter().filter(|one| one.is_so()).count()
}
""",
        {"names": 3, "openings": 1},
    ),
    "page": (
        "a.md",
        "# What it is\n\nOf all. " + "word " * 36 + "ends.\n\n```\nOf code\n```\n",
        {"openings": 1, "long": 1},
    ),
}


def test_no_folder_has_more_than_its_number():
    if not checkout.tracked():
        pytest.skip("not a git checkout")
    limits = english.limits()
    grown = []
    for folder, row in english.counts(english.faults()).items():
        allowed = limits.get(folder, {})
        grown += [
            f"{folder}: {row[kind]} {kind}, {allowed.get(kind, 0)} allowed"
            for kind in row
            if row[kind] > allowed.get(kind, 0)
        ]
    assert not grown, "list the places: python tests/house/english.py FOLDER"


@pytest.mark.parametrize("name", SAMPLES)
def test_pronouns_openings_and_long_sentences_are_counted(name):
    path, text, expected = SAMPLES[name]
    read = getattr(english, name)
    assert english.counts(list(read(path, text))).get("", {}) == expected
