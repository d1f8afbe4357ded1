"""Claim: recorded searches give what the committed table says, and every method, kernel, model and command is recorded.

`make recorded` compares all of them; here are those that take the least time for what they cover.
"""

from __future__ import annotations

import inspect
import json
import math
from pathlib import Path
from typing import Any

import pytest
import recorded
from digests import digest
from niwaki import _engine, kernels, methods
from niwaki.gallery import entries
from niwaki.methods import Method
from niwaki.result import Sample
from niwaki.shell.app import COMMANDS
from recorded_searches import RESUMED, of_all, of_methods

TABLE: dict[str, Any] = json.loads(recorded.TABLE.read_text(encoding="utf-8"))
METHODS = [kind for kind in vars(methods).values() if inspect.isclass(kind) and issubclass(kind, Method)]


@pytest.mark.skipif(
    TABLE["machine"] != _engine.fingerprint(), reason="the table is of machines with other bits"
)
def test_searches_give_the_same_bits() -> None:
    names = [name for name, _ in of_methods() if not name.endswith((", held", ", guided", RESUMED))]
    now = recorded.hashes(names)
    assert len(now) > 80 and not recorded.differences(now, TABLE["searches"])


def test_the_table_has_each_search_and_no_other() -> None:
    assert list(TABLE["searches"]) == list(recorded.rows())
    # A search that fails has an error in place of a hash.
    assert all(len(digest) == 16 and int(digest, 16) >= 0 for digest in TABLE["searches"].values())


@pytest.mark.parametrize(
    "method", [kind for kind in METHODS if kind is not Method], ids=lambda kind: kind.NAME
)
def test_every_method_is_recorded_in_all_ways(method: type[Method]) -> None:
    names = [name for name in recorded.rows() if name.split(",")[0].split()[0] == method.NAME]
    assert any("," not in name for name in names)
    endings = [", held", RESUMED] + [", guided"] * ("guide" in inspect.signature(method).parameters)
    assert all(any(name.endswith(ending) for name in names) for ending in endings), (names, endings)


@pytest.mark.parametrize(
    "kernel", [kernel for kernel in kernels.__all__ if kernel not in ("Kernel", "parse")]
)
def test_every_kernel_is_recorded(kernel: str) -> None:
    assert any(name.split(",")[0].split()[:2] == ["mh", kernel] for name in recorded.rows())


def test_every_command_and_every_model_is_recorded() -> None:
    names = list(recorded.rows())
    # What programs ask for is in `tests/niwaki/agents`.
    assert {name.split()[1] for name in names if name.startswith("shell ")} == set(COMMANDS) - {"mcp"}
    assert {name.split()[1] for name in names if name.startswith("gallery ")} == {
        entry.name for entry in entries()
    }


class Moved(Sample):
    """A sample with one choice moved by the last bit."""

    @property
    def places(self) -> dict[str, Any]:
        """Its choices, with words as their places."""
        values = super().places
        address = next(address for address, value in values.items() if isinstance(value, float))
        return {**values, address: math.nextafter(values[address], math.inf)}


def test_one_bit_of_one_choice_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    table = str(tmp_path / "searches.json")
    result = of_all()["forward"]()
    monkeypatch.setattr(recorded, "rows", lambda: {"forward": lambda: digest(result)})
    assert recorded.main(["--table", table]) == 2
    assert recorded.main(["--table", table, "--write"]) == 0
    assert recorded.main(["--table", table]) == 0
    result.samples[7].__class__ = Moved
    capsys.readouterr()
    assert recorded.main(["--table", table]) == 1
    assert capsys.readouterr().err.startswith("forward: ")


def test_a_resumed_search_must_equal_the_plain_one() -> None:
    assert not recorded.differences({"mh": "1", "mh, resumed": "1"}, {"mh": "1", "mh, resumed": "1"})
    (line,) = recorded.differences({"mh": "1", "mh, resumed": "2"}, {"mh": "1", "mh, resumed": "2"})
    assert line.startswith("mh, resumed: 2")
