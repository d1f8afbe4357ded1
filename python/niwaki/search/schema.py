"""Schema of the JSON of a search; `niwaki.search.data` reads the values in it."""

from __future__ import annotations

from typing import Annotated, Any

from msgspec import Meta, Struct

#: A table of names and values.
Table = dict[str, Any]


class RecordClass(Struct):
    """Class of records."""

    name: str
    fields: list[str]
    kind: str


class ModelData(Struct):
    """Model: its core form, and its constants."""

    name: str
    core: str
    constants: list[Any]
    classes: list[RecordClass]
    parameters: list[str]
    required: Annotated[int, Meta(ge=0, le=10_000)]


class SketchData(Struct):
    """Sketch: its name and its arguments."""

    sketch: str
    given: Table


class SearchData(Struct):
    """Search: all its settings."""

    format: int
    model: ModelData
    args: list[Any]
    score: list[SketchData]
    method: Table
    seed: int
    choices: Table | None
    lock: Table | None
    runs: int
    keep: str
    polish: Table | None
    max_steps: int
    max_memory: int
