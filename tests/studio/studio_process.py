"""A studio in another process, as a user starts it, on a free port of loopback."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PILE = '''"""A pile."""

from niwaki import box, emit, gaussian, model, uniform


@model
def pile(height: float = 3.0, count: int = 4):
    """A pile of boxes."""
    for i in range(count):
        storey(i * height / count, height / count)


def storey(y, h):
    w = uniform(0.5, 2.0)
    emit(box((gaussian(0.0, 0.1), y + h / 2, 0.0), (w, h, w)))
'''


class Served:
    """A studio's process."""

    def __init__(self, folder: Path, *models: Path) -> None:
        self.folder = folder
        command = [sys.executable, "-m", "niwaki.shell.main", "studio", *map(str, models)]
        self.process = subprocess.Popen(
            [*command, "--session", str(folder), "--no-browser"], stdout=subprocess.PIPE, text=True
        )
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        match = re.search(r"http://127\.0\.0\.1:(\d+)/open\?token=(\S+)", line)
        assert match is not None, line
        self.port, self.token = int(match[1]), match[2]
        self.url, self.key = (folder / "key").read_text().split()
        os.set_blocking(self.process.stdout.fileno(), False)

    def link(self) -> str:
        """Return an unused token."""
        token, self.token = self.token or self.next_token(), ""
        return token

    def next_token(self) -> str:
        """Wait for the token that the studio prints after a use."""
        assert self.process.stdout is not None
        for _ in range(1200):
            line = self.process.stdout.readline()
            if "token=" in line:
                return line.split("token=")[1].strip()
            time.sleep(0.05)
        raise AssertionError("no other token was printed")

    def kill(self) -> None:
        """Kill the process, as `kill -9` does."""
        self.process.kill()
        self.process.wait()

    def end(self) -> None:
        """Stop the process, as Ctrl-C does."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.kill()
        if self.process.stdout is not None:
            self.process.stdout.close()


@contextmanager
def serving(folder: Path, *models: Path) -> Iterator[Served]:
    """Serve a studio, and stop it at the end."""
    served = Served(folder, *models)
    try:
        yield served
    finally:
        served.end()


def fetch(served: Served, path: str, body: bytes | None = None) -> bytes:
    """Send a request with the studio's key; return the answer."""
    request = urllib.request.Request(served.url + path, body, {"Authorization": f"Bearer {served.key}"})
    with urllib.request.urlopen(request, timeout=60) as answer:
        return answer.read()
