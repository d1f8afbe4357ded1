"""Claim: a table has each extra, and the error about a missing extra has the command that installs it."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import cast
from unittest import mock

import niwaki as nw
import numpy as np
import pytest
from niwaki import box, emit, model
from niwaki.batches import clusters, tables
from niwaki.color.raster import raster
from niwaki.errors import FileError
from niwaki.errors.extras import EXTRAS, optional
from niwaki.notebook.viewer import View
from niwaki.result import diagnostics
from niwaki.shell.app import app
from niwaki.stacks import judges
from typer.testing import CliRunner

#: Extras for the development of the package.
INTERNAL = {"bench", "bench-fit", "bench-hmc", "browser", "build", "docs", "guides-oracle", "lint", "test"}


@model
def cube():
    emit(box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))


def printed(folder: Path) -> None:
    nw.run(cube, method=nw.forward(1), seed=1).export(folder / "cube.stl")


def in_the_studio(_: Path) -> None:
    sys.modules.pop("niwaki.studio.serving", None)
    raise cast(Exception, CliRunner().invoke(app, ["studio", "--no-browser"]).exception)


def by_tools(folder: Path) -> None:
    # As if no earlier test had loaded the server and the parts of its library.
    loaded = [name for name in sys.modules if name == "niwaki.agents.server" or name.startswith("mcp.")]
    with mock.patch.dict(sys.modules):
        for name in loaded:
            del sys.modules[name]
        raise cast(Exception, CliRunner().invoke(app, ["mcp", str(folder)]).exception)


def on(engine: str) -> Callable[[Path], object]:
    return lambda _: clusters.ENGINES[engine](1).__enter__()


#: An extra, a library of it, and a function that needs the library.
NEEDS: list[tuple[str, str, Callable[[Path], object]]] = [
    ("arviz", "arviz", lambda _: diagnostics.to_arviz({"x": np.zeros((2, 10))})),
    ("cluster", "distributed", on("dask")),
    ("cluster", "ray", on("ray")),
    ("color", "resvg_py", lambda _: raster("<svg/>", 8)),
    ("mcp", "mcp", by_tools),
    ("notebook", "anywidget", lambda _: View([]).widget()),
    ("parquet", "pyarrow", lambda folder: tables.write_parquet(folder / "a.parquet", {}, [])),
    ("print", "manifold3d", printed),
    ("stacks", "scipy.sparse", lambda _: judges.need("scipy.sparse")),
    ("studio", "uvicorn", in_the_studio),
]


@pytest.mark.parametrize(("extra", "library", "use"), NEEDS, ids=[library for _, library, _ in NEEDS])
def test_the_error_about_a_missing_extra_has_the_command(
    extra: str, library: str, use: Callable[[Path], object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(FileError) as caught:
        use(tmp_path)
    assert caught.value.code == "missing-extra"
    assert f"`pip install 'niwaki[{extra}]'`" in str(caught.value)


def test_the_table_has_every_extra_that_users_install() -> None:
    project = Path(__file__).parents[3] / "pyproject.toml"
    extras = tomllib.loads(project.read_text())["project"]["optional-dependencies"]
    assert set(EXTRAS) == set(extras) - INTERNAL == {extra for extra, _, _ in NEEDS}


#: A module of Python that another system has, and a library that the system lacks.
FAILURES = {
    "_winapi" if sys.platform != "win32" else "resource": "import {}",
    "libGL.so.1": 'raise OSError("{}: not found")',
}


@pytest.mark.parametrize("missing", FAILURES)
def test_the_error_about_a_broken_library_has_the_reason(
    missing: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a_broken_library.py").write_text(FAILURES[missing].format(missing))
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "a_broken_library", raising=False)
    with pytest.raises(FileError, match=missing) as caught:
        optional("a_broken_library", "judging", "stacks")
    assert caught.value.code == "broken-extra"
