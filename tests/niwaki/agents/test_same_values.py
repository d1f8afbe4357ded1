"""A command with `--json` prints the values of the message's answer: of check, show, grow and fit."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest
from niwaki.shell.app import app
from niwaki.studio import messages as m
from niwaki.studio.worker import models, reports
from niwaki.studio.worker.loop import StopFlag, do
from typer.testing import CliRunner

TABLE = Path(__file__).parent / "sessions.toml"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with the files of `niwaki init`, which jobs may run."""
    CliRunner().invoke(app, ["init", str(tmp_path)], catch_exceptions=False)
    monkeypatch.setattr(models, "folders", [tmp_path.resolve()])
    yield tmp_path.resolve()


def printed(*words: str) -> Any:
    """Return what a command prints as JSON; requirements that do not hold end it with 1."""
    answer = CliRunner().invoke(app, [*words, "--json"])
    assert answer.exit_code in (0, 1), answer.output
    return json.loads(answer.stdout)


def answered(job: m.AnyJob) -> tuple[m.Answer, list[Any]]:
    """Do a job, and return its answer and its reports without their bytes."""
    sent: list[Any] = []
    answer = do(job, lambda report, payload=b"": sent.append(report), StopFlag())
    assert answer.problem is None
    return answer, sent


def test_check(folder: Path) -> None:
    _, (checked,) = answered(m.CheckModel(reference=f"{folder}/house.py"))
    report = printed("check", f"{folder}/house.py")
    assert report == msgspec.to_builtins(checked.report)
    assert len(report["choices"]) == 7 and report["requirements"][1]["name"] == "height"


def test_show(folder: Path) -> None:
    question = m.Question(f"{folder}/house.py", {"storeys": 1}, m.Ask(), m.Settings())
    _, sent = answered(m.PreviewRuns(question=question, count=3, seed=7))
    report = printed("show", f"{folder}/house.py", "storeys=1", "-n", "3", "--seed", "7")
    assert report == msgspec.to_builtins(sent[0].report)
    assert [row["seed"] for row in report["runs"]] == [7, 8, 9]


def test_grow(folder: Path) -> None:
    target = str(folder / "target.obj")
    settings = m.Settings(count=1, seed=1, effort=2 / 15)
    question = m.Question(f"{folder}/house.py", {}, m.Ask(m.TargetAsk(target)), settings)
    answer, _ = answered(m.Grow(question=question, run=0, seed=1, file=str(folder / "0.json")))
    report = printed(
        "grow",
        f"{folder}/house.py",
        "--target",
        target,
        "--method",
        "improve",
        "--rounds",
        "2",
        "--seed",
        "1",
    )
    (row,), (outcome,) = report["runs"], msgspec.to_builtins(answer.outcomes)
    shared = set(row) & set(outcome)
    assert {"log_score", "covered", "outside", "similarity", "primitives", "seed", "unmet"} == shared
    assert {name: row[name] for name in shared} == {name: outcome[name] for name in shared}


def test_fit(folder: Path) -> None:
    (folder / "bracket.py").write_text(
        "import niwaki as nw\nimport trimesh\n\n\ndef bracket(width=nw.Uniform(0.5, 4.0)):\n"
        "    mesh = trimesh.creation.box((width, 2.5, 1.6))\n"
        "    mesh.apply_translation((0.0, 1.25, 0.0))\n    return mesh\n"
    )
    reference, target = f"{folder}/bracket.py:bracket", str(folder / "target.obj")
    job = m.FitParameters(
        reference=reference,
        target=m.TargetAsk(target),
        evaluations=4,
        seed=3,
        align=False,
        folder=str(folder / "fit"),
    )
    sent: list[Any] = []
    reports.fit(job, lambda report, payload=b"": sent.append(report), lambda: None)
    (fitted,) = [report for report in sent if isinstance(report, m.Fitted)]
    report = printed("fit", reference, "--target", target, "--evaluations", "4", "--seed", "3")
    assert report == json.loads(json.dumps(fitted.report))
