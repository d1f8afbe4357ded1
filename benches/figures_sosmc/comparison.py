"""Figure 5.9: the best score by number of particles, for four methods.

Three models on our own targets and, where NIWAKI_REFERENCE_TARGETS names their folder, on the original's. At each
number of particles ten searches by stochastic order, ten depth-first, both weighted by whole scores as in the original;
ten Metropolis-Hastings chains for as many CPU seconds as the first took on average; and ten of the usual search
(`improve`) with as much counted work as so many particles. One thread; sigma 0.02; the original's rule for
intersections (`surface`).

The chains move by `kernels.original`: its proposals, its sharpening to sigma 0.005 and, on the tree, its selection
weights by depth. Scores are reported at 0.02. They run on the models of the particles, by the strategy of this engine,
which runs again only what a change touches. Their first possible state is outside the budget. Populations that became
impossible are counted apart.
"""

import os
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import niwaki as nw
from niwaki import kernels
from niwaki.gallery import entry, named_target
from niwaki.methods import Method

SIGMA = 0.02
#: The power of the score that makes it one of sigma 0.005; the calls that count as depth on a model, where they do.
SHARPEN, NESTING = 16.0, {"gnarly_tree": "side_branch"}
RUNS = 10
PARTICLES = (10, 30, 100, 300, 1000)
#: Model, cell size, our target, the original's.
CASES = (
    ("spaceship", 0.25, "ship", "shipProxy2.obj"),
    ("building", 0.25, "crescent", "buildingProxy1_thicker.obj"),
    ("gnarly-tree", 0.4, "bent_tube", "treeProxy_long_2.obj"),
)
#: The original's means and standard deviations in stochastic order (ten runs each), means depth-first and of chains.
PUBLISHED = {
    "spaceship": {
        10: (-35.91, 6.63, -49.66, -55.76),
        100: (-20.28, 2.98, -35.31, -32.53),
        300: (-15.98, 2.19, -27.23, -28.03),
        1000: (-13.40, 1.10, -18.83, -15.36),
    },
    "building": {
        10: (-20.12, 4.00, -21.66, -30.80),
        100: (-11.62, 2.88, -16.06, -18.85),
        300: (-9.17, 2.17, -9.63, -11.38),
        1000: (-6.48, 1.10, -13.75, -6.67),
    },
    "gnarly-tree": {
        10: (-25.74, 5.19, -24.43, None),
        100: (-12.46, 3.58, -14.00, -16.10),
        300: (-8.83, 1.82, -10.90, -14.18),
        1000: (-5.77, 1.10, -8.86, -12.89),
    },
}
#: Rounds of the usual search that work as much as its first population; the fewest particles of that.
ROUNDS, FEWEST = 5, 5


