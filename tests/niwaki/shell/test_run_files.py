"""A run.json with anything wrong in it gives a message, and runs no Python."""

from __future__ import annotations

import base64
import json
import random
import warnings
import zlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from mutated import mutated, tracebacks
from niwaki import box, emit, flip, gaussian, kernels, model, uniform
from niwaki.errors import NiwakiError
from niwaki.shell import run_files
from niwaki.shell.references import ModelReference
from niwaki.targets.examples import ship
from niwaki.words import Gaussian

GOLDEN = Path(__file__).parents[2] / "golden"
SIZES = (0.5, 1.0)
BLOCK = box((0, 0.5, 0), (1, 1, 1))
HEIGHTS = np.array([1.0, 2.0, 3.0])


@dataclass(frozen=True)
class Foot:
    width: float
    turned: bool


@model
def pile(foot, y=0.0):
    height = uniform(SIZES[0], SIZES[1]) * HEIGHTS[0]
    emit(box((0, y + height / 2, 0), (foot.width, height, 1)))
    if flip(0.7):
        pile(foot, y + height)
    elif flip(0.5):
        emit(BLOCK)


@model
def near(y):
    x = gaussian(0.0, 1.0)
    nw.condition(abs(x - y) < 3.0)
    return x


def propose(old):
    return Gaussian(old, 0.5)


def searches() -> dict[str, nw.Search]:
    """A search of each kind: populations, chains with kernels and proposals, rounds, held choices, pictures."""
    foot, bounds = Foot(2.0, True), {"max_steps": 100_000, "max_memory": 1 << 26}
    volume = nw.no_self_intersection() * nw.match_volume(ship(), 2.0)
    camera = nw.Camera.perspective((0, 2, 20), look_at=(0, 2, 0))
    image = np.zeros((8, 8), bool)
    image[2:6, 3:5] = True
    moved = kernels.cycle(kernels.prior(), kernels.on("height", kernels.drift(0.2)))
    return {
        "smc": nw.Search(
            pile,
            (foot,),
            volume,
            nw.smc(10, power=4.0, anneal=[0.5, 1.0], rejuvenate=moved, at="end"),
            **bounds,
        ),
        "chains": nw.Search(
            near,
            (0.5,),
            method=nw.mh(50, chains=2, kernel=kernels.on("x", kernels.proposal(propose))),
            choices={"x": 0.1},
            **bounds,
        ),
        "improve": nw.Search(pile, (foot, 0.5), nw.floor(0.0), nw.improve(10, rounds=2), runs=2, **bounds),
        "polished": nw.Search(near, (0.5,), hold={"x": 0.25}, **bounds),
        "picture": nw.Search(pile, (foot,), nw.match_image(image, camera), nw.smc(5), **bounds),
    }


