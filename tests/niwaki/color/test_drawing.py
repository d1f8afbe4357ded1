"""Drawings: regions, areas and neighbours agree with counts by hand; unreadable drawings give an error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from niwaki.color import Drawing
from niwaki.color.drawing import neighbours
from niwaki.color.svg import Artwork
from niwaki.errors import FileError
from PIL import Image

pytest.importorskip("resvg_py")

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 100 100">'


def drawing(tmp_path: Path, body: str, size: int = 100) -> Drawing:
    place = tmp_path / "drawing.svg"
    place.write_text(f"{HEAD}{body}</svg>", encoding="utf-8")
    return Drawing.load(place, size)


def area_of(picture: Drawing, name: str) -> float:
    return float(picture.areas[picture.names.index(name)])


def test_neighbours_lie_within_two_pixels_across_or_diagonally() -> None:
    labels = np.full((9, 12), -1)
    labels[0, 0], labels[2, 2] = 0, 1  # two apart in both directions: neighbours
    labels[0, 6], labels[0, 9] = 2, 3  # three apart: no neighbours
    labels[6, 1], labels[8, 0] = 4, 5  # down and to the left
    assert neighbours(labels, 6) == [(0, 1), (4, 5)]
    assert neighbours(labels, 6, near=3) == [(0, 1), (2, 3), (4, 5)]
    assert neighbours(labels, 6, near=1) == []


def test_neighbours_agree_with_a_comparison_of_all_pairs_of_pixels() -> None:
    for seed in range(5):
        labels = np.random.default_rng(seed).integers(-1, 5, (7, 6)) * (
            np.random.default_rng(seed + 9).random((7, 6)) < 0.3
        )
        close = set()
        for y, x in np.ndindex(labels.shape):
            for v, u in np.ndindex(labels.shape):
                a, b = int(labels[y, x]), int(labels[v, u])
                if max(abs(y - v), abs(x - u)) <= 2 and 0 <= a < b:
                    close.add((a, b))
        assert neighbours(labels, 5) == sorted(close)


def test_areas_are_shares_of_the_whole_picture(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path, '<rect class="a" width="50" height="40"/><rect class="b" x="50" width="30" height="40"/>'
    )
    assert picture.names == ("a", "b")
    assert picture.areas == pytest.approx([0.2, 0.12])
    assert picture.pairs == [(0, 1)]
    assert picture.background is None  # most of the edge has no region


def test_an_image_has_a_region_for_each_opaque_colour(tmp_path: Path) -> None:
    image = Image.new("RGBA", (10, 10), (255, 0, 0, 255))
    image.paste((0, 0, 255, 255), (2, 2, 6, 8))
    image.paste((9, 9, 9, 0), (9, 9, 10, 10))
    image.save(tmp_path / "flat.png")
    picture = Drawing.load(tmp_path / "flat.png")
    assert picture.names == ("#0000ff", "#ff0000")
    assert picture.areas == pytest.approx([0.24, 0.75])
    assert picture.background == 1
    swapped = picture.picture({"#0000ff": "#00ff00"})
    assert swapped.getpixel((3, 3)) == (0, 255, 0, 255) and swapped.getpixel((9, 9))[3] == 0


def test_classes_come_before_ids_and_the_nearest_group_counts(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path,
        '<g id="all"><g class="roof big" transform="translate(10 10)"><g transform="scale(2)">'
        '<path id="path12" d="M0 0h10v10h-10z"/></g></g>'
        '<rect id="wall" x="60" width="10" height="10"/></g>',
    )
    assert picture.names == ("roof", "wall")
    assert area_of(picture, "roof") == pytest.approx(0.04)
    assert (picture.labels[10:30, 10:30] == 0).all()


def test_holes_strokes_and_sheets(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path,
        "<style>.line { fill: none; stroke: black } #ghost { display: none }</style>"
        '<rect class="back" width="100" height="100"/>'
        '<path class="ring" fill-rule="evenodd" d="M10 10h40v40h-40zm10 10v20h20v-20z"/>'
        '<path class="line" stroke-width="4" d="M60 20h30"/>'
        '<rect id="ghost" width="90" height="90"/>'
        '<rect class="framed" data-stroke="line" x="60" y="60" width="20" height="20" stroke="#fff" stroke-width="4"/>',
    )
    assert picture.names == ("back", "ring", "line", "framed")
    assert area_of(picture, "ring") == pytest.approx(0.12)
    assert area_of(picture, "framed") == pytest.approx(16 * 16 / 1e4)
    assert area_of(picture, "line") == pytest.approx((30 * 4 + 24 * 24 - 16 * 16) / 1e4)
    assert picture.background == 0


def test_each_use_may_have_its_own_region(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path,
        '<defs><rect id="tile" width="10" height="10"/>'
        '<symbol id="sign" viewBox="0 0 10 10"><circle r="5" cx="5" cy="5"/></symbol></defs>'
        '<use href="#tile" class="a" x="0" y="0"/>'
        '<use xlink:href="#tile" class="b" transform="translate(20 0) scale(2)"/>'
        '<use class="c" href="#sign" x="50" y="50" width="40" height="40"/>',
    )
    assert picture.names == ("a", "b", "c")
    assert picture.areas[:2] == pytest.approx([0.01, 0.04])
    assert area_of(picture, "c") == pytest.approx(np.pi * 0.04, rel=0.02)


def test_see_through_shapes_and_clips_are_counted_whole(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path,
        '<clipPath id="half"><circle cx="50" cy="50" r="30"/></clipPath>'
        '<rect class="a" width="100" height="100"/>'
        '<g opacity=".3"><rect class="b" clip-path="url(#half)" fill-opacity=".5" width="100" height="50"/></g>',
        200,
    )
    assert area_of(picture, "b") == pytest.approx(np.pi * 0.09 / 2, rel=0.02)
    assert picture.areas.sum() == pytest.approx(1.0)


def test_painting_changes_only_regions(tmp_path: Path) -> None:
    body = (
        "<style>.a { fill: #111111 !important }</style>"
        '<rect class="a" width="100" height="100"/><rect width="10" height="10" fill="#00ff00"/>'
        '<g fill="#0000ff"><rect class="b" x="50" width="10" height="10"/></g>'
    )
    picture = drawing(tmp_path, body)
    image = picture.picture({"a": "#ff0000", "b": "#ffffff"}, 100)
    assert image.getpixel((80, 80)) == (255, 0, 0, 255)
    assert image.getpixel((5, 5)) == (0, 255, 0, 255)
    assert image.getpixel((55, 5)) == (255, 255, 255, 255)
    assert picture.picture({}, 100).getpixel((80, 80)) == (17, 17, 17, 255)
    text = picture.artwork.painted({"a": "#ff0000"})
    assert Artwork(text.encode()).names == ("a", "b")


def test_shapes_without_a_name_belong_to_no_region(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path,
        '<rect class="a" width="50" height="100"/><rect class="b" x="50" width="50" height="100"/>'
        '<path d="M40 40h20v20h-20z" fill="#123456"/><path d="M20 20h2v2h-2z" fill="none" stroke="red"/>',
    )
    assert (picture.labels[40:60, 40:60] == -1).all() and picture.areas.sum() < 0.96
    assert picture.picture({"a": "#ffffff"}, 100).getpixel((50, 50)) == (0x12, 0x34, 0x56, 255)


def test_a_covered_region_is_hidden(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path, '<rect class="a" width="9" height="9"/><rect class="b" width="99" height="99"/>'
    )
    assert picture.hidden == ("a",)


@pytest.mark.parametrize("name", ["robot", "house", "bug", "rocket"])
def test_the_packages_drawings_have_ten_to_twenty_visible_regions(name: str) -> None:
    picture = Drawing.load(name)
    assert 10 <= len(picture.names) <= 20 and picture.hidden == ()
    assert picture.areas.sum() == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("body", "code", "message"),
    [
        ('<rect width="9" height="9"/>', "drawing-no-regions", "no painted shape with a class or an id"),
        ('<rect class="a" width="9" height="9"/>', "drawing-no-regions", "one region, `a`"),
        ('<g id="a"><use href="#a"/></g>', "drawing-unclear", "`#a` uses itself"),
        ("<style>g > path { fill: none }</style>", "drawing-unclear", "`g > path`"),
        ("<g>" * 300 + "</g>" * 300, "file-limit", "201 levels"),
        ("<g>", "file-unreadable", "not XML"),
        (
            "<defs>"
            + "".join(f'<g id="g{k}">' + f'<use href="#g{k + 1}"/>' * 10 + "</g>" for k in range(9))
            + '<g id="g9"/></defs><use href="#g0"/>',
            "file-limit",
            "more than 20,000 elements",
        ),
    ],
)
def test_a_drawing_that_cannot_be_read_gives_an_error(
    tmp_path: Path, body: str, code: str, message: str
) -> None:
    with pytest.raises(FileError) as caught:
        drawing(tmp_path, body)
    assert caught.value.code == code and message in str(caught.value)


def test_images_without_flat_regions_give_an_error(tmp_path: Path) -> None:
    Image.new("RGB", (4, 4), (1, 2, 3)).save(tmp_path / "one.png")
    noise = np.random.default_rng(1).integers(0, 255, (40, 40, 3)).astype(np.uint8)
    Image.fromarray(noise).save(tmp_path / "photo.png")
    (tmp_path / "cut.png").write_bytes((tmp_path / "photo.png").read_bytes()[:200])
    codes = {"one.png": "drawing-no-regions", "photo.png": "drawing-too-many", "cut.png": "file-unreadable"}
    for name, code in codes.items():
        with pytest.raises(FileError) as caught:
            Drawing.load(tmp_path / name)
        assert caught.value.code == code
    with pytest.raises(FileError, match="file-missing"):
        Drawing.load(tmp_path / "none.svg")


@pytest.mark.parametrize("margin", [0, 3, 12])
def test_the_background_is_found_inside_a_frame_without_a_region(tmp_path: Path, margin: int) -> None:
    side = 100 - 2 * margin
    picture = drawing(
        tmp_path,
        f'<rect class="sky" x="{margin}" y="{margin}" width="{side}" height="{side}"/>'
        '<rect class="house" x="30" y="30" width="40" height="40"/>',
    )
    assert picture.background == picture.names.index("sky")


def test_a_figure_that_touches_little_of_the_edge_is_no_background(tmp_path: Path) -> None:
    picture = drawing(
        tmp_path,
        '<rect class="stem" x="45" y="40" width="10" height="60"/>'
        '<rect class="leaf" x="20" y="20" width="40" height="20"/>',
    )
    assert picture.background is None
