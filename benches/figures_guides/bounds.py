"""A guide trained by examples, and by the evidence bound (6.3, 6.4.2): what each of them learns, and leaves out.

Left: four coins that should agree, with all probabilities known. Right: the vines, by guides of the same network. A
guide that is trained by a bound begins with nothing, or with the guide that was trained by examples.
"""

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import niwaki as nw
import numpy as np
from judging import held_out
from niwaki import _engine
from niwaki.draw.flat.drawing import drawing
from niwaki.gallery import vines
from niwaki.guides import Training, train_guide
from niwaki.methods import Guide
from niwaki.result import Sample
from niwaki.search import Search
from niwaki.targets.drawing import Drawing
from PIL import Image
from places import Places, Row
from school import ours, scribbles
from sheets import saved as saved_sheet
from tables import put, table

#: Nats for each pair of neighbours that agree.
STRENGTH = 2.0
#: Runs of the coins, and results at a drawing.
RUNS, RESULTS = 4000, 100
#: Held-out scribbles that are grown into, and those whose traces are looked at.
GROWN, TRACED = 8, 40
STEPS = 1500

KINDS = {
    "examples": ("by examples", "#1b4965"),
    "bound after examples": ("by the bound, begun with examples", "#9b2226"),
    "particles after examples": ("by the bound of 16 runs, begun with examples", "#e8a44c"),
    "bound": ("by the bound, from nothing", "#9a9a96"),
}
#: Columns of the table.
COLUMNS = (
    ("bound", "bound, nats"),
    ("alone", "similarity of one run"),
    ("ten", "of ten particles"),
    ("structures", "structures of 100"),
    ("apart", "pixels apart"),
    ("nats a choice", "held-out traces, nats a choice"),
    ("worst trace", "worst of them"),
)


@nw.model
def coins(strength):
    """Four coins in a ring; each pair of neighbours that agree is worth `strength` nats."""
    a = nw.flip(0.5)
    b = nw.flip(0.5)
    c = nw.flip(0.5)
    d = nw.flip(0.5)
    nw.factor(strength * ((a == b) + (b == c) + (c == d) + (d == a)))
    return a + b + c + d


def of_coins(places: Places) -> Mapping[str, list[float]]:
    """The probabilities of 0 to 4 heads: the truth, and by guides."""
    result = nw.run(coins, STRENGTH, method=nw.enumerate_all())
    truth = {int(heads): chance for heads, chance in result.distribution().items()}
    bounds_by_name: dict[str, list[float]] = {"posterior": [truth[k] for k in range(5)]}
    steps = 50 if places.quick else 600
    for name, objective, reads in (
        ("by examples; each coin sees the others", "examples", True),
        ("by the bound; each coin sees the others", "bound", True),
        ("by examples; no coin sees another", "examples", False),
        ("by the bound; no coin sees another", "bound", False),
    ):
        settings = {"reads": reads, "looks": False, "hidden": (8, 8), "steps": steps}
        more: dict[str, Any] = {"training": Training.bound(**settings, rate=0.01, batch=4)}
        if objective == "examples":
            # Traces from the posterior itself: the likeliest run of one particle is that particle.
            more = {"training": Training(**settings), "rounds": (1000,), "keep": lambda _: True}
            more["searches"] = (nw.rejection(1, bound=4 * STRENGTH),)
        guide = train_guide(coins, (STRENGTH,) * 8, lambda _: nw.floor(0), lambda run: (run,), seed=1, **more)
        runs = nw.run(coins, STRENGTH, method=nw.importance(RUNS, guide=guide), seed=1)
        counts = Counter(int(run.value) for run in runs)
        bounds_by_name[name] = [counts[k] / RUNS for k in range(5)]
        bounds_by_name[name].append(float(np.mean([run.log_weight for run in runs])))
        print(name, bounds_by_name[name], f"log evidence {result.log_evidence:.3f}", flush=True)
    return bounds_by_name


def by_bound(objective: str, start: Guide | None, places: Places) -> Guide:
    """A guide of the vines by a bound."""
    learned, judged = scribbles()
    steps = 4 if places.quick else STEPS
    start_time = time.process_time()
    guide = train_guide(
        vines.MODEL,
        learned,
        lambda page: page.score(vines.WINDOW),
        lambda page: page.place(vines.WINDOW),
        held_out=judged[:4] if places.quick else judged,
        training=Training.bound(objective=objective, steps=steps),
        start=start,
        seed=1,
    )
    return guide.with_report(guide.report | {"cpu": time.process_time() - start_time})


