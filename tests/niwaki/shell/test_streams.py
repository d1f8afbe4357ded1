"""Claim: where a command cannot write, to stdout or to its folder, there is a message and no traceback.

Each command of the shell is tried, one after the other in a process of their own.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import pytest
import typer
from niwaki import shell
from niwaki.errors import FileError
from niwaki.shell.main import app
from typer.testing import CliRunner

pytestmark = [
    pytest.mark.skipif(os.name == "nt", reason="devices of Unix"),
    pytest.mark.filterwarnings("ignore::niwaki.search.warnings.SearchWarning"),
]

MODEL = """
from niwaki import box, emit, model, uniform

@model
def tower():
    emit(box((0, 0, 0), (uniform(0.5, 1.5), 1, 1)))
"""
SLAB = """
from niwaki import Uniform, box

def slab(width=Uniform(0.5, 1.5)):
    return box((0, 0, 0), (width, 1, 1))
"""
ROOM = """
from niwaki import box

parts = {"bed": box((0.0, 0.3, 0.0), (1, 0.6, 2)), "desk": box((0.9, 0.4, 0.0), (1, 0.8, 0.6))}
"""
BATCH = 'model = "garden.py:tower"\nseeds = 2\n[grow]\ntarget = "gallery:ship"\nparticles = 5\nvoxel = 1.0\n'

#: For each command, and each of its groups, words with which it is done soon. `{}` is the folder that is read from.
COMMANDS = {
    "models": "models",
    "show": "show {}/garden.py:tower -n 1 --quick",
    "grow": "grow {}/garden.py:tower --target gallery:ship --particles 5 --voxel 1 --quick",
    "fit": "fit {}/slab.py:slab --target gallery:ship --voxel 1 --evaluations 4 --workers 1 --seed 1 --quick -o fitted",
    "repair": "repair {}/room.py --workers 0",
    "batch run": "batch {}/garden.toml --processes 1",
    "batch export": "batch export {}/batch --format csv,png,glb -o exported",
    "replay": "replay {}/grown/run.json --quick -o replayed",
    "check": "check {}/garden.py:tower",
    "sample": "sample {}/garden.py:tower --steps 50 --quick",
    "color": "color bug -n 1 --side 64",
    "letters": "letters I --particles 4 --searches 1 --width 64 --format png,svg",
    "guide train": "guide train vines --targets scribbles --searches 2 --no-mirror -o vines.guide",
    "guide show": "guide show {}/../lightning.guide",
    "studio": "studio --no-browser --session session --port 1",
    "explain": "explain {}/garden.py:tower --choice *",
    "doctor": "doctor",
    "init": "init begun",
    "mcp": "mcp {}",
}

#: Those that write no file.
QUIET = {"models", "check", "guide show", "doctor", "repair"}

#: Servers run until they are ended; what the studio does in a folder that it may not write to is tried alone.
TRIED = {name: words for name, words in COMMANDS.items() if name not in ("studio", "mcp")}

PROGRAM = """
import io, json, os, sys, traceback, warnings
from niwaki.shell import main as shell
mode, commands = sys.argv[1], json.loads(sys.argv[2])
found = {}
for name, words in commands.items():
    sys.argv = ["niwaki", *words]
    if mode == "full":
        sys.stdout = open("/dev/full", "w")
    elif mode == "closed":
        if sys.stdout is sys.__stdout__:
            os.close(1)
        else:
            sys.stdout.close()
        sys.stdout = None
    sys.stderr = io.StringIO()
    try:
        shell.main()
    except SystemExit as ended:
        found[name] = [ended.code, sys.stderr.getvalue()]
    except BaseException:
        found[name] = [None, traceback.format_exc()]
