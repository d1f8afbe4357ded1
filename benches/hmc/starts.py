"""The time until chains start: from a recorded graph to the first gradient and to machine code; compiling the peers."""

import statistics

from chains.report import Report

from hmc.ours import Programs

#: Model, coordinates, most milliseconds until machine code (other sizes have no target).
SIZES = {"ring": None, "coloring": None, "stack": 60.0, "stack12": None, "stack28": 250.0}
FIRST_GRADIENT = 30.0


def measure(report: Report, programs: Programs, rounds: int, peers: dict[str, float]) -> None:
    """Our milliseconds, the median of fresh processes, and the peers' seconds that the rates found."""
    table = report.table(
        "milliseconds from nothing to something (medians of fresh processes)",
        *("model", "coordinates", "operations", "record + differentiate", "first gradient"),
        *("machine code", "its CPU time", "while a chain runs"),
    )
    for model, most in SIZES.items():
        runs = [programs.start(model) for _ in range(rounds)]
        middle = {key: statistics.median(run[key] for run in runs) for key in runs[0]}
        times = (
            "record_ms",
            "first_gradient_ms",
            "machine_code_ms",
            "machine_code_cpu_ms",
            "chain_until_machine_code_ms",
        )
        table.add_row(
            model,
            f"{middle['dim']:.0f}",
            f"{middle['operations']:.0f}",
            *(f"{middle[key]:.2f}" for key in times),
        )
        report.note(start=model, **middle)
        if most is not None:
            report.ask(f"{model}: ms until machine code", middle["chain_until_machine_code_ms"], most=most)
    report.ask(
        "stack28: ms from a graph to the first gradient", middle["first_gradient_ms"], most=FIRST_GRADIENT
    )
    report.show(table)
    if peers:
        table = report.table("seconds to compile (first run less a later one)", "model and system", "seconds")
        for name, seconds in peers.items():
            if not name.endswith((" niwaki", " limit")):
                table.add_row(name, f"{seconds:.1f}")
                report.note(compile=name, seconds=seconds)
        report.show(table)
