"""Claim: a scene is a multiset of parts in the order of their addresses, with correct bounds and meshes."""

from __future__ import annotations

import numpy as np
from niwaki import _engine
from niwaki.draw.scene import Scene


def test_the_order_of_emission_does_not_matter() -> None:
    a, b = _engine.shape("box", (0, 0, 0), (1, 1, 1)), _engine.shape("cylinder", (3, 0, 0), 0.5, 2.0)
    first = Scene([("wing[10]", [a]), ("wing[9]", [b]), ("body", [a])])
    second = Scene([("body", [a]), ("wing[9]", [b]), ("wing[10]", [a])])
    assert [part.address for part in first] == ["body", "wing[9]", "wing[10]"]
    assert first.parts == second.parts


def test_bounds_and_meshes() -> None:
    scene = Scene(
        [
            ("a", [_engine.shape("box", (0, 0, 0), (2, 2, 2))]),
            ("b", [_engine.shape("box", (4, 0, 0), (2, 2, 2))]),
        ]
    )
    assert scene.bounds.tolist() == [[-1, -1, -1], [5, 1, 1]]
    for fine in (False, True):
        vertices, faces = scene.merged(fine)
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        assert 15.5 < volume <= 16.0 + 1e-9
    assert len(Scene([])) == 0 and Scene([]).bounds.tolist() == [[0, 0, 0], [0, 0, 0]]


def test_a_group_has_the_meshes_of_its_shapes() -> None:
    box = _engine.shape("box", (1, 2, 3), (2, 2, 2))
    limb = _engine.shape("limb", (4, 0, 0), (4, 1, 0), 0.2, 0.1)
    for fine in (False, True):
        group, first, second, empty = _engine.meshes([[box, limb], [box], [limb], []], fine=fine)
        assert [array.dtype.name for array in group[:3]] == ["float64", "uint32", "float64"]
        for joined, left, right, start in zip(
            group[:3], first[:3], second[:3], (0, len(first[0]), 0), strict=True
        ):
            assert np.array_equal(joined, np.concatenate([left, right + start]))
        assert len(group[2]) == (len(group[0]) if fine else 0)
        assert group[3][0].tolist() == first[3][0].tolist() == [1, 2, 3]
        assert second[3][0].tolist() == [4, 0, 0]
        assert [array.shape for array in empty[:3]] == [(0, 3)] * 3
    light = _engine.meshes([[limb]], fine=False)[0]
    assert np.array_equal(light[0], limb.vertices()) and np.array_equal(light[1], limb.faces())


def test_notebooks_show_a_png() -> None:
    scene = Scene([("a", [_engine.shape("box", (0, 0, 0), (2, 2, 2))])])
    assert scene._repr_png_().startswith(b"\x89PNG")
    assert Scene([])._repr_png_().startswith(b"\x89PNG")
