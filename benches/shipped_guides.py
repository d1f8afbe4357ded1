"""Train the guides that come with the package: `make guides`, or `python benches/shipped_guides.py vines`.

    python benches/shipped_guides.py --compare     # searches with them and without, on the drawings that judged

Targets are the drawings whose use is "training" and their mirror images; each eighth of them judges. None of the
held-out drawings is looked at. The same seed gives the same bytes on this kind of machine, on any number of threads.
The report is in each file: `niwaki guide show python/niwaki/guides/shipped/vines.guide`.
"""

from __future__ import annotations

import resource
import sys
import time

import niwaki as nw
from niwaki import gallery, guides
from niwaki.guides.report import sentence, summary
from niwaki.search.shipped import FOLDER
from niwaki.targets import drawings
from niwaki.targets.drawing import Drawing
from niwaki.targets.sketches import Window

SEED = 1
ROUNDS = (150, 400)

#: A run with fewer shapes is a stump, and teaches to end early.
LEAST = 10


def flat(name: str) -> nw.Guide:
    """A guide for a model of the gallery that follows drawings."""
    entry = gallery.entry(name)
    assert entry is not None and entry.window is not None
    page: Window = entry.window
    training = [drawings.drawing(drawing) for drawing in drawings.names("scribbles", "training")]
    learned = [drawing for i, drawing in enumerate(training) if i % guides.EVERY]

    def score(drawing: Drawing) -> nw.Score:
        return drawing.score(page)

    return nw.train_guide(
        entry.model,
        [*learned, *(drawing.mirrored() for drawing in learned)],
        score,
        lambda drawing: drawing.place(page),
        held_out=training[:: guides.EVERY],
        rounds=ROUNDS,
        keep=lambda sample: sample.has_ended and sample.primitives >= LEAST,
        seed=SEED,
        progress=lambda now: (
            print(f"  {now.traces} traces: {sentence(now.summary())}") if now.is_judged else None
        ),
    )


RECIPES = {"vines": flat, "lightning": flat}


def compare(name: str) -> None:
    """Print how well searches with a guide and without do on the drawings that judged, and what they cost."""
    entry = gallery.entry(name)
    assert entry is not None and entry.window is not None
    guide = guides.shipped(entry.model)
    methods: dict[str, nw.Method] = {
        f"{'guided' if by else 'not guided'}, {count} particles": nw.smc(
            count, resampling="tempered", guide=by
        )
        for count, by in ((10, guide), (20, guide), (50, guide), (150, guide), (50, None), (600, None))
    } | {f"guided search, {rounds} rounds": nw.improve(rounds=rounds, guide=guide) for rounds in (3, 15)}
    for label, method in methods.items():
        rows, began = [], time.process_time()
        for drawing in map(drawings.drawing, drawings.names("scribbles", "training")[:: guides.EVERY]):
            for seed in range(3):
                place, score = drawing.place(entry.window), drawing.score(entry.window)
                result = nw.run(entry.model, *place, method=method, score=score, seed=seed, threads=1)
                rows.append(max(result, key=lambda sample: sample.log_joint).similarity)
        cost = 1000 * (time.process_time() - began) / len(rows)
        print(f"{name}, {label}: {sentence(summary(rows))}; {cost:.1f} ms of CPU")


def main(names: list[str]) -> None:
    """Train and write guides, or compare them."""
    if names[:1] == ["--compare"]:
        for name in names[1:] or RECIPES:
            compare(name)
        return
    FOLDER.mkdir(exist_ok=True)
    for name in names or RECIPES:
        print(name)
        began, cpu = time.perf_counter(), time.process_time()
        guide = RECIPES[name](name)
        guide.save(FOLDER / f"{name}.guide")
        seconds, used = time.perf_counter() - began, time.process_time() - cpu
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(
            f"  {len(guide.data) / 1000:.0f} kB in {seconds:.0f} s ({used:.0f} s of CPU), {most:.0f} MiB at most"
        )


if __name__ == "__main__":
    main(sys.argv[1:])
