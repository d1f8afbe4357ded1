"""Searches that are recorded: every method and kernel, plain, with a choice held, guided and resumed; the gallery.

A name is that of the method, of its setting, and then of the variant: `smc tempered, held`. Counts limit them all.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import conjugate_line
import finite_programs
import niwaki as nw
import resumed
import searches
from niwaki import kernels
from niwaki.gallery import Entry, coin, entries, gnarly_tree, simple_ship
from niwaki.guides import Training, shipped, train_look_ahead, train_order
from niwaki.methods import FutureOrder, Method
from niwaki.targets import drawings
from niwaki.targets.examples import bent_tube
from niwaki.words import Gaussian
from test_drag import arm, post
from test_engine import load
from test_inside import HONOURED, inner

#: A search that is recorded: it gives a result, or another value that has a digest.
Search = Callable[[], Any]

#: What ends the name of a search that was broken off and gone on with: its result is that of the plain one.
RESUMED = ", resumed"

SEED = 5


@dataclass(frozen=True)
class Subject:
    """A model with what its runs are scored by, and a guide for it."""

    model: Any
    args: tuple[Any, ...] = ()
    score: Callable[[], nw.Score] = nw.Score
    guide: Callable[[], nw.Guide | None] = lambda: None

    def run(self, method: Method, **more: Any) -> nw.Result:
        """Search it."""
        return nw.run(self.model, *self.args, method=method, score=self.score(), seed=SEED, **more)

    def hold(self) -> dict[str, Any]:
        """The first choice of some run, held."""
        free = nw.run(self.model, *self.args, seed=SEED).held()
        return dict([next(iter(free.items()))])


@cache
def taught() -> nw.Guide:
    """A guide of `path` that looks ahead."""
    return train_look_ahead(
        resumed.training(), resumed.path, SIDES, side_score, searches=30, states=2, particles=4, seed=1
    )


SIDES = (-2, -1, 1, 2)


def side_score(side: int) -> nw.Score:
    """A bar to one side, as a score."""
    return nw.match_drawing(resumed.page(side), resumed.WINDOW)


def tree_score() -> nw.Score:
    """A bent tube to be filled."""
    return nw.no_self_intersection() * nw.match_volume(bent_tube(), 0.5)


COIN = Subject(coin.coin)
LINE = Subject(conjugate_line.line, (conjugate_line.X.tolist(), conjugate_line.Y.tolist()))
MIXTURE = Subject(resumed.mixture, (resumed.DATA,))
INVALID = Subject(resumed.invalid, (resumed.DATA,))
PATH = Subject(resumed.path, (), partial(side_score, 2), taught)
TREE = Subject(gnarly_tree.gnarly_tree, (), tree_score, partial(shipped, gnarly_tree.gnarly_tree))


def variants(name: str, subject: Subject, method: Method) -> Iterator[tuple[str, Search]]:
    """A search, the same with a choice held, and broken off."""
    yield name, partial(subject.run, method)
    yield f"{name}, held", lambda: subject.run(method, hold=subject.hold())
    yield f"{name}{RESUMED}", partial(gone_on, partial(subject.run, method))


def guided(name: str, subject: Subject, method: Callable[..., Method]) -> Iterator[tuple[str, Search]]:
    """These of a method that may have a guide, and the search by a guide."""
    yield from variants(name, subject, method())
    yield f"{name}, guided", lambda: subject.run(method(guide=subject.guide()))


@nw.model
def solids() -> None:
    """One of each solid of points or of a round form, of a size of its own, and one with a hole."""

    def size() -> Any:
        return nw.uniform(0.4, 1.0)

    wide = size()
    star = [(wide, 0.0), (0.2, 0.2), (0.0, wide), (-0.2, 0.2), (-wide, 0.0), (0.0, -wide)]
    triangle = [(-0.1, -0.1), (0.1, -0.1), (0.0, 0.1)]
    shapes = [
        nw.sphere((0.0, 0.0, 0.0), 0.5 * size()),
        nw.ellipsoid((3.0, 0.0, 0.0), (size(), 0.5, size())),
        nw.cone((6.0, 0.0, 0.0), 0.5, size()),
        nw.wedge((0.0, 3.0, 0.0), (size(), 0.8, 0.8), ridge=0.5 * size()),
        nw.torus((3.0, 3.0, 0.0), 0.5 * size(), 0.15),
        nw.arch((6.0, 3.0, 0.0), (size(), size(), 0.3), 0.1),
        nw.extrude(star, size(), (0.0, 6.0, 0.0), twist=0.5 * size(), taper=0.5),
        nw.revolve([(0.0, 0.0), (size(), 0.0), (0.3, 0.5), (0.0, 1.0)], (3.0, 6.0, 0.0)),
        nw.sweep(triangle, [(5.0, 6.0, 0.0), (5.5, 6.0 + size(), 0.0), (6.0, 6.5, 0.5)]),
        nw.hull([(0.0, 9.0, 0.0), (size(), 9.0, 0.0), (0.0, 9.0, size()), (0.2, 9.0 + size(), 0.2)]),
        nw.box((3.0, 9.0, 0.0), (size(), size(), 0.5))
        - nw.cylinder((3.0, 9.0, 0.0), 0.2 * size(), 1.0, axis="z"),
    ]
    for shape in shapes:
        nw.emit(shape)


def solids_score() -> nw.Score:
    """A block to be filled, into which the solids go."""
    block = nw.Target.of_shapes(nw.box((3.0, 4.5, 0.0), (8.0, 11.0, 1.0)))
    return nw.no_self_intersection() * nw.match_volume(block, 0.25)


SOLIDS = Subject(solids, (), solids_score)


class Ended(Exception):
    """Ends a search from within."""


def gone_on(search: Callable[..., Any]) -> Any:
    """The result of a search that is ended three times, gone on with, and read again when it is done.

    It is ended when its checkpoint has changed. One of a few hundredths of a second is done before that, and is only
    read again.
    """
    with TemporaryDirectory() as folder:
        place = Path(folder) / "checkpoint"
        for _ in range(3):
            before = place.read_bytes() if place.exists() else b""

            def watch(_: Any, before: bytes = before) -> None:
                if place.exists() and place.read_bytes() != before:
                    raise Ended

            try:
                search(checkpoint=nw.Checkpoint(place, every=0.0), progress=watch)
                break
            except Ended:
                continue
        else:
            search(checkpoint=place)
        return search(checkpoint=place)


#: Kernels of chains, by name; each function of `niwaki.kernels` is the first word of one.
KERNELS: dict[str, kernels.Kernel] = {
    "prior": kernels.prior(),
    "drift": kernels.drift(0.3),
    "neighbour": kernels.neighbour(2),
    "block": kernels.block(0.2, 0.3),
    "regenerate": kernels.regenerate(1),
    "regrow by size": kernels.regrow(6),
    "regrow by choice": kernels.regrow(6, turn=0.0, pick="choice"),
    "regrow parts": kernels.regrow(6, parts="i[*]"),
    "hmc_step": kernels.cycle(kernels.prior(), kernels.hmc_step(4, jitter=0.5)),
    "nuts_step": kernels.cycle(kernels.prior(), kernels.nuts_step(3)),
    "proposal": kernels.mixture(
        kernels.prior(), kernels.on("means", kernels.proposal(lambda old: Gaussian(old, 0.5)))
    ),
    "cycle": kernels.cycle(kernels.prior(), kernels.drift()),
    "mixture": kernels.mixture(kernels.prior(), kernels.neighbour(), kernels.drift(), weights=[3, 1, 2]),
    "repeat": kernels.cycle(kernels.repeat(3, kernels.drift()), kernels.prior()),
    "on": kernels.mixture(kernels.prior(), kernels.on(["spread", "means"], kernels.drift(0.2))),
    "weighted": kernels.weighted(kernels.prior(), depth=lambda n: 1.0 / (1 + n), sites={"label": 0.2}),
    "anneal": kernels.anneal(kernels.prior(), 300, 0.2, 4.0),
    "tempering": kernels.tempering(kernels.prior(), (1.0, 0.5, 0.2), every=20),
    "tempering of anneal": kernels.tempering(
        kernels.anneal(kernels.mixture(kernels.prior(), kernels.drift()), 300, 0.5, 1.0), (1.0, 0.3)
    ),
    "original": kernels.original(4.0),
    "all": resumed.ALL,
}
MOVES = kernels.cycle(kernels.prior(), kernels.drift(0.2))
OF_FUTURES = FutureOrder({"side_branch": 1.0}, depth=0.5, turns=-1.0, waited=-0.5, stay=1.0)
#: Settings of populations.
POPULATIONS: dict[str, dict[str, Any]] = {
    "stochastic": {},
    "depth-first": {"order": "depth-first"},
    "by an order": {"order": OF_FUTURES},
    "residual": {"resampling": "residual", "power": 4.0},
    "stratified": {"resampling": "stratified"},
    "multinomial": {"resampling": "multinomial"},
    "tempered": {"resampling": "tempered"},
    "ess": {"ess": 0.5},
    "anneal schedule": {"anneal": [0.2, 0.5, 1.0]},
    "anneal share": {"anneal": 0.8},
    "populations": {"populations": 3},
    "sizes": {"particles": [10, 20, 5]},
    "diverse": {"diverse": 2},
    "rejuvenate": {"rejuvenate": MOVES, "moves": 2},
    "rejuvenate resampled": {"rejuvenate": kernels.prior(), "at": "resampled"},
    "rejuvenate regrow": {"rejuvenate": kernels.regrow(4), "at": "end"},
    "rejuvenate draws": {"rejuvenate": MOVES, "moves": 3, "at": "end", "draws": 8, "chains": 2},
}
SWEPT: dict[str, dict[str, Any]] = {
    "stochastic": {},
    "depth-first": {"order": "depth-first"},
    "tempered": {"resampling": "tempered", "power": 2.0},
    "anneal": {"anneal": [0.2, 0.5, 1.0], "ess": 0.5},
}


def of_methods() -> Iterator[tuple[str, Search]]:
    """Every method."""
    yield from variants("forward", MIXTURE, nw.forward(20))
    yield from variants("enumerate_all", COIN, nw.enumerate_all())
    yield from variants("enumerate_all likely", COIN, nw.enumerate_all(4, likely=True))
    yield from variants("rejection", COIN, nw.rejection(20))
    yield from variants("importance", MIXTURE, nw.importance(60))
    kernel = kernels.on("means", kernels.proposal(lambda k: Gaussian(0.5 * k, 4.0)))
    yield from variants("importance by a proposal", MIXTURE, nw.importance(60, kernel))
    yield from guided("importance path", PATH, partial(nw.importance, 60))
    yield from variants("ais", MIXTURE, nw.ais(10, 6, kernels.mixture(*KERNELS["mixture"].parts), moves=3))
    yield from variants("ais hmc_step", LINE, nw.ais(10, (0.1, 0.5, 1.0), kernels.hmc_step(3), moves=2))
    for name, more in POPULATIONS.items():
        settings = {"particles": 30, **more}
        yield from guided(f"smc {name}", TREE, partial(nw.smc, **settings))
    yield from variants("smc absolute", TREE, nw.smc(60, weights="absolute"))
    yield from variants("smc mixture", MIXTURE, nw.smc(40))
    yield from variants("smc by a proposal", MIXTURE, nw.smc(40, proposal=kernel))
    yield from variants("smc hmc_step", LINE, nw.smc(20, rejuvenate=kernels.hmc_step(3), at="end"))
    yield from variants("smc invalid", INVALID, nw.smc(40))
    yield from guided("smc path", PATH, partial(nw.smc, 40, resampling="tempered"))
    yield "smc look_ahead", lambda: PATH.run(nw.smc(40, guide=taught(), look_ahead=0.2))
    yield (
        "smc look_ahead, held",
        lambda: PATH.run(nw.smc(40, guide=taught(), look_ahead=0.2), hold=PATH.hold()),
    )
    for name, more in SWEPT.items():
        for method in (nw.particle_gibbs, nw.pimh):
            title = f"{method.NAME} {name}"
            yield from guided(title, TREE, partial(method, 10, 4, **more))
    yield from variants(
        "particle_gibbs without ancestors", MIXTURE, nw.particle_gibbs(10, 10, ancestors=False)
    )
    yield from variants("pimh residual", MIXTURE, nw.pimh(10, 10, resampling="residual"))
    yield from guided("particle_gibbs path", PATH, partial(nw.particle_gibbs, 10, 6))
    yield from guided("pimh path", PATH, partial(nw.pimh, 10, 6))
    yield (
        "particle_gibbs look_ahead",
        lambda: PATH.run(nw.particle_gibbs(10, 6, guide=taught(), look_ahead=0.2)),
    )
    yield "pimh look_ahead", lambda: PATH.run(nw.pimh(10, 6, guide=taught(), look_ahead=0.2))
    for name, kernel in KERNELS.items():
        chains = nw.mh(600, kernel=kernel, chains=2, warmup=200, keep=20)
        yield from variants(f"mh {name}", MIXTURE, chains)
    for strategy in ("c3", "rerun", "resume", "cache"):
        yield from variants(f"mh by {strategy}", MIXTURE, nw.mh(600, strategy, KERNELS["mixture"], keep=20))
    yield from variants("mh invalid", INVALID, nw.mh(3000, chains=2, keep=20))
    yield from variants(
        "mh tree", TREE, nw.mh(200, kernel=kernels.mixture(kernels.prior(), kernels.regrow(4)), keep=20)
    )
    yield "mh guided", lambda: PATH.run(nw.mh(200, kernel=kernels.guided(taught()), keep=20))
    yield "mh guided, held", lambda: PATH.run(nw.mh(200, kernel=kernels.guided(taught())), hold=PATH.hold())
    yield "mh regrow, guided", lambda: PATH.run(nw.mh(60, kernel=kernels.regrow(5, guide=taught()), keep=20))
    yield "ais, guided", lambda: PATH.run(nw.ais(10, 4, kernels.guided(taught()), moves=2))
    for metric in ("diagonal", "dense", "low-rank", "unit"):
        chain = {"warmup": 60, "chains": 2, "metric": metric}
        yield from variants(f"hmc {metric}", LINE, nw.hmc(20, 8, **chain))
        yield from variants(f"nuts {metric}", LINE, nw.nuts(20, 5, **chain))
    yield from variants("hmc mixture", MIXTURE, nw.hmc(10, 6, 0.5, 2, 40, climb=20, thin=2))
    yield from variants("nuts mixture", MIXTURE, nw.nuts(10, 4, 2, 40, climb=20))
    numbers = nw.hmc(20, 8, warmup=20, metric=(1.0, 2.0), step_size=0.2)
    yield "hmc of numbers", lambda: LINE.run(numbers)
    yield from variants("hmc explore", MIXTURE, nw.methods.explore(2, 6, 4, 6, 50))
    for family in ("mean-field", "full-rank", "pathfinder"):
        for start in ("pathfinder", "run") if family != "pathfinder" else ("pathfinder",):
            yield from variants(
                f"vi {family} from {start}", LINE, nw.vi(family, 40, 300, 8, start=start, paths=2)
            )
    yield from variants("emulate", Subject(solids, (), tree_score), nw.emulate(12))
    yield from guided("improve", TREE, partial(nw.methods.improve, 30, 6, rounds=6))
    yield from guided("improve diverse", TREE, partial(nw.methods.improve, 30, 6, rounds=2, diverse=2))
    yield from guided("improve path", PATH, partial(nw.methods.improve, 30, 6, rounds=6))


def inside(method: Method) -> Any:
    """A model with a search inside."""

    @nw.model
    def outer():  # type: ignore[no-untyped-def]
        return nw.infer(inner, method)

    return outer


def of_the_rest() -> Iterator[tuple[str, Search]]:
    """Yield searches that are no method: searches inside, what goes on from a result, training, and random programs."""
    for name, method in {**HONOURED, "enumerate_all": nw.enumerate_all(), "smc": nw.smc(20)}.items():
        yield f"infer {name}", lambda method=method: nw.run(inside(method), nw.forward(10), seed=SEED)
    yield "infer in a chain", lambda: nw.run(inside(nw.enumerate_all()), nw.mh(100), seed=SEED)
    yield "run of given choices", lambda: MIXTURE.run(nw.forward(), choices=MIXTURE.hold())
    yield (
        "chain from given choices",
        lambda: MIXTURE.run(nw.mh(200), choices=MIXTURE.run(nw.forward()).best.choices),
    )
    yield "more", lambda: MIXTURE.run(nw.mh(300, kernel=resumed.ALL, keep=20)).more(200)
    yield "polish", lambda: TREE.run(nw.smc(20)).polish(nw.mh(100, keep=10))
    yield "regrow of a part", lambda: simple_ship_grown().regrow("body", 20)
    yield "smc of every solid", lambda: SOLIDS.run(nw.smc(20, power=0.1))
    yield "mh of every solid", lambda: SOLIDS.run(nw.mh(200, keep=20))
    yield "drag", lambda: dragged(post, "top", (1.0, 0.5, 1.0))
    yield "drag of an arm", lambda: dragged(arm, "hand", (1.5, 1.0, 0.0))
    yield "drag out of reach", lambda: dragged(post, "top", (0.0, 0.5, 3.0))
    yield "log_density", lambda: gradient(LINE)
    yield "train_guide", resumed.training
    yield "train_guide by the bound", bound
    yield "train_look_ahead", taught
    yield "train_order", learned_order
    for case in ("improve", "several", "runs", "chain", "ladder", "outside"):
        yield f"long {case}", resumed.CASES[case]
        yield f"long {case}{RESUMED}", partial(gone_on, resumed.CASES[case])
    for seed in range(20):
        for kind in ("populations", "chains"):
            yield f"random program {seed} {kind}", partial(random_program, seed, kind)
    for seed in range(10):
        program = partial(finite_programs.text, seed, memo=seed % 2 == 1)
        yield f"finite program {seed}", lambda program=program: nw.run(load(program()), nw.smc(20), seed=SEED)


def random_program(seed: int, kind: str) -> str:
    """Return the result of a random program's search, or its message, without the number in the name of its file."""
    return re.sub(r"random--?\d+", "random", searches.result_hash(seed, kind))


