"""The four programs at sizes 1, 4, 10: our four strategies, WebPPL's two methods and the limit, taking turns."""

import statistics
from collections import defaultdict
from math import exp, log

from data import write_sized
from machine import CACHE

from chains.ours import Timed
from chains.peers import METHODS, Peers
from chains.programs import PROGRAMS
from chains.report import Report, middle, short

STRATEGIES = ("c3", "cache", "resume", "rerun")
#: At size 10: of the limit, and over our own rerun.
OF_LIMIT = {"hmm": 16, "gmm": 16, "lda": 20, "hlr": 20}
OVER_RERUN = {"hmm": 100, "lda": 20, "gmm": 20, "hlr": 20}


def measure(report: Report, peers: Peers, sizes: tuple[int, ...], rounds: int, seconds: float) -> None:
    """Measure all, print the table, and compare it with the targets."""
    rates: dict[tuple[str, int], dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    for seed in range(1, rounds + 1):
        for name, program in PROGRAMS.items():
            for size in sizes:
                count, here = program.count(size), rates[name, size]
                for strategy in STRATEGIES:
                    chain = Timed(
                        program.model, count, kernel=program.kernel(count), strategy=strategy, seed=seed
                    )
                    rate = chain.warm(0.2 * seconds).window(0.4 * seconds)
                    here[strategy].append(rate.per_second)
                    report.note(system=strategy, program=name, size=size, seed=seed, rate=rate.per_second)
                limit = peers.of_limit(
                    "rate", name, write_sized(CACHE / "data", name, size), 0.3 * seconds, seed
                )
                here["limit"].append(limit["proposals"] / limit["cpu_seconds"])
                report.note(system="limit", program=name, size=size, seed=seed, rate=here["limit"][-1])
                for method in METHODS:
                    rate = peers.rate_of_webppl(name, size, method, seconds, seed)
                    here[method].append(rate["proposals"] / rate["cpu_seconds"])
                    report.note(
                        system=method,
                        program=name,
                        size=size,
                        seed=seed,
                        rate=here[method][-1],
                        first=rate["first"],
                    )
    show(report, rates)
    hold(report, rates, sizes)


def ratios(here: dict[str, list[float]], over: str, under: str) -> list[float]:
    """Return the ratios of measurements that were taken one after the other."""
    return [a / b for a, b in zip(here[over], here[under], strict=True)]


def show(report: Report, rates: dict[tuple[str, int], dict[str, list[float]]]) -> None:
    columns = ("program", "size", *STRATEGIES, "WebPPL MH", "WebPPL C3", "limit")
    table = report.table("proposals per CPU second: median (least to most)", *columns)
    for (name, size), here in rates.items():
        systems = (*STRATEGIES, *METHODS, "limit")
        table.add_row(name, str(size), *(middle(here[system]) for system in systems))
    report.show(table)
    table = report.table(
        "ratios", "program", "size", "C3 / WebPPL C3", "C3 / WebPPL MH", "C3 / rerun", "limit / C3"
    )
    for (name, size), here in rates.items():
        pairs = (("c3", "incrementalMH"), ("c3", "MH"), ("c3", "rerun"), ("limit", "c3"))
        table.add_row(name, str(size), *(middle(ratios(here, *pair)) for pair in pairs))
    report.show(table)


def hold(
    report: Report, rates: dict[tuple[str, int], dict[str, list[float]]], sizes: tuple[int, ...]
) -> None:
    over = {key: statistics.median(ratios(here, "c3", "incrementalMH")) for key, here in rates.items()}
    worst = min(over, key=lambda key: over[key])
    report.ask(f"C3 over WebPPL's C3, worst row ({worst[0]} {worst[1]})", over[worst], least=60)
    mean = exp(statistics.fmean(log(value) for value in over.values()))
    report.ask("C3 over WebPPL's C3, geometric mean (aim: 300)", mean, least=150)
    for name in PROGRAMS:
        here = rates[name, sizes[-1]]
        most = OF_LIMIT[name]
        ratio = statistics.median(ratios(here, "limit", "c3"))
        report.ask(
            f"{name} {sizes[-1]}: limit over C3, {short(statistics.median(here['c3']))}/s", ratio, most=most
        )
    for name in PROGRAMS:
        ratio = statistics.median(ratios(rates[name, sizes[-1]], "c3", "rerun"))
        report.ask(f"{name} {sizes[-1]}: C3 over rerun", ratio, least=OVER_RERUN[name])
