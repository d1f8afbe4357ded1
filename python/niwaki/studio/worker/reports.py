"""Reports on models: what commands of the shell print, as events, with small pictures."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
from niwaki import draw, search, shell
from niwaki.fitting import FitProgress
from niwaki.fitting.loading import generator_of
from niwaki.studio.messages import (
    Answer,
    Checked,
    CheckModel,
    ExplainChange,
    Explained,
    FitParameters,
    Fitted,
    Picture,
    Previewed,
    PreviewRuns,
    Progressed,
)
from niwaki.studio.problems import CommandError
from niwaki.studio.worker import asks, coloring, models, pictures, runs
from niwaki.studio.worker.loading import loading
from niwaki.targets import asks as options


def check(job: CheckModel, send: Any) -> Answer:
    """Compile a model, and report on it."""
    _refuse_drawing(job.reference)
    sample = runs.sample(job.source, job.number) if job.source else None
    send(Checked(job.id, shell.check.report(models.reference(job.reference), sample, job.arguments)))
    return Answer()


def preview(job: PreviewRuns, send: Any) -> Answer:
    """Run a model without a target, and draw the runs side by side."""
    _refuse_drawing(job.question.model)
    model = models.reference(job.question.model)
    values = {**shell.show.start(model), **job.question.arguments}
    result = shell.show.prior_runs(model.model, values, job.count, job.seed)
    send(Previewed(job.id, shell.show.report(result)))
    if any(sample.primitives for sample in result):
        across = min(3, len(result))

        def sheet(size: tuple[int, int]) -> Any:
            cell = size[0] * 3 // (2 * across), size[1] * 3 // (2 * across)
            return shell.show.sheet(model, result, size=cell, samples=1, columns=across)

        send(Picture(job.id), pictures.small(sheet))
    return Answer()


def explain(job: ExplainChange, send: Any) -> Answer:
    """Change one choice of a run, and count the calls that each strategy runs again."""
    _refuse_drawing(job.question.model)
    report = search.explain(
        models.reference(job.question.model).model,
        job.choice,
        *asks.arguments(job.question),
        seed=job.seed,
    )
    total = len(report["activations"])
    before, after = (draw.reuse.value_text(report[key]) for key in ("old", "new"))
    strategies = {name: draw.reuse.counts(steps, total) for name, (steps, _) in report["runs"].items()}
    send(Explained(job.id, f"{report['label']} ({report['path']})", before, after, total, strategies))
    return Answer()


def fit(job: FitParameters, send: Any, check: Callable[[], None]) -> Answer:
    """Fit the parameters of a model that somebody else wrote; its evaluations stay in the folder."""
    place = Path(job.reference if models.is_file(job.reference) else job.reference.rpartition(":")[0])
    models.check_permission(place)
    with loading(place):
        generator = generator_of(job.reference)
    goal = options.score([("match_volume", {"target": asks.placed(job.target)})])
    start = time.perf_counter()

    def progress(now: FitProgress) -> None:
        best = now.best if math.isfinite(now.best) else None
        send(Progressed(job.id, now.done, best, time.perf_counter() - start))
        check()

    result = nw.fit(
        generator, goal, job.evaluations, folder=job.folder, seed=job.seed, align=job.align, progress=progress
    )
    send(Fitted(job.id, result.numbers()))
    best = result.best
    if len(best.scene):
        send(
            Picture(job.id),
            pictures.small(lambda size: best.scene.picture(best.target, size=size, samples=pictures.SAMPLES)),
        )
    return Answer(interrupted=result.interrupted)


def _refuse_drawing(reference: str) -> None:
    """Refuse a drawing, which has no program.

    Raises
    ------
    CommandError
        `no-program`.
    """
    if coloring.is_drawing(reference):
        raise CommandError("no-program", "a drawing to colour has no program; choose a model")
