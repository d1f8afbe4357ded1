"""Claim: a pixel is on where its red is at least half of the brightest, whatever the format; no image is an error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from niwaki import InputError
from niwaki.errors import FileError
from niwaki.targets.images import silhouette, weights
from PIL import Image

ON = np.zeros((20, 30), dtype=bool)
ON[5:9, 3:25] = True
GREY = (ON * 200).astype(np.uint8)


@pytest.mark.parametrize("mode", ["1", "L", "RGB", "RGBA", "P", "I;16"])
def test_modes_agree(tmp_path: Path, mode: str) -> None:
    grey = Image.fromarray(GREY, "L")
    if mode == "I;16":
        image = Image.fromarray(GREY.astype(np.uint16) * 250)
    else:
        # Two colours by threshold: dithering would scatter the grey.
        image = Image.fromarray(ON) if mode == "1" else grey.convert("RGB").convert(mode)
    image.save(tmp_path / "image.png")
    for source in (tmp_path / "image.png", str(tmp_path / "image.png"), image):
        assert (silhouette(source) == ON).all()


def test_arrays() -> None:
    for values in (ON, GREY, GREY / 255.0, np.stack([GREY] * 3, axis=2)):
        assert (silhouette(values) == ON).all()


def test_half_of_the_brightest_red_is_on() -> None:
    image = np.zeros((4, 4, 3), dtype=np.uint8)
    image[0, 0], image[0, 1], image[0, 2], image[1, 1] = (
        (200, 0, 0),
        (100, 0, 0),
        (99, 255, 255),
        (0, 255, 255),
    )
    for values in (image, image / 200.0, image.astype(np.int64) * 1000, image // 100):
        assert np.argwhere(silhouette(values)).tolist() == [[0, 0], [0, 1]]


def test_what_is_transparent_is_off_and_half_of_the_alpha_is_on() -> None:
    image = np.full((4, 4, 4), 255, dtype=np.uint8)
    image[1:, :, 3] = 0
    image[1, :2, 3] = 127, 128
    # The alpha says what is on, and the red may be dark there.
    image[0, 0, 0], image[0, 1, 0] = 1, 0
    assert np.argwhere(silhouette(Image.fromarray(image))).tolist() == [[0, 0], [0, 2], [0, 3], [1, 1]]
    image[:, :, 3] = 255
    assert silhouette(Image.fromarray(image)).sum() == 14


def test_a_jpeg_is_its_shape_at_any_quality(tmp_path: Path) -> None:
    for quality in (20, 50, 75, 95):
        Image.fromarray((ON * 255).astype(np.uint8)).save(tmp_path / "on.jpg", quality=quality)
        assert (silhouette(tmp_path / "on.jpg") == ON).all()


def test_weights_are_greys(tmp_path: Path) -> None:
    Image.fromarray(GREY, "L").save(tmp_path / "w.png")
    assert (weights(tmp_path / "w.png", ON) == GREY).all()
    assert weights(ON, ON).max() == 255


def test_refused(tmp_path: Path) -> None:
    (tmp_path / "text.png").write_text("no image")
    Image.fromarray(GREY, "L").save(tmp_path / "whole.png")
    (tmp_path / "cut.png").write_bytes((tmp_path / "whole.png").read_bytes()[:50])
    for name, code in (
        ("nowhere.png", "file-missing"),
        ("text.png", "file-unreadable"),
        ("cut.png", "file-unreadable"),
    ):
        with pytest.raises(FileError) as error:
            silhouette(tmp_path / name)
        assert error.value.code == code
    for values in (
        np.zeros(7),
        np.zeros((3, 3, 7)),
        np.zeros((0, 4)),
        np.array([["a"]]),
        np.full((3, 3), np.nan),
    ):
        with pytest.raises(InputError) as wrong:
            silhouette(values)
        assert wrong.value.code == "bad-image"
    for pixels in (np.zeros((5, 5), bool), np.ones((5, 5), bool)):
        with pytest.raises(InputError) as color:
            silhouette(pixels)
        assert color.value.code == "image-one-color"
    with pytest.raises(InputError) as size:
        weights(np.zeros((5, 5)), ON)
    assert size.value.code == "weight-size" and "5 x 5" in str(size.value) and "30 x 20" in str(size.value)
