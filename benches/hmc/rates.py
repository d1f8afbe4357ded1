"""Gradients per second: one chain and 64, the systems taking turns, each the same chain with its own random numbers."""

import statistics
from collections.abc import Callable

import numpy as np
from chains.report import Report, middle, short

from hmc import densities, peers
from hmc.ours import Programs
from hmc.peers import Run

#: Draws of one turn: about a second of JAX each.
DRAWS = {"ring": 60_000, "coloring": 600, "stack": 40}
DRAWS_OF_64 = {"ring": 10_000, "coloring": 12, "stack": 2}
CHAINS = 64

#: Targets: times the better of JAX and NumPyro, of the limit, and times JAX under vmap.
OF_PEERS = {"ring": 2.0, "coloring": 2.0, "stack": 6.0}
OF_LIMIT = {"ring": 0.9, "coloring": 0.9}
OF_VMAP = {"ring": 0.8, "coloring": 2.0, "stack": 2.0}


def settled(programs: Programs, model: str) -> np.ndarray:
    """A point after a warm-up of our sampler, from which every system starts."""
    run = programs.nuts(model, densities.start(model), 500, 1, seed=11)
    return run.draws[-1]


def measure(
    report: Report, programs: Programs, points: dict[str, np.ndarray], rounds: int, share: float
) -> dict[str, float]:
    """Times all systems on all models; gives the seconds that each peer's first run took beyond a later one."""
    starts: dict[str, float] = {}
    versions = peers.versions()
    for chains in (1, CHAINS):
        table = report.table(
            f"gradients per second of wall, {'one chain' if chains == 1 else f'{chains} chains'}, one thread",
            *("model", "system", "gradients/s", "per CPU second", "niwaki / it", "acceptance"),
        )
        for model, point in points.items():
            draws = max(1, int(share * (DRAWS if chains == 1 else DRAWS_OF_64)[model]))
            systems = systems_of(programs, model, point, draws, chains, versions)
            runs: dict[str, list[Run]] = {name: [] for name in systems}
            for seed in range(1, rounds + 2):
                for name, system in systems.items():
                    runs[name].append(system(seed))
            for name, (first, *rest) in runs.items():
                starts[f"{model} {name}"] = first.seconds - statistics.median(run.seconds for run in rest)
                runs[name] = rest
            show(report, table, model, runs, chains)
        report.show(table)
    return starts


def systems_of(
    programs: Programs, model: str, point: np.ndarray, draws: int, chains: int, versions: dict[str, str]
) -> dict[str, Callable[[int], Run]]:
    """Each system as a function of the seed."""

    def compiled(make: Callable[..., object]) -> Callable[[int], Run]:
        sampler = peers.Chains(model, draws, chains, make)
        return lambda seed: sampler(point, seed)

    # A turn of ours takes as long as one of the others: more draws.
    more = {"ring": 4, "coloring": 3, "stack": 6}[model] if chains == 1 else 2
    systems = {"niwaki": lambda seed: programs.chain(model, point, more * draws, seed, lanes=chains > 1)}
    if chains == 1 and model in OF_LIMIT:
        systems["limit"] = lambda seed: programs.by_hand(model, point, more * draws, seed)
    if "jax" in versions:
        systems["JAX"] = compiled(peers.raw)
    if "numpyro" in versions and chains == 1:
        systems["NumPyro"] = compiled(peers.numpyro)
    return systems


def show(report: Report, table: object, model: str, runs: dict[str, list[Run]], chains: int) -> None:
    """Rows of a table, and their targets."""
    ours = runs["niwaki"]
    ratios = {
        name: [mine.rate / run.rate for mine, run in zip(ours, theirs, strict=True)]
        for name, theirs in runs.items()
    }
    for name, theirs in runs.items():
        table.add_row(
            model if name == "niwaki" else "",
            name,
            middle([run.rate for run in theirs]),
            short(statistics.median(run.cpu_rate for run in theirs)),
            "" if name == "niwaki" else middle(ratios[name]),
            f"{statistics.mean(run.accept for run in theirs):.2f}",
        )
        report.note(
            model=model,
            system=name,
            chains=chains,
            wall=[run.rate for run in theirs],
            cpu=[run.cpu_rate for run in theirs],
        )
    medians = {name: statistics.median(ratio) for name, ratio in ratios.items()}
    beside = [medians[name] for name in ("JAX", "NumPyro") if name in medians]
    if chains > 1:
        if beside:
            report.ask(f"{model}, {chains} chains: times JAX under vmap", min(beside), least=OF_VMAP[model])
        return
    if beside:
        report.ask(f"{model}: times the better of the peers", min(beside), least=OF_PEERS[model])
    if "limit" in medians:
        report.ask(f"{model}: of the gradient by hand", medians["limit"], least=OF_LIMIT[model])
