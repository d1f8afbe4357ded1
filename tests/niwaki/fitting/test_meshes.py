"""Claim: the meshes of all libraries are read as the same vertices and faces; what is no mesh is refused in words."""

from __future__ import annotations

import io
from types import SimpleNamespace

import manifold3d
import niwaki as nw
import numpy as np
import pytest
import trimesh
from fit_hosts import CORNERS, block
from niwaki.fitting.meshes import NotAMesh, defects, mesh_of

VERTICES, FACES = block(2.0, 1.0, 1.0)


def volume(value):
    vertices, faces = mesh_of(value)
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


class Kernel:
    """A shape of a CAD kernel: corners with X, Y, Z, and triangles as tuples."""

    def bounding_box(self):
        return SimpleNamespace(diagonal=5.0)

    def tessellate(self, tolerance, angle):
        assert tolerance == pytest.approx(0.01) and angle == pytest.approx(0.3)
        corners = [SimpleNamespace(X=x, Y=y, Z=z) for x, y, z in VERTICES]
        return corners, [tuple(face) for face in FACES.tolist()]


class Lower(Kernel):
    """A shape by the words of another kernel."""

    bounding_box = None

    def BoundingBox(self):  # noqa: N802
        return SimpleNamespace(DiagonalLength=5.0)

    def tessellate(self, tolerance, angle):
        corners, triangles = super().tessellate(tolerance, angle)
        return [SimpleNamespace(x=c.X, y=c.Y, z=c.Z) for c in corners], triangles


def glb():
    return trimesh.Trimesh(VERTICES, FACES).export(file_type="glb")


def stl():
    return trimesh.Trimesh(VERTICES, FACES).export(file_type="stl")


MESHES = {
    "arrays": lambda: (VERTICES, FACES),
    "lists": lambda: (VERTICES.tolist(), FACES.tolist()),
    "trimesh": lambda: trimesh.Trimesh(VERTICES, FACES),
    "scene of trimesh": lambda: trimesh.Scene([trimesh.Trimesh(VERTICES, FACES)]),
    "manifold": lambda: manifold3d.Manifold.cube((2.0, 1.0, 1.0)),
    "mesh of manifold": lambda: manifold3d.Manifold.cube((2.0, 1.0, 1.0)).to_mesh(),
    "kernel": Kernel,
    "lower": Lower,
    "builder": lambda: SimpleNamespace(part=Kernel()),
    "workplane": lambda: SimpleNamespace(vals=lambda: [Lower()]),
    "glb": glb,
    "stl": stl,
    "shape": lambda: nw.box((0, 0.5, 0), (2.0, 1.0, 1.0)),
    "two halves": lambda: [block(2.0, 0.5, 1.0), [block(2.0, 0.5, 1.0, 0.5)]],
}


@pytest.mark.parametrize("name", MESHES)
def test_every_kind_of_mesh_has_the_same_volume(name):
    assert volume(MESHES[name]()) == pytest.approx(2.0, rel=1e-5)


def test_faces_of_four_corners_are_cut_in_two():
    quads = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
    assert volume((VERTICES, quads)) == pytest.approx(2.0) and len(mesh_of((VERTICES, quads))[1]) == 12


def test_a_path_is_read_and_an_empty_mesh_is_empty(tmp_path):
    (tmp_path / "box.stl").write_bytes(stl())
    assert volume(tmp_path / "box.stl") == pytest.approx(2.0, rel=1e-5)
    for empty in (None, [], (np.zeros((0, 3)), np.zeros((0, 3), int)), manifold3d.Manifold()):
        assert not len(mesh_of(empty)[1])


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (3.0, "it returned 3.0"),
        (io.BytesIO(), "and not a mesh"),
        ((VERTICES, FACES + 1), "a face has the corner 8, and there are 8 vertices"),
        ((VERTICES * np.nan, FACES), "not finite"),
        ((VERTICES[:, :2], FACES), "the shape (8, 2)"),
        ((VERTICES, FACES[:, :2]), "the shape (12, 2)"),
    ],
)
def test_what_is_no_mesh_is_refused_in_words(value, text):
    with pytest.raises(NotAMesh) as error:
        mesh_of(value)
    assert text in str(error.value)


def test_defects_are_named():
    assert defects(VERTICES, CORNERS) == []
    assert defects(VERTICES, CORNERS[:-1]) == ["open"]
    assert defects(VERTICES, CORNERS[:, ::-1]) == ["inverted"]
    assert defects(VERTICES * (1.0, 0.0, 1.0), CORNERS) == ["flat"]
    # A soup of triangles repeats its corners.
    assert defects(VERTICES[CORNERS.ravel()], np.arange(36).reshape(-1, 3)) == []
