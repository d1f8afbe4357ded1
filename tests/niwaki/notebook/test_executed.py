"""Claim: in a notebook that is run without a window, a result is a picture and its numbers, and a view is a frame.

Skipped where nbclient and a kernel are not installed.
"""

from __future__ import annotations

import pytest

CELLS = [
    "import niwaki as nw\nfrom niwaki.gallery.spaceship import spaceship",
    "result = nw.grow(spaceship, nw.targets.examples.ship(), particles=30, voxel=0.25, seed=1)\nresult",
    "nw.view(result.best)",
    "result.best.target",
]


def test_an_executed_notebook_shows_results():
    for name in ("nbclient", "ipykernel"):
        pytest.importorskip(name)
    import nbformat
    from nbclient import NotebookClient

    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in CELLS])
    NotebookClient(book, timeout=120, kernel_name="python3").execute()
    shown = [cell.outputs[0].data if cell.outputs else {} for cell in book.cells]
    assert "data:image/png;base64," in shown[1]["text/html"] and "image/png" in shown[1]
    assert shown[2]["text/html"].startswith("<iframe srcdoc=") and len(shown[2]["text/html"]) < 2_000_000
    assert "image/png" in shown[3]
