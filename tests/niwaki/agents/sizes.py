"""Sizes and times of all answers of the recorded sessions, by tool.

python tests/niwaki/agents/sizes.py            print the table of sizes, and times beside it
python tests/niwaki/agents/sizes.py --write    write the table of sizes into docs/pictures/agent-sizes.txt
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path

from agent import Agent, agent
from niwaki.agents.tools import tools
from test_sessions import SESSIONS, replay

# Searches are as short as in the tests.
os.environ.setdefault("NIWAKI_ROUNDS", "15")

TABLE = Path(__file__).parents[3] / "docs" / "pictures" / "agent-sizes.txt"


class Timed(Agent):
    """A client that notes the time of each answer."""

    times: dict[str, list[float]]

    def once(self, tool: str, **arguments: object):
        """Send one call, and note its time."""
        start = time.perf_counter()
        reply = super().once(tool, **arguments)
        self.times[tool].append(time.perf_counter() - start)
        return reply


def main() -> None:
    """Run all sessions, and print or write the table."""
    with tempfile.TemporaryDirectory() as place, agent(Path(place)) as client:
        timed = Timed(client.runner, client.caller, client.folder)
        timed.times = defaultdict(list)
        for number, session in enumerate(SESSIONS):
            replay(timed, session, f"session-{number}")
    rows = ["| tool | largest text, bytes | largest picture, bytes |", "| --- | --- | --- |"]
    for tool in sorted({name for name, _, _ in timed.sizes} & {tool.name for tool in tools()}):
        sizes = [size for name, *size in timed.sizes if name == tool]
        text, picture = (max(column) for column in zip(*sizes, strict=True))
        rows.append(f"| `{tool}` | {text:,} | {f'{picture:,}' if picture else ''} |")
        times = sorted(timed.times[tool]) or [0.0]
        print(f"{tool:<12} median {times[len(times) // 2]:6.3f} s, longest {times[-1]:6.3f} s")
    table = "\n".join(rows) + "\n"
    print(table)
    if "--write" in sys.argv:
        TABLE.write_text(table)


if __name__ == "__main__":
    main()
