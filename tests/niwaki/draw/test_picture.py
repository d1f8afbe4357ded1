"""Claim: a picture has the given size, equal bytes on any number of threads, and the right subject."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from niwaki import _engine
from niwaki.draw.picture import picture
from niwaki.draw.scene import Scene
from niwaki.errors import FileError, InputError
from niwaki.targets import examples as targets
from PIL import Image

SMALL = {"size": (120, 90), "samples": 4}


def block(color: tuple[float, float, float] = (0.8, 0.2, 0.1)) -> Scene:
    return Scene([("block", [_engine.shape("box", (0, 1, 0), (2, 2, 2), color=color)])])


def test_size_and_subject() -> None:
    pixels = np.asarray(picture(block(), **SMALL), dtype=float)
    assert pixels.shape == (90, 120, 4)
    middle, corner = pixels[40:50, 55:65, :3].mean(axis=(0, 1)), pixels[:5, :5, :3].mean(axis=(0, 1))
    assert middle[0] > 2 * middle[2], "the block is red"
    assert corner.min() > 220, "the backdrop is light"
    assert (pixels[..., 3] == 255).all()


def test_shadow_falls_on_the_floor_and_fades() -> None:
    alpha = np.asarray(picture(block(), backdrop="clear", **SMALL))[..., 3]
    assert (alpha[0] == 0).all() and alpha[45, 60] == 255
    assert ((alpha > 20) & (alpha < 235)).sum() > 100


def test_a_white_page_stays_white() -> None:
    pixels = np.asarray(picture(block(), backdrop="white", **SMALL))
    assert (pixels[0] == 255).all()


def test_the_ghost_shows_only_where_it_is_in_front() -> None:
    with_ghost = np.asarray(picture(block(), targets.ship(), elevation=60, **SMALL), dtype=int)
    frame = Scene(
        [("f", [_engine.shape("mesh", targets.ship().vertices, targets.ship().faces)]), *block().parts]
    )
    without = np.asarray(picture(block(), elevation=60, frame=frame, **SMALL), dtype=int)
    changed = np.abs(with_ghost - without).sum(axis=2) > 6
    assert 0.05 < changed.mean() < 0.6


def test_the_same_bytes_on_one_thread_and_four() -> None:
    program = (
        "import hashlib, numpy as np; from niwaki import _engine\n"
        "from niwaki.targets import examples as targets\n"
        "from niwaki.draw.scene import Scene\n"
        "s = Scene([('a', [_engine.shape('cylinder', (0, 0, 0), 1.0, 3.0, 'x')])])\n"
        "p = s.picture(targets.ship(), size=(96, 64), samples=5)\n"
        "print(hashlib.sha256(np.asarray(p).tobytes()).hexdigest())\n"
    )
    hashes = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "RAYON_NUM_THREADS": threads},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in ("1", "4")
    }
    assert len(hashes) == 1 and len(hashes.pop().strip()) == len(hashlib.sha256().hexdigest())


def test_framing_shows_every_corner() -> None:
    points = np.array([[x, y, z] for x in (-9.0, 9.0) for y in (0.0, 3.0) for z in (-10.0, 5.0)])
    eye, target, up, fov = _engine.frame_camera(_engine.Surfaces([]), points, aspect=1.5, margin=0.1)
    forward = np.subtract(target, eye) / np.linalg.norm(np.subtract(target, eye))
    right = np.cross(forward, up) / np.linalg.norm(np.cross(forward, up))
    rays = points - eye
    half = np.tan(np.radians(fov) / 2)
    x = rays @ right / (rays @ forward) / (half * 1.5)
    y = rays @ np.cross(right, forward) / (rays @ forward) / half
    assert max(np.abs(x).max(), np.abs(y).max()) == pytest.approx(0.8, abs=1e-3)


def test_saving_by_suffix(tmp_path: Path) -> None:
    for suffix in ("png", "jpg", "webp"):
        path = block().save(tmp_path / f"block.{suffix}", **SMALL)
        with Image.open(path) as image:
            assert image.size == (120, 90)
    with pytest.raises(FileError, match="file-format"):
        block().save(tmp_path / "block.tiffany", **SMALL)


def test_bad_settings_are_refused() -> None:
    with pytest.raises(FileError, match="scene-empty"):
        picture(Scene([]))
    with pytest.raises(FileError, match="backdrop"):
        picture(block(), backdrop="beach")  # type: ignore[arg-type]
    for settings in ({"size": (0, 10)}, {"size": (10, 10), "samples": 0}):
        with pytest.raises(InputError, match=r"width|samples"):
            picture(block(), **settings)
