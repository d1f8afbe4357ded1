"""Claim: the README's first program runs as printed, and every picture in the README exists and is small."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import niwaki as nw
import pytest
from niwaki import box
from niwaki.draw.scene import Scene

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_first_program_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = re.search(r"```python\n(.*?)```", README, re.DOTALL)
    assert found is not None
    monkeypatch.chdir(tmp_path)
    Scene([("tower", [box((0, 3, 0), (3, 6, 3))])]).export("tower.obj")
    (tmp_path / "program.py").write_text(found[1], encoding="utf-8")
    made = runpy.run_path("program.py")
    assert made["result"].best.similarity > 0.9
    assert nw.Target.load("tower.glb").volume > 0.0
    assert (tmp_path / "tower.png").stat().st_size > 0


@pytest.mark.parametrize("picture", re.findall(r"!\[[^]]+\]\(([^)]+\.png)\)", README))
def test_pictures_are_there_and_small(picture: str) -> None:
    assert 0 < (ROOT / picture).stat().st_size < 300_000
