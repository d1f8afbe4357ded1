"""Claim: a warning names the user's line that called the package, however deep in the package its cause is."""

from __future__ import annotations

import inspect
import warnings
from pathlib import Path

import niwaki as nw
from niwaki import targets


def test_warnings_name_the_users_line(tmp_path: Path) -> None:
    open_box = nw.Target.of_shapes(nw.box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))
    faces = open_box.faces[1:]
    file = tmp_path / "open.obj"
    file.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in open_box.vertices.tolist()))
    with file.open("a") as text:
        text.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces.tolist())
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        nw.Target(open_box.vertices, faces)
        line = inspect.currentframe().f_lineno - 1  # type: ignore[union-attr]
        targets.asks.score(targets.asks.sketches_of({"target": str(file)}))
    assert [warning.filename for warning in caught] == [__file__] * 2
    assert [warning.lineno for warning in caught] == [line, line + 2]