def files() -> dict[str, dict[str, Any]]:
    """The run.json of each."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return {name: json.loads(json.dumps(written(search))) for name, search in searches().items()}


def written(search: nw.Search) -> dict[str, Any]:
    result = search.run()
    if isinstance(search.method, nw.methods.Mh):
        result = nw.Result(search, result.bests, result.seed)
    return run_files.written(result, ModelReference("pile.py:pile", search.model))


def replay(place: Path) -> None:
    data = run_files.load(place)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run_files.replayed(data, path=place)


def attempts(count: int, chance: random.Random) -> Iterable[tuple[str, bytes]]:
    for name, data in files().items():
        for _ in range(count):
            change, text = mutated(data, chance)
            yield f"{name}, {change}", text


def test_every_kind_is_replayed(tmp_path: Path) -> None:
    for data in files().values():
        (tmp_path / "run.json").write_text(json.dumps(data))
        replay(tmp_path / "run.json")


def test_a_run_file_that_was_changed_gives_a_message(tmp_path: Path) -> None:
    assert tracebacks(attempts(50, random.Random(1)), replay, tmp_path / "run.json") == []


@pytest.mark.soak
def test_many_run_files_that_were_changed_give_messages(tmp_path: Path) -> None:
    seed = random.SystemRandom().getrandbits(32)
    print("seed", seed)
    assert tracebacks(attempts(4000, random.Random(seed)), replay, tmp_path / "run.json") == []


def wrong() -> dict[str, Callable[[dict[str, Any]], Any]]:
    """Yield changes of a run.json with their names."""

    def at(*keys: Any, value: Any) -> Callable[[dict[str, Any]], Any]:
        def change(data: dict[str, Any]) -> None:
            for key in keys[:-1]:
                data = data[key]
            data[keys[-1]] = value

        return change

    return {
        "a newer file": at("format", value=99),
        "an older file": at("format", value=1),
        "a newer search": at("search", "format", value=99),
        "particles in words": at("search", "method", "particles", value="many"),
        "a kernel that is a number": at("search", "method", "rejuvenate", "parts", 1, "parts", 0, "name", value=3),
        "no particles": at("search", "method", "particles", value=0),
        "a sketch that nobody knows": at("search", "score", 0, "sketch", value="match_taste"),
        "a size in words": at("search", "score", 1, "given", "voxel", value={"vec": ["a"]}),
        "an argument of no kind": at("search", "args", 0, "fields", "width", value={"size": 3}),
        "an array without its bytes": at("search", "model", "constants", 0, value={"array": "<f8", "shape": [2]}),
        "too large an array": at("search", "args", 0, value={"array": "<f8", "shape": [10**6, 10**6], "bytes": "0"}),
        "a class with a name of code": at("search", "args", 0, "record", "name", value="x; import os"),
        "a best run that is not there": at("best", value=10**6),
        "an address in numbers": at("runs", 0, "choices", 0, "address", value=7),
        "a choice without end": at("runs", 0, "choices", 0, "value", value={"list": []}),
        "core form that is none": at("search", "model", "core", value="(module"),
        "no runs": at("runs", value=[]),
    }  # fmt: skip


def test_messages_name_the_place(tmp_path: Path, golden: Any) -> None:
    texts, place = [], tmp_path / "run.json"
    text = json.dumps(files()["smc"])
    for name, change in wrong().items():
        data = json.loads(text)
        change(data)
        if name == "a best run that is not there":
            data["best"] = 10**6
        elif "runs" in data and data["runs"]:
            data["best"] = 0
        place.write_text(json.dumps(data))
        with pytest.raises(NiwakiError) as caught:
            replay(place)
        texts.append(f"## {name}\n\n{caught.value}\n".replace(str(place), "run.json"))
    golden(GOLDEN / "run-files.txt", "\n".join(texts))


def test_a_name_that_no_file_can_have_gives_a_message(tmp_path: Path) -> None:
    data = files()["picture"]
    for name in ("x" * 5000, "a\0b"):
        data["search"]["score"][0]["given"]["camera"] = name
        (tmp_path / "run.json").write_text(json.dumps(data))
        with pytest.raises(NiwakiError):
            replay(tmp_path / "run.json")
    with pytest.raises(NiwakiError):
        run_files.load("x" * 5000)


def test_a_text_of_few_bytes_takes_no_memory(tmp_path: Path) -> None:
    # A gigabyte of zeros is a few kilobytes when it is packed.
    bomb = base64.b85encode(zlib.compress(bytes(1 << 22))).decode()
    with pytest.raises(NiwakiError, match="expected 8 bytes"):
        search = searches()["chains"].data()
        search["args"] = [{"array": "<f8", "shape": [1], "bytes": bomb}]
        nw.Search.of_data(search)


def searches_as_json() -> dict[str, Any]:
    """The JSON of each search, its meshes inside."""
    return {name: json.loads(search.json("inside")) for name, search in searches().items()}


def read_search(place: Path) -> None:
    search = nw.Search.of_json(place.read_text(encoding="utf-8", errors="replace"))
    assert len(search.hash) == 64


def test_the_json_of_a_search_that_was_changed_gives_a_message(tmp_path: Path) -> None:
    chance = random.Random(2)
    for name, data in searches_as_json().items():
        tries = [mutated(data, chance) for _ in range(25)]
        assert tracebacks(tries, read_search, tmp_path / "one.json") == [], name


@pytest.mark.soak
def test_much_json_of_searches_that_was_changed_gives_messages(tmp_path: Path) -> None:
    seed = random.SystemRandom().getrandbits(32)
    print("seed", seed)
    chance = random.Random(seed)
    for name, data in searches_as_json().items():
        tries = [mutated(data, chance) for _ in range(2000)]
        assert tracebacks(tries, read_search, tmp_path / "one.json") == [], name


def test_a_guide_that_was_changed_gives_a_message(tmp_path: Path) -> None:
    # Its header is JSON, which the engine reads.
    chance = random.Random(3)
    shipped = next((Path(nw.__file__).parent / "guides" / "shipped").glob("*"))
    data = shipped.read_bytes()
    length = int.from_bytes(data[:8], "little")
    header = json.loads(data[8 : 8 + length])
    tries = []
    for _ in range(60):
        change, text = mutated(header, chance)
        size = len(text) if chance.random() < 0.7 else chance.choice([0, 2**63, len(text) // 2])
        tries.append((change, size.to_bytes(8, "little") + text + data[8 + length :]))
    assert tracebacks(tries, lambda place: nw.Guide.load(place).show(), tmp_path / "one.guide") == []
