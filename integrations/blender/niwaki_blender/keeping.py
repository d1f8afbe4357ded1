"""The search of a collection, kept in the .blend: its run.json, and what each result is.

A run's collection has the text, and a collection in it for each result. Reading them runs nothing.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence

import bpy

from . import growing

#: Custom properties of a run's collection, and of a result's.
RUN, ORIGIN, NUMBER = "niwaki_run", "niwaki_origin", "niwaki_number"
#: Custom properties of a run's collection: the file of its model, and the hash of its bytes.
FILE, FILE_HASH = "niwaki_file", "niwaki_file_sha256"
#: Custom properties of a part: its address, which comes from the file, and whether it is held.
ADDRESS, HELD = "address", "niwaki_held"


def keep_run(collection: bpy.types.Collection, grown: growing.Grown, origin: Sequence[float]) -> None:
    """Write a search into its collection, and where the model's origin stands."""
    collection[RUN] = grown.run
    collection[ORIGIN] = tuple(origin)
    file = growing.model_file(grown.run)
    if file is not None:
        collection[FILE], collection[FILE_HASH] = str(file[0]), file[1]


def keep_result(collection: bpy.types.Collection, grown: growing.Grown, number: int) -> None:
    """Write what a result is into its collection."""
    outcome, stored = grown.outcomes[number], growing.results(grown.run)[number]
    collection[NUMBER] = number
    # Seeds are longer than Blender's whole numbers.
    collection["niwaki_seed"] = str(outcome.seed)
    for name, value in (
        ("score", outcome.log_score),
        ("covered", outcome.covered),
        ("outside", outcome.outside),
    ):
        if value is not None:
            collection[f"niwaki_{name}"] = value
    collection["niwaki_choices"] = json.dumps({one["address"]: one["value"] for one in stored["choices"]})


def result_of(thing: bpy.types.Object | None) -> bpy.types.Collection | None:
    """The result that an object belongs to."""
    if thing is not None:
        for collection in thing.users_collection:
            if NUMBER in collection:
                return collection
    return None


def run_of(result: bpy.types.Collection) -> bpy.types.Collection | None:
    """The run that a result belongs to."""
    for collection in bpy.data.collections:
        if RUN in collection and result.name in collection.children:
            return collection
    return None


def parts(result: bpy.types.Collection) -> Iterator[bpy.types.Object]:
    """The objects of a result that are parts."""
    return (thing for thing in result.objects if ADDRESS in thing)


def below(thing: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """The parts at and below an object."""
    for one in (thing, *thing.children_recursive):
        if ADDRESS in one:
            yield one


def held(result: bpy.types.Collection) -> list[str]:
    """The addresses of the parts that are held."""
    return [thing[ADDRESS] for thing in parts(result) if thing.get(HELD)]
