"""Claim: a mesh file is read as its format says, or refused with what is wrong in it; other programs read the same."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import trimesh
from mesh_corpus import CASES, DART, Case, U, f, prism, v
from niwaki._engine import Target as Filled
from niwaki.errors import FileError
from niwaki.targets.target import Target, TargetWarning
from numpy.typing import ArrayLike, NDArray

ASSIMP = shutil.which("assimp")


def written(case: Case, folder: Path) -> Path:
    """The file of a case."""
    for name, data in case.beside:
        (folder / name).write_bytes(data)
    path = folder / f"case{case.suffix}"
    path.write_bytes(case.data)
    return path


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.slug)
def test_a_trap_is_read_right_or_refused(case: Case, tmp_path: Path) -> None:
    path = written(case, tmp_path)
    if case.refused:
        with pytest.raises(FileError) as error:
            Target.load(path)
        assert case.refused in str(error.value) and str(path) in str(error.value)
        return
    # A surface with open edges is warned of, and a warning fails here.
    mesh = Target.load(path)
    assert case.agrees(mesh.vertices[mesh.faces])


@pytest.mark.skipif(ASSIMP is None, reason="assimp is not installed")
@pytest.mark.parametrize("case", [case for case in CASES if not case.assimp], ids=lambda case: case.slug)
def test_assimp_gives_the_same_answer(case: Case, tmp_path: Path) -> None:
    corners = by_assimp(written(case, tmp_path), tmp_path / "out.stl")
    assert (corners is None) if case.refused else corners is not None and case.agrees(corners)


def by_assimp(path: Path, out: Path) -> NDArray[np.float64] | None:
    """The triangles that assimp writes into a binary STL file, (n, 3, 3); nothing where it refuses."""
    done = subprocess.run([str(ASSIMP), "export", path, out, "-fstlb"], capture_output=True, timeout=60)
    if done.returncode or not out.exists():
        return None
    rows = np.frombuffer(out.read_bytes(), [("n", "<f4", 3), ("p", "<f4", (3, 3)), ("a", "<u2")], offset=84)
    return rows["p"].astype(np.float64)


def cells(vertices: ArrayLike, faces: ArrayLike, voxel: float) -> int:
    """How many cells a mesh fills."""
    return Filled(np.array(vertices, np.float64), np.array(faces, np.int64), voxel).filled


@pytest.mark.parametrize("outline", [U, DART], ids=["U", "dart"])
def test_the_cells_of_a_polygon_do_not_depend_on_its_triangles(
    outline: list[tuple[float, float]], tmp_path: Path
) -> None:
    vertices, polygons = prism(outline, 2.0)
    (tmp_path / "a.obj").write_text(v(vertices) + f(polygons))
    right = Target.load(tmp_path / "a.obj")
    count = len(outline)
    for first in range(count):
        # What other programs may have cut: all triangles from one corner.
        turned = [(*face[first % len(face) :], *face[: first % len(face)]) for face in polygons]
        fans = [(face[0], face[k], face[k + 1]) for face in turned for k in range(1, len(face) - 1)]
        for voxel in (0.5, 0.21, 0.1):
            assert cells(vertices, fans, voxel) == cells(right.vertices, right.faces, voxel)


def test_a_polygon_fills_the_cells_of_the_boxes_that_it_is_made_of() -> None:
    vertices, polygons = prism(U, 2.0)
    fans = [(face[0], face[k], face[k + 1]) for face in polygons for k in range(1, len(face) - 1)]
    boxes = [((0, 0, 0), (3, 1, 2)), ((0, 0, 0), (1, 3, 2)), ((2, 0, 0), (3, 3, 2))]
    for voxel in (0.5, 0.26, 0.21, 0.1):
        grid = Filled(np.array(vertices, np.float64), np.array(fans), voxel)
        low, high = map(np.array, grid.domain)
        size = (high - low) / grid.dims
        expected = np.zeros(grid.dims, bool)
        for ends in boxes:
            # A cell is touched up to a millionth of its size.
            first, last = (
                np.floor((np.array(end) - low) / size + by).astype(int)
                for end, by in zip(ends, (-1e-6, 1e-6), strict=True)
            )
            expected[tuple(slice(a, b + 1) for a, b in zip(first, last, strict=True))] = True
        assert grid.filled == expected.sum()


def test_a_hole_is_filled_where_no_voxel_goes_through() -> None:
    box = trimesh.creation.box((4.0, 4.0, 4.0)).subdivide().subdivide().subdivide()
    # A hole of 0.5 by 0.5 in the middle of the top.
    middle = box.vertices[box.faces].mean(axis=1)
    hole = (middle[:, 2] > 1.9) & (np.abs(middle[:, :2] - 0.25) < 0.25).all(axis=1)
    with pytest.warns(TargetWarning, match="through a hole wider than a voxel the outside comes in"):
        opened = Target(box.vertices, box.faces[~hole])
    closed = Target(box.vertices, box.faces)
    few, many = (
        [cells(mesh.vertices, mesh.faces, voxel) for mesh in (opened, closed)] for voxel in (0.7, 0.1)
    )
    assert few[0] == few[1]
    assert many[0] < 0.4 * many[1]


def test_a_surface_within_another_makes_no_hole() -> None:
    outer, inner = trimesh.creation.box((4.0, 4.0, 4.0)), trimesh.creation.box((2.0, 2.0, 2.0))
    vertices = [*outer.vertices, *inner.vertices]
    inwards = [*outer.faces, *(inner.faces[:, ::-1] + 8)]
    outwards = [*outer.faces, *(inner.faces + 8)]
    alone = cells(outer.vertices, outer.faces, 0.1)
    assert cells(vertices, inwards, 0.1) == cells(vertices, outwards, 0.1) == alone
