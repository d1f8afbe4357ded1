"""The peers: WebPPL's two kinds of Metropolis-Hastings, and the chains written by hand."""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from data import write_sized
from machine import CACHE, HERE, prepare_limit, prepare_webppl

METHODS = ("MH", "incrementalMH")


@dataclass(frozen=True)
class Peers:
    """Where they are."""

    webppl: Path
    limit: Path

    @classmethod
    def prepared(cls) -> "Peers":
        """Install WebPPL from npm at the version that its lock file pins, and build the limit."""
        return cls(prepare_webppl(), prepare_limit())

    def rate_of_webppl(
        self, program: str, size: int, method: str, seconds: float, seed: int
    ) -> dict[str, Any]:
        """Proposals, CPU seconds and the rate of the first thousand; at least a thousand proposals."""
        path = write_sized(CACHE / "data", program, size)
        script = HERE / "webppl" / "chains.js"
        return read("node", script, self.webppl, program, path, method, seconds, seed)

    def of_limit(self, kind: str, program: str, data: Path, seconds: float, seed: int) -> dict[str, Any]:
        """`what` is `rate`, `globals` (global choices alone) or `check`."""
        return read(self.limit, kind, program, data, seconds, seed)


def read(*command: object) -> dict[str, Any]:
    """The JSON line that a command prints."""
    words = [str(word) for word in command]
    return json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
