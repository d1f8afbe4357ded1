"""Variants of one program; global choices alone; the first thousand proposals; chains of 100 to 100,000 steps.

One proposal to a state in the middle of the first hundred must enter as many activations and execute as many
instructions whether a hundred steps follow or a hundred thousand. Random numbers are functions of addresses, so the
same seed gives both chains the same first states, the same proposals and the same decisions.
"""

import statistics
from pathlib import Path
from typing import Any

from data import write_sized
from machine import CACHE
from models import gmm_forms, hmm_forms
from models.hmm_long import long_chain
from niwaki import kernels

from chains.ours import Timed, first_thousand
from chains.peers import Peers
from chains.programs import PROGRAMS, of_gmm
from chains.report import Report, middle, short

#: Observations of the forms: size 10.
POINTS = 1000
LENGTHS = (100, 1000, 10_000, 100_000)


def forms(report: Report, rounds: int, seconds: float) -> None:
    """Each form of the chain and of the mixture, in turns."""
    table = report.table(
        "forms at size 10: proposals per CPU second", "program", "form", "rate", "entered", "instructions"
    )
    for name, all_forms in (("hmm", hmm_forms.FORMS), ("gmm", gmm_forms.FORMS)):
        kernel = None if name == "hmm" else of_gmm(POINTS)
        chains = {
            form: Timed(variant, POINTS, kernel=kernel).warm(seconds / 2)
            for form, variant in all_forms.items()
        }
        rates: dict[str, list[float]] = {form: [] for form in chains}
        counters: dict[str, dict[str, float]] = {}
        for _ in range(rounds):
            for form, chain in chains.items():
                rate = chain.window(seconds)
                rates[form].append(rate.per_second)
                counters[form] = rate.counters
        fastest = max(statistics.median(values) for values in rates.values())
        for form, values in rates.items():
            seen = counters[form]
            table.add_row(name, form, middle(values), f"{seen['entered']:.2f}", f"{seen['instructions']:.1f}")
            report.note(form=form, program=name, rates=values, counters=seen)
            report.ask(f"{name} {form}: fastest form over it", fastest / statistics.median(values), most=2)
        report.ask(
            f"{name} returned list, proposals/s", statistics.median(rates["returned list"]), least=0.5e6
        )
    report.show(table)


def global_choices(report: Report, peers: Peers, rounds: int, seconds: float) -> None:
    """Proposals to topics, means of components and means of the population alone, at size 10."""
    columns = ("program", "readers", "ours, proposals/s", "entered", "ns per reader", "limit, ns per reader")
    table = report.table("global choices alone, size 10", *columns)
    for name, program in PROGRAMS.items():
        if program.global_kernel is None or program.readers is None:
            continue
        count = program.count(10)
        readers, ours, theirs, entered = program.readers(count), [], [], 0.0
        chain = Timed(program.model, count, kernel=program.kernel(count)).warm(seconds / 2)
        chain = Timed(program.model, count, kernel=program.global_kernel).warm(seconds / 2)
        for seed in range(1, rounds + 1):
            rate = chain.window(seconds)
            ours.append(rate.per_second)
            entered = rate.counters["entered"]
            rates = peers.of_limit("globals", name, write_sized(CACHE / "data", name, 10), seconds, seed)
            theirs.append(1e9 * rates["cpu_seconds"] / rates["proposals"] / rates["readers"])
        price = [1e9 / rate / readers for rate in ours]
        table.add_row(name, short(readers), middle(ours), f"{entered:.0f}", middle(price), middle(theirs))
        report.note(globals=name, readers=readers, rates=ours, entered=entered, limit=theirs)
        report.ask(
            f"{name}: ns for each call that reads a global choice (aim: 25)",
            statistics.median(price),
            most=100,
        )
    report.show(table)


def beginnings(report: Report, seconds: float) -> None:
    """The first thousand proposals of fresh chains beside the steady rate, at size 10."""
    table = report.table(
        "the first thousand proposals, size 10", "program", "first 1000/s", "steady/s", "share"
    )
    for name, program in PROGRAMS.items():
        count = program.count(10)
        kernel = program.kernel(count)
        steady = Timed(program.model, count, kernel=kernel).warm(seconds).window(seconds).per_second
        first = first_thousand(program.model, count, kernel=kernel)
        table.add_row(name, short(first), short(steady), f"{first / steady:.2f}")
        report.ask(f"{name} 10: first thousand over the steady rate", first / steady, least=0.5)
    report.show(table)


def lengths(report: Report, rounds: int, seconds: float, most: int = LENGTHS[-1]) -> None:
    """The chain at 100 to 100,000 steps: counters of one site, rates, bytes."""
    chosen = [length for length in LENGTHS if length <= most]
    chains: dict[int, Timed] = {}
    held: dict[int, int] = {}
    for length in chosen:
        before = resident()
        chains[length] = Timed(long_chain, length).warm(seconds / 2)
        held[length] = resident() - before
    counted = {length: middle_site(length) for length in chosen}
    rates: dict[int, list[float]] = {length: [] for length in chosen}
    counters: dict[int, dict[str, float]] = {}
    for _ in range(rounds):
        for length, chain in chains.items():
            rate = chain.window(seconds)
            rates[length].append(rate.per_second)
            counters[length] = rate.counters
    columns = (
        "steps",
        "proposals/s",
        "site 50: entered, instructions",
        "all: entered, instructions",
        "bytes/step",
        "resident/step",
    )
    table = report.table("a chain of 100 to 100,000 steps", *columns)
    for length in chosen:
        seen = counters[length]
        table.add_row(
            str(length),
            middle(rates[length]),
            "{:.4f}, {:.4f}".format(*counted[length]),
            f"{seen['entered']:.2f}, {seen['instructions']:.2f}",
            f"{seen['bytes'] / length:.0f}",
            f"{held[length] / length:.0f}",
        )
        report.note(
            length=length, rates=rates[length], counters=seen, site=counted[length], resident=held[length]
        )
    report.show(table)
    different = max(abs(a - b) for c in counted.values() for a, b in zip(c, counted[100], strict=True))
    report.answer("HMM: entered and executed at one site, difference between lengths", different, 0.0)
    fastest = statistics.median(rates[100])
    for length, limit in ((10_000, 1.3), (100_000, 2.5)):
        if length in rates:
            ratio = fastest / statistics.median(rates[length])
            report.ask(f"HMM: time at {length} steps over 100", ratio, most=limit)
    per = [counters[length]["bytes"] / length for length in chosen]
    report.ask("HMM: bytes per step, most over least", max(per) / min(per), most=1.25)


def middle_site(length: int) -> tuple[float, float]:
    """Activations entered and instructions executed for each proposal to step 50."""
    chain = Timed(long_chain, length, kernel=kernels.on("n[49]/state", kernels.prior()), seed=5)
    before = chain.engine.counters()
    chain.engine.advance(2000, 1, None)
    after = chain.engine.counters()
    entered, executed = (after[key] - before[key] for key in ("entered", "instructions"))
    return entered / 2000, executed / 2000


def resident() -> int:
    """Bytes of this process that are in memory."""
    pages = Path("/proc/self/statm").read_text().split()[1]
    return int(pages) * 4096


def measure(report: Report, peers: Peers, quick: bool, **settings: Any) -> None:
    """All rows."""
    rounds, seconds = settings["rounds"], settings["seconds"]
    forms(report, rounds, seconds)
    global_choices(report, peers, rounds, seconds)
    beginnings(report, seconds)
    lengths(report, rounds, seconds, 10_000 if quick else 100_000)