def of_vines(places: Places) -> dict[str, Guide]:
    """All guides of the vines."""
    first = ours(places, vines)
    ways: dict[str, Callable[[], Guide]] = {
        "bound after examples": lambda: by_bound("bound", first, places),
        "particles after examples": lambda: by_bound("particles", first, places),
        "bound": lambda: by_bound("bound", None, places),
    }
    return {"examples": first} | {
        name: places.guide(f"by-{name.replace(' ', '-')}", make) for name, make in ways.items()
    }


def traced(places: Places) -> tuple[list[Search], _engine.Lessons, list[Sample]]:
    """Traces of the posterior of held-out scribbles: of a large population without a guide, one particle by weight."""
    every = held_out("scribbles", places.quick)[:TRACED]
    method = nw.smc(60 if places.quick else 600, resampling="tempered")
    lessons, searches, picked = _engine.Lessons(), list[Search](), list[Sample]()
    for number, page in enumerate(every):
        search = search_of(page, method, number)
        result = search.run(threads=1)
        ended = [run for run in result if run.has_ended]
        chances = np.exp([run.log_weight for run in ended])
        pick = np.random.default_rng(number).choice(len(ended), p=chances / chances.sum())
        lessons.add(search.task, ended[pick]._run, False)
        searches.append(search)
        picked.append(ended[pick])
    return searches, lessons, picked


def search_of(page: Drawing, method: Any, seed: int) -> Search:
    """A search for vines in a drawing."""
    return Search(
        vines.MODEL, page.place(vines.WINDOW), score=page.score(vines.WINDOW), method=method, seed=seed
    )


def structure(run: Sample) -> tuple[Any, ...]:
    """The discrete choices of a run: which parts there are."""
    return tuple(sorted((path, x) for path, x in run.choices.items() if not isinstance(x, float)))


def ink(run: Sample, target: Drawing) -> Any:
    """Return the pixels, of 50 by 50, that a run covers."""
    page = drawing(run.scene, size=(50, 50), style="ink", window=target.window(vines.WINDOW))
    return np.asarray(page.convert("L")) < 128


def apart(pages: Sequence[Any]) -> float:
    """Return the share of pixels that only one of two results covers, of all covered pixels; the mean over pairs."""
    flat = np.array([page.ravel() for page in pages], dtype=np.float64)
    both = flat @ flat.T
    sizes = flat.sum(1)
    either = sizes[:, None] + sizes[None, :] - both
    pairs = np.triu_indices(len(pages), 1)
    return float(np.mean(1.0 - both[pairs] / np.maximum(either[pairs], 1.0)))


def measured(
    places: Places, name: str, guide: Guide, searches: list[Search], lessons: _engine.Lessons
) -> Row:
    """All measures of a guide of the vines."""

    def measure() -> Row:
        losses = np.array(lessons.losses(searches[0].task, guide._engine))
        every = held_out("scribbles", places.quick)
        results = 6 if places.quick else RESULTS
        bounds, alone = [], []
        for number, page in enumerate(every):
            runs = search_of(page, nw.importance(64, guide=guide), number).run(threads=1)
            possible = [run.log_weight for run in runs if np.isfinite(run.log_weight)]
            bounds.append(np.mean(possible))
            alone += [run.similarity for run in runs]
        structures, spreads, alike = [], [], []
        for page in every[:GROWN]:
            method = nw.smc(10, resampling="tempered", guide=guide)
            results_of_page = [search_of(page, method, seed).run(threads=1) for seed in range(results)]
            best = [max(runs, key=lambda run: run.log_score + run.log_prior) for runs in results_of_page]
            structures.append(len({structure(run) for run in best}))
            spreads.append(apart([ink(run, page) for run in best]))
            alike += [run.similarity for run in best]
        return {
            "cpu": round(guide.report.get("cpu", 0.0), 1),
            "bound": round(float(np.mean(bounds)), 1),
            "alone": round(float(np.mean(alone)), 3),
            "ten": round(float(np.mean(alike)), 3),
            "structures": round(float(np.mean(structures)), 1),
            "apart": round(float(np.mean(spreads)), 3),
            "nats a choice": round(float(-losses[:, 1].sum() / losses[:, 0].sum()), 3),
            "worst trace": round(float(-(losses[:, 1] / losses[:, 0]).max()), 3),
        }

    row = places.row("by-bounds", {"part": "bounds", "name": name}, measure)
    print(row, flush=True)
    return row