os.write(2, json.dumps(found).encode())
os._exit(0)
"""


@pytest.fixture(scope="module")
def there(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what the commands read."""
    place = tmp_path_factory.mktemp("there")
    (place / "garden.py").write_text(MODEL)
    (place / "slab.py").write_text(SLAB)
    (place / "room.py").write_text(ROOM)
    (place / "requirements.toml").write_text("collisions = false\n")
    (place / "garden.toml").write_text(BATCH)
    shipped = Path(shell.__file__).parents[1] / "guides" / "shipped" / "lightning.guide"
    (place.parent / "lightning.guide").write_bytes(shipped.read_bytes())
    for name, folder in (("grow", "grown"), ("batch run", "batch")):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            done = CliRunner().invoke(app, [*COMMANDS[name].format(place).split(), "-o", str(place / folder)])
        assert done.exit_code == 0, done.output
    return place


def run(mode: str, there: Path, folder: Path) -> dict[str, Any]:
    """The exit code and stderr of each command, by its name."""
    words = json.dumps({name: line.format(there).split() for name, line in TRIED.items()})
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM, mode, words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(folder for folder in sys.path if folder)},
        capture_output=True,
        timeout=300,
        check=True,
    )
    results: dict[str, Any] = json.loads(done.stderr[done.stderr.index(b"{") :])
    for name, (code, message) in results.items():
        assert "Traceback" not in message, (name, message)
        assert code is not None, (name, message)
    return results


def leaves() -> set[str]:
    """The names of all commands, and of those of a group."""
    group = typer.main.get_group(app)
    names = set()
    for name in shell.app.COMMANDS:
        command = group.get_command(None, name)
        names |= {f"{name} {child}" for child in getattr(command, "commands", {})} or {name}
    return names


def test_each_command_is_tried() -> None:
    assert set(COMMANDS) == leaves()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_full_stdout_has_a_message(there: Path, tmp_path: Path) -> None:
    for name, (code, message) in run("full", there, tmp_path).items():
        assert code == 2 and "No space left on device" in message, (name, code, message)
    # What is written before anything is said is whole.
    assert json.loads((tmp_path / "out" / "run.json").read_text())["runs"]
    assert not list(tmp_path.rglob(".niwaki*"))


def test_a_closed_stdout_is_no_error(there: Path, tmp_path: Path) -> None:
    for name, (code, message) in run("closed", there, tmp_path).items():
        assert code == 0, (name, code, message)
    assert (tmp_path / "show.png").exists() and (tmp_path / "garden").is_dir()


def read_only(tmp_path: Path) -> Path:
    """A folder in which no file can be made, also by root."""
    place = tmp_path / "locked"
    place.mkdir(mode=0o555)
    return Path("/proc") if os.access(place, os.W_OK) else place


def test_a_read_only_folder_has_a_message(there: Path, tmp_path: Path) -> None:
    for name, (code, message) in run("", there, read_only(tmp_path)).items():
        assert code == (0 if name in QUIET else 2), (name, code, message)
        assert name in QUIET or "error[file-unwritable]" in message, (name, message)


def test_the_studio_in_a_read_only_folder_has_a_message(tmp_path: Path) -> None:
    pytest.importorskip("niwaki.studio.serving")
    words = [sys.executable, "-m", "niwaki.shell.main", *COMMANDS["studio"].split()]
    done = subprocess.run(words, cwd=read_only(tmp_path), capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and "Traceback" not in done.stderr and "error[" in done.stderr, done.stderr


@pytest.mark.parametrize("name", ["show", "explain", "grow", "guide train", "batch run", "color"])
def test_a_name_that_no_file_can_have_has_a_message(name: str, there: Path, tmp_path: Path) -> None:
    suffix = {"show": ".png", "explain": ".svg"}.get(name, "")
    words = [word for word in COMMANDS[name].format(there).split() if word not in ("-o", "vines.guide")]
    done = CliRunner().invoke(app, [*words, "-o", str(tmp_path / ("x" * 300 + suffix))])
    assert isinstance(done.exception, FileError), (name, done.exception)
    assert done.exception.code in ("file-unwritable", "file-unreadable") and "too long" in str(done.exception)
