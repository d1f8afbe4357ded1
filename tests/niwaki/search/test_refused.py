"""Claim: a setting that the engine refuses when a search starts gives a whole message: no part of it is empty.

The engine checks the settings when a method is made; these methods were changed by hand afterwards.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki.errors import InputError
from niwaki.lang.compiled import translated

GOLDEN = Path(__file__).parents[2] / "golden" / "refused.txt"


@nw.model
def coin() -> bool:
    heads = nw.flip(0.3)
    nw.factor(0.0 if heads else -1.5)
    return heads


MOVED = nw.smc(20, rejuvenate=nw.kernels.prior())
ABSOLUTE = nw.smc(20, weights="absolute")
CHAIN = nw.particle_gibbs(8, 4)

SETTINGS: dict[str, tuple[Any, dict[str, Any]]] = {
    "samples": (nw.importance(5), {"n": 0}),
    "particles": (nw.smc(20), {"particles": 0}),
    "populations": (nw.smc((20, 20)), {"particles": []}),
    "seconds": (nw.smc(20), {"seconds": 0.0}),
    "power": (nw.smc(20), {"power": -1.0}),
    "threshold": (nw.smc(20), {"ess": 2.0}),
    "schedule": (nw.smc(20), {"anneal": [-1.0]}),
    "schedule of absolute weights": (ABSOLUTE, {"anneal": [1.0]}),
    "moves": (MOVED, {"moves": 0}),
    "moves of absolute weights": (MOVED, {"weights": "absolute"}),
    "sweeps": (CHAIN, {"sweeps": 0}),
    "one particle": (CHAIN, {"particles": 1}),
    "adaptive chain": (CHAIN, {"anneal": 0.5}),
    "unknown": (nw.smc(20), {"particle": 20}),
    "no number": (nw.smc(20), {"moves": "many"}),
}


def message(name: str) -> str:
    method, changes = SETTINGS[name]
    text = json.dumps(json.loads(method.text()[0]) | changes)
    task = nw.Search(coin, method=method, seed=1).task
    with pytest.raises(InputError) as caught, translated("coin"):
        task.search(text, 1)
    return str(caught.value)


def test_messages_of_the_engine(golden: Any) -> None:
    messages = {name: message(name) for name in SETTINGS}
    for name, text in messages.items():
        assert not re.search(r"``|  $|: $|cannot be $|to $|  or", text, re.M), (name, text)
        assert re.search(" = (found|why): .*\n = help: ", text), (name, text)
    golden(GOLDEN, "".join(f"## {name}\n\n{text}\n\n" for name, text in messages.items()))
