"""The data of the bench programs: made by the gallery's code, read by all systems.

A size of 1 is 100 observations, of 10 a thousand. A hidden Markov chain of 10 states and 10 symbols; documents of 20
words out of 100, about 10 topics; points of 4 clusters; sequences of 5 measurements (dissertation, appendix A).
"""

import json
from pathlib import Path

from niwaki.gallery.data import clusters, documents, growth, hidden_chain


def hmm(steps: int = 100, states: int = 10, symbols: int = 10, seed: int = 11) -> dict[str, list]:
    """Tables and what was seen: initial (S,), transition (S, S), emission (S, O), observations (N,)."""
    chain = hidden_chain(steps, states, symbols, seed)
    return {
        "initial": list(chain.initial),
        "transition": [list(row) for row in chain.transition],
        "emission": [list(row) for row in chain.emission],
        "observations": list(chain.observations),
    }


def lda(count: int = 5) -> dict[str, object]:
    """Words of documents (D, 20), below `vocabulary`; how many topics there are."""
    return {"topics": 10, "vocabulary": 100, "documents": [list(one) for one in documents(count)]}


def gmm(points: int = 100) -> dict[str, object]:
    """Points (N,); how many components there are."""
    return {"components": 4, "points": list(clusters(points))}


def hlr(sequences: int = 20) -> dict[str, object]:
    """Times (5,) and what was measured at them (N, 5)."""
    times = [-2.0, -1.0, 0.0, 1.0, 2.0]
    return {"times": times, "measured": [list(one) for one in growth(sequences)]}


#: What one size more adds, and who makes it.
UNITS = {"hmm": (hmm, 100), "lda": (lda, 5), "gmm": (gmm, 100), "hlr": (hlr, 20)}


def write(folder: Path) -> Path:
    """Write the chain as JSON into `folder` and return its path."""
    return write_sized(folder, "hmm", 1)


def write_sized(folder: Path, program: str, size: int) -> Path:
    """Write a program's data of a size as JSON into `folder` and return its path."""
    make, unit = UNITS[program]
    return save(folder / f"{program}-{size}.json", make(unit * size))


def save(path: Path, found: dict) -> Path:
    """Write JSON, making its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(found))
    return path
