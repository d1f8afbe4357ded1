"""Structures of blocks: draws of each kind, the share that balances and the share that stands; none is left out.

    python benches/stacks.py [--draws 200] [--chains 4] [--out out/stacks] [KIND ...]
    python benches/stacks.py --sampler mh-original --chains 1 stack lean top_heavy
    python benches/stacks.py --sampler explore --chains 1 --draws 64 stack lean top_heavy
    python benches/stacks.py --table                        # the table of all files

Each chain starts from its own balance and warms up; every draw after that is judged by the linear program and by
MuJoCo. Everything is kept in the folder as it comes, and a stopped run continues where it was. The parts are in
`stacking`. Needs the extra `stacks`.
"""

from __future__ import annotations

import argparse
from functools import partial
from pathlib import Path

from stacking import exploring, following, metropolis
from stacking.files import chain_file
from stacking.judging import judge
from stacking.kinds import KINDS
from stacking.table import HEAD, line, summary, table

FOLLOWING = "nuts"
SAMPLERS = {FOLLOWING: following.draw, "explore": exploring.draw, **metropolis.SAMPLERS}


def measure(
    name: str, sampler: str, folder: Path, draws: int, chains: range, warmup: int | None = None
) -> None:
    """Draw and judge what is not there yet: `draws` of one kind in each chain."""
    kind = KINDS[name]
    folder.mkdir(parents=True, exist_ok=True)
    sample = SAMPLERS[sampler] if warmup is None else partial(SAMPLERS[sampler], warmup=warmup)
    for chain in chains:
        path = chain_file(folder, name, sampler, chain)
        if not path.exists():
            sample(kind, chain, draws).save(path)
        judge(kind, sampler, folder, polish=sampler == FOLLOWING)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("--draws", type=int, default=200)
    parser.add_argument("--chains", type=int, default=4)
    parser.add_argument("--sampler", choices=list(SAMPLERS), default=FOLLOWING)
    parser.add_argument("--out", type=Path, default=Path("out/stacks"))
    parser.add_argument("--table", action="store_true", help="print the table of all files, and stop")
    args = parser.parse_args()
    if args.table:
        print(table(args.out, tuple(SAMPLERS)))
        return
    print("\n".join(HEAD), flush=True)
    # All kinds grow together, a chain at a time: the table is of use at any moment.
    for chain in range(args.chains):
        for name in args.kinds or KINDS:
            measure(name, args.sampler, args.out, -(-args.draws // args.chains), range(chain, chain + 1))
            row = summary(KINDS[name], args.sampler, args.out)
            print(line(row) if row else f"{name}: nothing", flush=True)


if __name__ == "__main__":
    main()
