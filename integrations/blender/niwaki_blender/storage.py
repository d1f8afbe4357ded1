"""Storage in the .blend: the search of a collection, and the data of its results.

The collection of a run has the text of run.json, and an inner collection for each result. Reading them runs no code.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence

import bpy

from . import growth

#: Custom properties of the collections of runs and results.
RUN, ORIGIN, NUMBER = "niwaki_run", "niwaki_origin", "niwaki_number"
#: Custom properties of a run's collection: the file of its model, and the hash of its bytes.
FILE, FILE_HASH = "niwaki_file", "niwaki_file_sha256"
#: Custom properties of a part: its address, from the GLB file, and whether it is held.
ADDRESS, HELD = "address", "niwaki_held"


def store_run(
    collection: bpy.types.Collection, outcome: growth.GrowthOutcome, origin: Sequence[float]
) -> None:
    """Store a search and the place of the model's origin in a collection."""
    collection[RUN] = outcome.run
    collection[ORIGIN] = tuple(origin)
    file = growth.model_file(outcome.run)
    if file is not None:
        collection[FILE], collection[FILE_HASH] = str(file[0]), file[1]


def store_result(collection: bpy.types.Collection, outcome: growth.GrowthOutcome, number: int) -> None:
    """Store the data of a result in its collection."""
    numbers, stored = outcome.outcomes[number], growth.results(outcome.run)[number]
    collection[NUMBER] = number
    # Seeds are larger than Blender's integers.
    collection["niwaki_seed"] = str(numbers.seed)
    for name, value in (
        ("score", numbers.log_score),
        ("covered", numbers.covered),
        ("outside", numbers.outside),
    ):
        if value is not None:
            collection[f"niwaki_{name}"] = value
    collection["niwaki_choices"] = json.dumps({row["address"]: row["value"] for row in stored["choices"]})


def result_of(obj: bpy.types.Object | None) -> bpy.types.Collection | None:
    """Find the result that an object belongs to."""
    if obj is not None:
        for collection in obj.users_collection:
            if NUMBER in collection:
                return collection
    return None


def run_of(result: bpy.types.Collection) -> bpy.types.Collection | None:
    """Find the run that a result belongs to."""
    for collection in bpy.data.collections:
        if RUN in collection and result.name in collection.children:
            return collection
    return None


def parts(result: bpy.types.Collection) -> Iterator[bpy.types.Object]:
    """Go through the parts of a result."""
    return (obj for obj in result.objects if ADDRESS in obj)


def below(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Go through the parts at and below an object."""
    for inner in (obj, *obj.children_recursive):
        if ADDRESS in inner:
            yield inner


def held(result: bpy.types.Collection) -> list[str]:
    """List the addresses of the held parts."""
    return [part[ADDRESS] for part in parts(result) if part.get(HELD)]
