"""Messages about unusable drawings and rules are as reviewed; each message comes from a real mistake."""

from __future__ import annotations

from pathlib import Path

import pytest
from niwaki.color import Drawing, Rules, color
from niwaki.errors import FileError

pytest.importorskip("resvg_py")
GOLDEN = Path(__file__).parents[2] / "golden" / "drawings.txt"

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{}</svg>'
PLAIN = SVG.format('<rect class="wall" width="9" height="9"/><rect class="roof" width="5" height="9"/>')
MISTAKES = {
    "no regions": (SVG.format('<rect width="9" height="9"/>'), ""),
    "a selector": (SVG.format("<style>g > path { fill: none }</style>"), ""),
    "too many": (SVG.format("".join(f'<rect id="r{k}" width="9" height="9"/>' for k in range(300))), ""),
    "cut short": (PLAIN[:60], ""),
    "a rule of another kind": (PLAIN, 'ligthness = [["wall", "roof"]]'),
    "no such region": (PLAIN, 'lightness = [["wal", "roof"]]'),
    "a circle": (PLAIN, 'lightness = [["wall", "roof"], ["roof", "wall"]]'),
    "held the wrong way round": (
        PLAIN,
        'lightness = [["wall", "roof"]]\n[held]\nwall = "#101010"\nroof = "#ffffff"',
    ),
    "shades that are held apart": (
        PLAIN,
        'same-chroma = [["wall", "roof"]]\n[held]\nwall = "#c02020"\nroof = "#2020c0"',
    ),
    "muted and held at what is loud": (
        PLAIN,
        'same-chroma = [["wall", "roof"]]\n[muted]\nwall = 10\n[held]\nroof = "#c02020"',
    ),
    "a region against itself": (PLAIN, 'lighter = [["wall", "wall"]]'),
    "everything held": (PLAIN, '[held]\nwall = "#101010"\nroof = "#ffffff"'),
}


def test_messages_about_drawings_are_as_reviewed(tmp_path, golden) -> None:
    texts = []
    for name, (svg, rules) in MISTAKES.items():
        (tmp_path / "drawing.svg").write_text(svg, encoding="utf-8")
        (tmp_path / "rules.toml").write_text(rules, encoding="utf-8")
        with pytest.raises(FileError) as caught:
            color(Drawing.load(tmp_path / "drawing.svg"), Rules.load(tmp_path / "rules.toml"), 1, seed=1)
        texts.append(f"## {name}\n\n{caught.value}".replace(str(tmp_path), "FOLDER"))
    golden(GOLDEN, "\n\n".join(texts) + "\n")