def bound() -> nw.Guide:
    """A guide by the evidence bound."""
    few = Training.bound(steps=60, hidden=(8, 8))
    return nw.train_guide(resumed.path, SIDES, side_score, training=few, seed=4)


def simple_ship_grown() -> nw.Result:
    """A ship whose parts are grown again."""
    return nw.run(simple_ship.simple_ship, nw.smc(10), seed=SEED)


def dragged(model: Any, part: str, to: tuple[float, ...]) -> Any:
    """The answers to a drag."""
    return nw.run(model, seed=3).best.drag(part, to)


def gradient(subject: Subject) -> list[Any]:
    """The log density around a run, and its gradient."""
    density = subject.run(nw.forward()).best.log_density()
    return list(density.value_and_gradient(density.start))


def learned_order() -> Any:
    """An order of futures."""
    requests = [nw.Search(TREE.model, score=TREE.score())]
    return train_order(TREE.model, requests, method=nw.smc(8), rounds=2, orders=4, runs=1, judging=2, seed=1)


def of_the_gallery() -> Iterator[tuple[str, Search]]:
    """Every model of the gallery."""
    for entry in entries():
        yield f"gallery {entry.name}", partial(of_gallery, entry)


def of_gallery(entry: Entry) -> nw.Result:
    """A short search of a model, by the usual search or by its own."""
    few: dict[str, Any] = {"seed": SEED}
    if entry.target_name is not None:
        return nw.grow(
            entry.model, entry.target(), method=nw.methods.improve(20, 6, rounds=3), voxel=entry.voxel, **few
        )
    if entry.draws is not None and entry.window is not None:
        score, start = entry.score() if entry.score is not None else None, ()
        if entry.drawing_name is not None:
            drawing = drawings.drawing(entry.drawing_name)
            score, start = drawing.score(entry.window), drawing.place(entry.window)
        settings = {**entry.usual, "particles": 30}
        return nw.grow(entry.model, None, *start, score=score, method=nw.smc(**settings), **few)
    module = import_module(f"niwaki.gallery.{entry.name.replace('-', '_')}")
    method = getattr(module, "METHOD", getattr(module, "SEARCH", nw.smc()))
    if isinstance(method, nw.methods.Mh):
        method = replace(method, steps=1000, warmup=200, thin=50)
    if isinstance(method, nw.methods.Smc):
        # A run of the coffee shop takes a second.
        method = replace(method, particles=3)
    return nw.run(entry.model, method=method, **few)


def of_all() -> dict[str, Search]:
    """Every search by its name."""
    table: dict[str, Search] = {}
    for some in (of_methods, of_the_rest, of_the_gallery):
        for name, search in some():
            assert name not in table, name
            table[name] = search
    return table
