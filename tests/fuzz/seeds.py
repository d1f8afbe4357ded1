"""First inputs of the fuzzers: for core text what the gallery, the specification and random programs compile to; for
the others some bytes.

    python tests/fuzz/seeds.py

They go to `fuzz/corpus`, which git ignores; `fuzzers.py --corpora` packs those that reach something of their own.
"""

from __future__ import annotations

import hashlib
import random
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / part) for part in ("fuzz", "agreement", "language")]

from fuzzers import engine_targets  # noqa: E402

#: Longer texts are left out: small ones reach as much, faster.
LONGEST = 4000
#: Random programs of each kind.
PROGRAMS = 60
#: Inputs of random bytes.
BYTES = 40


def texts() -> list[str]:
    """Core text, with its constants and without places in sources."""
    import chain_programs
    import programs
    from niwaki.lang.core import Form, constant_form, write_tree
    from sources import originals
    from test_engine import load

    programs_of_seeds = [
        kind.program(seed).text for kind in (programs, chain_programs) for seed in range(PROGRAMS)
    ]
    pages = []
    for source in originals() + programs_of_seeds:
        try:
            core = load(source).core()
        except Exception:  # Not every source is a model by itself.
            continue
        written = [(number, constant_form(value)) for number, value in enumerate(core.constants)]
        constants = [Form("const", [str(number), form]) for number, form in written if form is not None]
        pages.append(write_tree(Form("module", [*constants, *core.form.args]), 0, False, True) + "\n")
    return [text for text in pages if len(text) <= LONGEST]


def write(target: str, inputs: list[bytes]) -> None:
    """Into the target's corpus."""
    folder = ROOT / "fuzz" / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    for content in inputs:
        (folder / hashlib.sha256(content).hexdigest()[:16]).write_bytes(content)
    print(f"{target}: {len(inputs)} inputs")


if __name__ == "__main__":
    seeds = [text.encode() for text in texts()]
    write("core_text", seeds)
    write("programs", [bytes(4) + text for text in seeds])
    for target in engine_targets():
        if target not in ("core_text", "programs"):
            dice = random.Random(target)
            write(target, [dice.randbytes(dice.randrange(20, 600)) for _ in range(BYTES)])
