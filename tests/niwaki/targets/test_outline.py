"""Claim: a polygon comes from JSON and SVG as it was drawn, counter-clockwise; a file without a polygon is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from niwaki.errors import FileError
from niwaki.targets.outline import load_polygon
from niwaki.words import polygon_area

ELL = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]


def saved(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("room.json", "[[0, 0], [4, 0], [4, 2], [2, 2], [2, 4], [0, 4]]"),
        ("room.json", '{"polygon": [[0, 4], [2, 4], [2, 2], [4, 2], [4, 0], [0, 0], [0, 4]]}'),
        (
            "room.svg",
            '<svg xmlns="http://www.w3.org/2000/svg"><polygon points="0,0 4,0 4,-2 2,-2 2,-4 0,-4"/></svg>',
        ),
        ("room.svg", '<svg><g><path d="M0 0H4V-2L2-2v-2h-2z"/></g></svg>'),
        ("room.svg", '<svg><path d="m 0,0 4,0 0,-2 -2,0 0,-2 -2,0 Z"/></svg>'),
    ],
)
def test_every_notation_gives_the_same_room(tmp_path: Path, name: str, text: str) -> None:
    corners = load_polygon(saved(tmp_path, name, text))
    assert polygon_area(corners) == 12.0
    assert {corner.parts for corner in corners} == {(float(x), float(y)) for x, y in ELL}
    start = [corner.parts for corner in corners].index((0.0, 0.0))
    assert [corners[(start + k) % 6].parts for k in range(6)] == [(float(x), float(y)) for x, y in ELL]


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("a.json", "[[0, 0], [1, 0]]", "2 corners"),
        ("a.json", "[[0, 0], [1, 1], [2, 2]]", "one line"),
        ("a.json", "[[0, 0], [2, 2], [2, 0], [0, 2]]", "edges 1 and 3 cross"),
        ("a.json", "[[0, 0], [1, 0], [NaN, 2]]", "finite"),
        ("a.json", '[[0, 0], [1, 0], ["2", 2]]', 'point number 2 is ["2", 2]'),
        ("a.json", "[[0, 0]", "no JSON"),
        ("a.json", '{"room": []}', "no list of points"),
        ("a.svg", "<svg><path d='M 0 0 C 1 1 2 2 3 3 Z'/></svg>", "curve, `C`"),
        ("a.svg", "<svg><path d='M 0 0 L 1 0 1 1 Z M 5 5 L 6 5 6 6 Z'/></svg>", "more than one outline"),
        ("a.svg", "<svg><path d='M 0 0 L 1 0 1'/></svg>", "middle of a point"),
        ("a.svg", "<svg><g transform='scale(2)'><path d='M 0 0 L 1 0 1 1 Z'/></g></svg>", "transform"),
        ("a.svg", "<svg><circle r='1'/></svg>", "no `<path>`"),
        ("a.svg", "<svg", "no SVG"),
    ],
)
def test_what_is_no_polygon_is_refused(tmp_path: Path, name: str, text: str, reason: str) -> None:
    with pytest.raises(FileError) as refused:
        load_polygon(saved(tmp_path, name, text))
    assert refused.value.code == "polygon"
    assert reason in str(refused.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="file-missing"):
        load_polygon(tmp_path / "none.svg")
    with pytest.raises(FileError, match="file-format"):
        load_polygon(tmp_path / "room.txt")
