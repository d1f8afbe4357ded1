"""Claim: the panels show the wanted picture, the actual one and their difference, each in its colour."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.targets.views import INK, MISSING, PAPER, SHADE, SURPLUS, eye, save_view, view_sheet
from PIL import Image

ON = np.zeros((100, 100), dtype=bool)
ON[20:60, 20:80] = True


def scene(*boxes: tuple[Any, Any]) -> Scene:
    return Scene([(f"{k}", [_engine.shape("box", *box)]) for k, box in enumerate(boxes)])


def test_panels_of_a_silhouette() -> None:
    score = nw.match_image(ON, nw.Camera.orthographic((0, 0, 20), (0, 0, 0), height=10))
    # Rows 40 to 80: half of it is wanted.
    page = view_sheet(scene(((0, -1, 0), (6, 4, 1))), score.views[0], height=200, samples=1, captions=False)
    width = 202
    colors = [[page.getpixel((k * width + 100, y)) for y in (20, 60, 100, 140, 190)] for k in range(3)]
    assert colors == [
        [PAPER, INK, INK, PAPER, PAPER],
        [PAPER, PAPER, INK, INK, PAPER],
        [PAPER, MISSING, INK, SURPLUS, PAPER],
    ]
    # The scene itself is where its silhouette is, to a pixel.
    panel = np.asarray(page.crop((3 * width, 0, 3 * width + 200, 200)))
    rows = np.nonzero((np.abs(panel.astype(int) - PAPER).sum(axis=2) > 40)[:, 100])[0]
    assert (rows.min(), rows.max()) == (pytest.approx(80, abs=2), pytest.approx(159, abs=2))


def test_a_shadow_lies_under_its_scene_and_an_empty_scene_is_paper(tmp_path: Path) -> None:
    above = nw.Camera.perspective((0, 30, 0), (0, 0, 0), (0, 0, -1))
    score = nw.match_shadow(ON, (-1, -1, 0), nw.Receiver.floor(0, (-9, -9), (9, 9)), above)
    page = view_sheet(scene(((4, 4, 0), (2, 2, 2))), score.views[0], height=120, samples=1)
    last = page.crop((3 * 122, 0, 3 * 122 + 120, 120))
    # The middle of the shadow is at the origin.
    assert last.getpixel((60, 60)) == SHADE and last.getpixel((60, 110)) == PAPER
    path = save_view(tmp_path / "empty.png", Scene([]), score.views[0], height=60)
    with Image.open(path) as image:
        assert image.size == (4 * 62 - 2, 60 + round(2.2 * 11))


def test_parallel_rays_come_from_far_away() -> None:
    position, look_at, _, fov = eye(nw.Camera.orthographic((0, 0, 5), (0, 0, 0), height=4))
    assert look_at == (0, 0, 0) and fov < 2 and position[2] > 100
