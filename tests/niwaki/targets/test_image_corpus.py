"""Claim: a silhouette or a drawing is read as a person sees it, in every form of file that people have."""

from __future__ import annotations

import base64
import io
from pathlib import Path

import numpy as np
import pytest
from niwaki.targets.images import ink, silhouette
from PIL import Image

CORPUS = Path(__file__).parents[2] / "corpus" / "images"
LETTER = np.array(
    [[sign == "#" for sign in line] for line in (CORPUS / "letter.txt").read_text().splitlines()]
)


def named(tone: str) -> list[str]:
    return sorted(place.name for place in CORPUS.glob(f"{tone}-*"))


def test_the_corpus_is_whole() -> None:
    assert len(named("light")) == len(named("dark")) == 51


@pytest.mark.parametrize("name", named("light"))
def test_a_silhouette_is_what_is_seen(name: str) -> None:
    assert np.array_equal(silhouette(CORPUS / name), LETTER)


@pytest.mark.parametrize("name", named("dark"))
def test_a_drawing_is_what_is_seen(name: str) -> None:
    assert np.array_equal(ink(CORPUS / name) < 255, LETTER)


@pytest.mark.parametrize("name", named("light") + named("dark"))
def test_an_image_of_pillow_is_read_as_its_file(name: str) -> None:
    with Image.open(CORPUS / name) as image:
        if name.startswith("light"):
            assert np.array_equal(silhouette(image), LETTER)
        else:
            assert np.array_equal(ink(image), ink(CORPUS / name))


def judged(name: str) -> bool:
    """Whether resvg reads a form: no TIFF, BMP and CMYK; it turns no image, and cuts 16 bits otherwise."""
    return not name.endswith((".tif", ".bmp")) and not any(
        form in name for form in ("exif-", "xmp-", "16-", "cmyk")
    )


@pytest.mark.parametrize("name", [*filter(judged, named("light"))])
def test_another_reader_sees_the_same_letter(name: str) -> None:
    resvg_py = pytest.importorskip("resvg_py", reason="resvg is the other reader")
    kind = Path(name).suffix.removeprefix(".").replace("jpg", "jpeg")
    data = base64.b64encode((CORPUS / name).read_bytes()).decode()
    rows, columns = LETTER.shape
    page = f'width="{columns}" height="{rows}"'
    text = f'<image {page} href="data:image/{kind};base64,{data}"/>'
    drawn = resvg_py.svg_to_bytes(svg_string=f'<svg xmlns="http://www.w3.org/2000/svg" {page}>{text}</svg>')
    seen = np.asarray(Image.open(io.BytesIO(bytes(drawn))).convert("RGBA"))
    assert np.array_equal((seen[:, :, 0] >= 128) & (seen[:, :, 3] >= 128), LETTER)
