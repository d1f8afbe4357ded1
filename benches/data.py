"""The data of the bench programs: made by the gallery's code, read by all three systems.

A hidden Markov chain of 10 states, 10 symbols and 100 steps, whose tables are drawn from flat Dirichlet rows.
"""

import json
from pathlib import Path

from niwaki.gallery.data import hidden_chain


def hmm(steps: int = 100, states: int = 10, symbols: int = 10, seed: int = 11) -> dict[str, list]:
    """Tables and what was seen: initial (S,), transition (S, S), emission (S, O), observations (N,)."""
    chain = hidden_chain(steps, states, symbols, seed)
    return {
        "initial": list(chain.initial),
        "transition": [list(row) for row in chain.transition],
        "emission": [list(row) for row in chain.emission],
        "observations": list(chain.observations),
    }


def write(folder: Path) -> Path:
    """Write the chain as JSON into `folder` and return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "hmm.json"
    path.write_text(json.dumps(hmm()))
    return path
