"""The Pythons of this machine, and empty environments of them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
#: What an environment has beside its own programs: no compiler, no cargo, no package of this folder.
BARE = {"PYTHONNOUSERSITE": "1", "PYTHONSAFEPATH": "1", "RAYON_NUM_THREADS": "2"}


def pythons() -> dict[str, str]:
    """A path for each version from 3.11 on: `NIWAKI_PYTHONS`, or those on the path, of pyenv, and this one."""
    named = os.environ.get("NIWAKI_PYTHONS", "").split()
    home = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
    places = named or [
        *filter(None, (shutil.which(f"python3.{minor}") for minor in range(11, 30))),
        *map(str, sorted(home.glob("versions/3.*/bin/python"))),
        sys.executable,
    ]
    versions: dict[str, str] = {}
    program = "import sys, venv, ensurepip; print(*sys.version_info[:2], sep='.')"
    for place in places:
        version = subprocess.run([place, "-Ic", program], capture_output=True, text=True).stdout.strip()
        if version and tuple(map(int, version.split("."))) >= (3, 11):
            versions.setdefault(version, place)
    return versions


class Environment:
    """An empty environment of a Python, in a folder."""

    def __init__(self, python: str, folder: Path) -> None:
        self.folder = folder
        self.programs = folder / "env" / ("Scripts" if os.name == "nt" else "bin")
        subprocess.run([python, "-m", "venv", folder / "env"], check=True)
        system = {name: os.environ[name] for name in ("SYSTEMROOT", "TEMP") if name in os.environ}
        self.variables = {**system, **BARE, "PATH": str(self.programs), "HOME": str(folder)}

    def install(self, *arguments: str | Path) -> None:
        """Install by pip. It has the settings of whoever runs the tests, and no toolchain on its path."""
        pip = [self.programs / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        environment = {**os.environ, "PATH": str(self.programs)}
        subprocess.run([*pip, *arguments], check=True, env=environment, cwd=self.folder)

    def run(self, *command: str) -> str:
        """Return the output of a program of the environment; it must succeed."""
        ended = subprocess.run(
            [self.programs / command[0], *command[1:]],
            env=self.variables,
            cwd=self.folder,
            capture_output=True,
            text=True,
        )
        assert ended.returncode == 0, ended.stdout + ended.stderr
        return ended.stdout
