"""The list of deliberate errors fits the sources, and the manual shows all of them."""

import mutants
import pytest

MUTANTS = mutants.entries()


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.name)
def test_an_error_changes_one_place_and_its_judge_has_tests(mutant):
    text = (mutants.ROOT / mutant.file).read_text(encoding="utf-8")
    assert mutant.applied(text) != text
    if mutant.judge.crate == "python":
        files, word = [mutants.ROOT / "tests" / "niwaki" / f"{mutant.judge.target}.py"], "def "
    else:
        crate = mutants.ROOT / "crates" / mutant.judge.crate
        folder = crate / ("src" if mutant.judge.target == "lib" else "tests")
        files, word = list(folder.rglob("*.rs")), "fn "
    names = {
        line.split("(")[0].split(word)[-1]
        for file in files
        for line in file.read_text().splitlines()
        if word in line
    }
    for pattern in mutant.judge.patterns:
        suffix = pattern.rsplit("::", 1)[-1]
        assert not suffix or any(suffix in name for name in names), f"no test is named like `{pattern}`"


def test_names_are_unique():
    assert len({mutant.name for mutant in MUTANTS}) == len(MUTANTS)


def test_the_manual_shows_the_list():
    page = mutants.PAGE.read_text(encoding="utf-8")
    assert mutants.page_with_table(page, MUTANTS) == page, "run `python tests/mutants/mutants.py --page`"