def draw(places: Places) -> None:
    """Draw the figure."""
    bounds_by_name = of_coins(places)
    guides = of_vines(places)
    *traces, picked = traced(places)
    rows = {name: measured(places, name, guide, *traces) for name, guide in guides.items()}
    if not places.quick:
        head = ("guide", *(text for _, text in COLUMNS))
        put(
            "bounds",
            table(head, ((KINDS[name][0], *(row[key] for key, _ in COLUMNS)) for name, row in rows.items())),
        )
    figure, panels = plt.subplots(1, 3, figsize=(12, 4.4), layout="constrained", width_ratios=(1.3, 1.1, 1))
    shades = ("#444444", "#5a9a8f", "#e8a44c", "#1b4965", "#9b2226")
    for number, ((name, chances), shade) in enumerate(zip(bounds_by_name.items(), shades, strict=True)):
        panels[0].bar(np.arange(5) + 0.16 * (number - 2), chances[:5], 0.16, label=name, color=shade)
    panels[0].set(title="four coins that should agree", xlabel="heads", ylabel="probability", ylim=(0, 1.35))
    panels[0].legend(frameon=False, fontsize=8, loc="upper left")
    sides = {"held-out traces": leaves(places, "traces", lambda: picked)}
    for name, guide in guides.items():
        sides[KINDS[name][0]] = leaves(places, name, lambda guide_of_kind=guide: alone(places, guide_of_kind))
    for number, (name, row) in enumerate(sides.items()):
        left = 0.0
        for kind, shade in zip(LEAVES, ("#d9d6cf", "#5a9a8f", "#1b4965"), strict=True):
            panels[1].barh(
                -number, row[kind], 0.5, left=left, color=shade, label=None if number else f"leaf: {kind}"
            )
            left += row[kind]
        panels[1].text(0.0, 0.27 - number, name, fontsize=8, va="bottom")
    panels[1].set(title="vines: single runs", xlabel="share of the branches", yticks=[], ylim=(-5.4, 0.9))
    panels[1].legend(frameon=False, fontsize=8, ncols=3, loc="lower center")
    for number, (name, row) in enumerate(rows.items()):
        value = row["nats a choice"]
        panels[2].bar(number, value, color=KINDS[name][1], label=KINDS[name][0])
        place = {"xytext": (0, 2 if value > 0 else -11), "textcoords": "offset points"}
        panels[2].annotate(f"{value:.2f}", (number, value), ha="center", fontsize=9, **place)
    panels[2].axhline(0.0, color="#444444", linewidth=0.8)
    panels[2].set(title="vines: held-out traces", ylabel="nats a choice, against the prior", xticks=[])
    panels[2].set(ylim=(-1.35, 0.2))
    panels[2].legend(frameon=False, fontsize=8, loc="lower left")
    saved_figure(figure, places)


#: What `leaf` of the vines chooses from.
LEAVES = ("none", "left", "right")


def alone(places: Places, guide: Guide) -> list[Sample]:
    """Single runs of a guide at held-out scribbles."""
    every = held_out("scribbles", places.quick)[:GROWN]
    results = [search_of(page, nw.importance(40, guide=guide), number) for number, page in enumerate(every)]
    return [run for search in results for run in search.run(threads=1)]


def leaves(places: Places, name: str, runs: Callable[[], Sequence[Sample]]) -> Row:
    """How often the branches of runs have no leaf, one on the left, one on the right."""

    def measure() -> Row:
        counts = Counter(
            LEAVES[x] for run in runs() for path, x in run.choices.items() if path.endswith("/leaf")
        )
        return {kind: round(counts[kind] / counts.total(), 3) for kind in LEAVES}

    row = places.row("by-bounds", {"part": "leaves", "name": name}, measure)
    print(row, flush=True)
    return row


def saved_figure(figure: Any, places: Places) -> None:
    """Write the figure with few colours."""
    figure.canvas.draw()
    page = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    plt.close(figure)
    saved_sheet(places, "bounds.png", page.quantize(256).convert("RGB"))
