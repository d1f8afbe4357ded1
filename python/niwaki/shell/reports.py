"""Reports on a model and its runs as values: `--json` prints them, and events of the studio carry them."""

from __future__ import annotations

import msgspec
from msgspec import Struct

from niwaki.requirements.rows import RequirementRow


class FunctionRow(Struct):
    """A function of a model; a function without sites is pure."""

    name: str
    sites: int = 0


class ChoiceRow(Struct):
    """A choice in the text of a model: its function, its component of addresses, its line."""

    function: str
    choice: str
    line: int


class AdviceRow(Struct):
    """Advice about a line of a model."""

    code: str
    line: int
    text: str


class CheckReport(Struct):
    """A report on a model: its functions and choices, advice, and requirements."""

    model: str
    arguments: str = ""
    constants: int = 0
    functions: list[FunctionRow] = []
    choices: list[ChoiceRow] = []
    advice: list[AdviceRow] = []
    requirements: list[RequirementRow] = []


class RunRow(Struct):
    """A run of a model without a target; the value that it returned, if it emitted nothing."""

    seed: int
    primitives: int
    value: str = ""


class ShowReport(Struct):
    """A report on runs of a model without a target."""

    runs: list[RunRow] = []


def as_json(report: Struct) -> str:
    """Return a report as one line of JSON."""
    return msgspec.json.encode(report).decode()
