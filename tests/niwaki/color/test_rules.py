"""Rules are read as written; wrong rules give an error with their names, contradictory rules a list."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest
from niwaki.color import Rules, lab
from niwaki.color.consistency import contradiction, least_slack
from niwaki.color.drawing import EXAMPLES
from niwaki.errors import FileError


def error_of(place, text: str) -> FileError:
    path = place / "rules.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FileError) as caught:
        Rules.load(path).check(["wall", "roof", "ink", "sky"])
    return caught.value


def test_a_chain_is_a_rule_for_each_neighbouring_pair() -> None:
    rules = Rules.of({"lightness": [["a", "b", "c"]], "same-hue": [["a", "c"]], "muted": {"all": 50, "b": 9}})
    assert [(rule.kind, rule.first, rule.second) for rule in rules] == [
        ("lightness", "a", "b"),
        ("lightness", "b", "c"),
        ("same-hue", "a", "c"),
        ("muted", "b", ""),
    ]
    assert [(rule.first, rule.most) for rule in rules.on("abc") if rule.kind == "muted"] == [
        ("b", 9),
        ("a", 50),
        ("c", 50),
    ]


@pytest.mark.parametrize(
    ("text", "code", "message"),
    [
        ('lightness = [["wall", "rof"]]', "rules-no-region", "did you mean `roof`"),
        ("[held]\nmoon = '#ffffff'", "rules-no-region", "it has wall, roof, ink, sky"),
        ('background = "see"', "rules-no-region", "`see`"),
        ('lightnes = [["wall", "roof"]]', "rules-unclear", "did you mean `lightness`"),
        ('lightness = ["wall", "roof"]', "rules-unclear", "chains"),
        ('lightness = [["wall"]]', "rules-unclear", "chains"),
        ("[held]\nwall = 'red'", "rules-unclear", "not a colour `#rrggbb`"),
        ("[muted]\nwall = true", "rules-unclear", "from 0 to 200"),
        ("muted = 3", "rules-unclear", "table"),
        ("background = 3", "rules-unclear", "one region"),
        ("lightness = [", "file-unreadable", "toml"),
    ],
)
def test_rules_that_cannot_be_used_give_an_error(tmp_path, text: str, code: str, message: str) -> None:
    error = error_of(tmp_path, text)
    assert error.code == code and message in str(error)


@pytest.mark.parametrize(
    ("text", "listed", "absent"),
    [
        # a circle of three rules, and an unrelated rule
        (
            'lightness = [["wall", "roof", "ink", "wall"], ["sky", "roof"]]',
            ["`wall` is 15", "`roof` is 15", "`ink` is 15"],
            ["`sky`"],
        ),
        ('lighter = [["wall", "roof"], ["roof", "wall"]]', ["`wall` is at least", "`roof` is at least"], []),
        ('lightness = [["wall", "wall"]]', ["`wall` is 15 units lighter than `wall`"], []),
        # a held black region, and a rule that makes it lighter than another region
        (
            'lightness = [["ink", "wall"]]\n[held]\nink = "#000000"',
            ["`ink` is 15", "`ink` is held at #000000", "`wall` is no darker than black"],
            [],
        ),
        # two held colours in the wrong order, through a third region
        (
            'lightness = [["wall", "roof", "ink"]]\n[held]\nwall = "#303030"\nink = "#f0f0f0"',
            ["`wall` is held", "`ink` is held", "`roof` is 15"],
            [],
        ),
        (
            'same-chroma = [["wall", "roof"], ["ink", "roof"]]\n[held]\nwall = "#ff0000"\nink = "#00ff00"',
            ["`wall` and `roof` are shades", "`ink` and `roof` are shades", "held at #00ff00"],
            [],
        ),
        (
            'same-chroma = [["wall", "roof"]]\n[muted]\nroof = 10\n[held]\nwall = "#ff0000"',
            ["`roof` is at most 10", "held at #ff0000"],
            [],
        ),
    ],
)
def test_a_contradiction_lists_only_its_own_rules(tmp_path, text, listed, absent) -> None:
    error = error_of(tmp_path, text)
    assert error.code == "rules-contradict"
    assert all(words in str(error) for words in listed) and not any(words in str(error) for words in absent)


def test_two_paths_of_unequal_length_need_slack() -> None:
    """Three steps and four steps lead from sky to line: 3 (15 + s) = 4 (15 - s), so s = 15 / 7."""
    rules = Rules(lightness=[["sky", "a", "b", "line"], ["sky", "c", "d", "e", "line"]])
    slack, forced = least_slack(rules)
    assert slack == pytest.approx(15 / 7, abs=1e-6)
    assert len(forced) == 7 and contradiction(rules) == []


def test_the_least_slack_agrees_with_a_linear_program() -> None:
    linprog = pytest.importorskip("scipy.optimize").linprog
    for seed in range(20):
        random = np.random.default_rng(seed)
        names = [f"r{k}" for k in range(6)]
        pairs = [tuple(random.choice(6, 2, replace=False)) for _ in range(9)]
        rules = Rules(lightness=[[names[a], names[b]] for a, b in pairs], held={"r0": "#808080"})
        rows, most = [], []
        for a, b in pairs:
            for sign in (1.0, -1.0):
                row = np.zeros(7)
                row[a], row[b], row[6] = sign, -sign, -1.0
                rows.append(row)
                most.append(15.0 * sign)
        grey = lab.of_hex("#808080")[0]
        bounds = [(grey, grey)] + [(0, 100)] * 5 + [(0, None)]
        best = linprog([0] * 6 + [1], rows, most, bounds=bounds)
        assert least_slack(rules)[0] == pytest.approx(best.fun, abs=1e-6)


def test_the_packages_rules_can_all_hold() -> None:
    for place in EXAMPLES.glob("*.toml"):
        assert least_slack(Rules.load(place)) == (0.0, [])


def test_rules_survive_a_file() -> None:
    for place in EXAMPLES.glob("*.toml"):
        rules = Rules.load(place)
        assert Rules.of(tomllib.loads(rules.toml()), place) == rules
    chains = [['a "b"', "grün", "\\\n"]]
    odd = Rules.of({"lighter": chains, "muted": {"all": 7.5}, "held": {"a.b": "#00ff00"}})
    # The first format has `pinned`.
    assert Rules.of({"lighter": chains, "muted": {"all": 7.5}, "pinned": {"a.b": "#00ff00"}}) == odd
    assert Rules.of(tomllib.loads(odd.toml())) == odd