def usual(particles: int) -> nw.improve:
    """The usual search with the work of so many particles: a quarter of them, and rounds for the rest.

    Fewer of them grow a part again, too: a fifth, as by default.
    """
    first = max(particles // 4, FEWEST)
    rounds = round(ROUNDS * (particles / first - 1.0))
    return nw.improve(particles=first, regrow=max(first // 5, 2), rounds=rounds)


#: The methods for a number of particles.
METHODS: dict[str, Callable[[int], Method]] = {
    "stochastic": lambda n: nw.smc(n, weights="absolute"),
    "depth-first": lambda n: nw.smc(n, weights="absolute", order="depth-first"),
    "usual search": usual,
}
CHAINS = "Metropolis-Hastings, same time"
COLORS = {"stochastic": "#ca6702", "depth-first": "#5a9a8f", CHAINS: "#7a6c9c", "usual search": "#1b4965"}


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Measure and draw one panel for each model and target."""
    sizes, runs = ((10,), 2) if quick else (PARTICLES, RUNS)
    for owner, targets in meshes().items():
        rows = []
        for (model, voxel, _, _), target in zip(CASES, targets, strict=True):
            for row in measured(model, target, voxel, sizes, runs):
                rows.append({"model": model, "target": Path(target.name).stem, "whose": owner} | row)
                tell(rows[-1])
                print(described(rows[-1]), flush=True)
        curves(rows, folder / f"figure-5-9-{owner}.png")


def meshes() -> dict[str, list[nw.Target]]:
    """Targets in the order of `CASES`: ours, and the original's where a folder is named."""
    targets_by_owner = {"ours": [named_target(case[2]) for case in CASES]}
    named = os.environ.get("NIWAKI_REFERENCE_TARGETS")
    if named:
        targets_by_owner["reference"] = [nw.Target.load(Path(named) / case[3]) for case in CASES]
    else:
        print(
            "figure 5.9 on our own targets only: NIWAKI_REFERENCE_TARGETS names no folder of reference meshes"
        )
    return targets_by_owner


def measured(
    model: str, target: nw.Target, voxel: float, sizes: tuple[int, ...], runs: int
) -> Iterator[dict]:
    """One row for each number of particles and method: all best scores, and mean CPU seconds."""
    program, score = entry(model).model, score_of(target, voxel)
    # The first run compiles.
    searched(program, score, nw.smc(2), 0)
    for particles in sizes:
        budget = 0.0
        # Searches of the methods take turns, so that a busy machine is busy for all of them.
        ends_by_method: dict[str, list[tuple[float | None, float]]] = {method: [] for method in METHODS}
        for seed in range(1, runs + 1):
            for name, method in METHODS.items():
                ends_by_method[name].append(searched(program, score, method(particles), seed))
        budget = statistics.fmean(cpu for _, cpu in ends_by_method["stochastic"])
        ends_by_method[CHAINS] = [
            chained(program, score, moves(program), budget, seed) for seed in range(1, runs + 1)
        ]
        for method, ends in ends_by_method.items():
            scores = [score for score, _ in ends if score is not None]
            yield {
                "particles": particles,
                "method": method,
                "scores": scores,
                "impossible": len(ends) - len(scores),
                "cpu": statistics.fmean(cpu for _, cpu in ends),
            }


def score_of(target: nw.Target, voxel: float) -> nw.Score:
    """The score of all searches."""
    return nw.no_self_intersection("surface") * nw.match_volume(target, voxel, SIGMA)


def moves(program: nw.Model) -> kernels.Kernel:
    """How chains of a model move: as the original's."""
    return kernels.original(SHARPEN, NESTING.get(program.name))


def searched(program: nw.Model, score: nw.Score, method: Method, seed: int) -> tuple[float | None, float]:
    """The best log score of one search, nothing where it died; CPU seconds."""
    start = time.process_time()
    try:
        result = nw.run(program, method=method, score=score, seed=seed, threads=1)
    except nw.InputError as error:
        if error.code != "everything-impossible":
            raise
        return None, time.process_time() - start
    return result.best.log_score, result.cpu_seconds


def chained(
    program: nw.Model, score: nw.Score, kernel: kernels.Kernel, budget: float, seed: int
) -> tuple[float, float]:
    """The best log score that a chain came through in `budget` CPU seconds, and those it took."""
    method = nw.mh(1, kernel=kernel, keep=0, tries=10_000)
    chain = nw.run(program, method=method, score=score, seed=seed, threads=1)
    before, steps = chain.cpu_seconds, 16
    while (spent := chain.cpu_seconds - before) < budget:
        chain.more(steps)
        # As many as a tenth of the budget allows, by the rate so far.
        rate = (chain.cpu_seconds - before - spent) / steps
        steps = max(1, min(4 * steps, int(0.1 * budget / max(rate, 1e-9))))
    return chain.best.log_score, chain.cpu_seconds - before


def described(row: dict) -> str:
    """A row for people, beside what the original's paper data has."""
    scores = row["scores"]
    worst = min(scores, default=float("nan"))
    spread = statistics.stdev(scores) if len(scores) > 1 else 0.0
    known = PUBLISHED[row["model"]].get(row["particles"]) if row["whose"] == "reference" else None
    text = (
        f"{row['model']:<12}{row['target']:<24}{row['particles']:>5}  {row['method']:<18}"
        f"{statistics.fmean(scores) if scores else float('nan'):8.2f} ({spread:5.2f})  worst {worst:8.2f}"
        f"  {row['cpu']:7.3f} s"
    )
    text += f"  {row['impossible']} impossible" if row["impossible"] else ""
    if known is None:
        return text
    beside = {"stochastic": known[0], "depth-first": known[2], CHAINS: known[3]}.get(row["method"])
    text += "" if beside is None else f"  published {beside:7.2f}"
    if row["method"] == "stochastic":
        text += f" ({known[1]:.2f})"
    return text


def curves(rows: list[dict], path: Path) -> None:
    """One panel for each model: mean best score against particles, a band of the middle two thirds."""
    models = list(dict.fromkeys(row["model"] for row in rows))
    figure, panels = plt.subplots(1, len(models), figsize=(12, 4), layout="constrained")
    for panel, model in zip(panels, models, strict=True):
        for method, color in COLORS.items():
            points = [
                row for row in rows if (row["model"], row["method"]) == (model, method) and row["scores"]
            ]
            means = [statistics.fmean(row["scores"]) for row in points]
            at = [row["particles"] for row in points]
            panel.plot(at, means, "o-", color=color, label=method, markersize=3.5)
            # One search alone has no spread.
            sixths = [
                statistics.quantiles(2 * scores if len(scores) == 1 else scores, n=6, method="inclusive")
                for scores in (row["scores"] for row in points)
            ]
            low, high = ([cut[end] for cut in sixths] for end in (0, -1))
            panel.fill_between(at, low, high, color=color, alpha=0.15, linewidth=0)
            panel.plot(at, [min(row["scores"]) for row in points], "_", color=color, markersize=8)
        if rows[0]["whose"] == "reference":
            known = PUBLISHED[model]
            panel.errorbar(
                list(known),
                [row[0] for row in known.values()],
                [row[1] for row in known.values()],
                fmt="x",
                color="#444444",
                markersize=5,
                linewidth=0.8,
                label="published, stochastic",
            )
        panel.set(xscale="log", xlabel="particles", title=model, ylim=(-60, 6))
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("best log score, sigma 0.02")
    panels[-1].legend(frameon=False, fontsize=8, loc="lower right")
    figure.savefig(path, dpi=90)
    plt.close(figure)
