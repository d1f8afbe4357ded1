"""Tables on the terminal, targets beside results, and every measurement as a line of JSON."""

import json
import statistics
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table


def middle(values: Sequence[float]) -> str:
    """The median, and the least and the most in brackets."""
    if len(values) == 1:
        return short(values[0])
    return f"{short(statistics.median(values))} ({short(min(values))} to {short(max(values))})"


def short(value: float) -> str:
    """Three digits, with k and M."""
    for unit, name in ((1e6, " M"), (1e4, " k")):
        if abs(value) >= unit:
            scale = 1e3 if name == " k" else unit
            return f"{value / scale:.3g}{name}"
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


class Report:
    """The results; `wrong` counts answers that are wrong, `missed` targets of speed."""

    def __init__(self, folder: Path, name: str = "c3") -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder
        self.console = Console(width=170)
        self.lines = (folder / f"{name}.jsonl").open("w")
        self.targets: list[tuple[str, str, str, str]] = []
        self.missed = self.wrong = 0

    def note(self, **facts: object) -> None:
        """Write a measurement to the file of lines."""
        print(json.dumps(facts), file=self.lines, flush=True)

    def table(self, title: str, *columns: str) -> Table:
        """An empty table; `show` prints it."""
        return Table(*columns, title=title, title_justify="left")

    def show(self, table: Table) -> None:
        self.console.print(table)

    def ask(self, label: str, value: float, least: float | None = None, most: float | None = None) -> None:
        """Hold a figure against its target."""
        value = float(value)
        holds = (least is None or value >= least) and (most is None or value <= most)
        target = f"at least {short(least)}" if least is not None else f"at most {short(most or 0.0)}"
        self.missed += not holds
        self.targets.append((label, short(value), target, "pass" if holds else "MISSED"))
        self.note(target=label, found=value, least=least, most=most, holds=holds)

    def answer(self, label: str, error: float, most: float) -> None:
        """Hold an error against what is allowed: above it, what was timed computes something else."""
        error = float(error)
        holds = error <= most
        self.wrong += not holds
        self.targets.append((label, f"{error:.3g}", f"at most {most:.3g}", "right" if holds else "WRONG"))
        self.note(answer=label, found=error, most=most, holds=holds)

    def close(self) -> int:
        """Print all targets and answers; 1 when an answer is wrong."""
        table = self.table("targets", "figure", "result", "target", "")
        for row in self.targets:
            table.add_row(*row, style="red" if row[-1] in ("MISSED", "WRONG") else None)
        self.show(table)
        self.console.print(f"{self.wrong} answers wrong, {self.missed} targets missed")
        self.lines.close()
        return int(self.wrong > 0)
