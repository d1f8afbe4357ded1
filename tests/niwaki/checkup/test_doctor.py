"""`niwaki doctor` reports versions, the core and missing extras; a core that does not work ends it with 1."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from importlib import metadata

import niwaki as nw
import pytest
from niwaki.checkup import inspection
from niwaki.errors.extras import EXTRAS, install

PROGRAM = """
import sys
{breaking}
from niwaki.shell.main import main
sys.argv = ["niwaki", "doctor", *{arguments!r}]
main()
"""


def doctor(*arguments: str, breaking: str = "", **environment: str) -> tuple[int, str]:
    """Return the status and the output of the command in a process of its own."""
    command = [sys.executable, "-c", PROGRAM.format(breaking=breaking, arguments=list(arguments))]
    process = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **environment})
    assert process.stderr == ""
    return process.returncode, process.stdout


def test_the_core_works_and_json_says_the_same() -> None:
    status, text = doctor("--json", RAYON_NUM_THREADS="3")
    report = json.loads(text)
    assert status == 0 and report["works"] and not any(trial["error"] for trial in report["core"])
    assert report["versions"]["numpy"] == metadata.version("numpy")
    assert report["versions"]["engine"].startswith(f"{nw.__version__}, ")
    assert report["machine"]["threads"] == 3
    assert re.fullmatch("[0-9a-f]{32}", report["machine"]["bits"])
    assert [extra["name"] for extra in report["extras"]] == list(EXTRAS)


@pytest.mark.parametrize(
    ("breaking", "words"),
    [
        ("sys.modules['niwaki._engine'] = None", "fails  the engine loads: "),
        (
            "sys.modules['PIL'] = None",
            "fails  a scene grows into a target; its picture and its mesh are written: ",
        ),
        (
            "import niwaki._engine as e; e.__version__ = '0'",
            "the engine has version 0, the package has version ",
        ),
    ],
    ids=["engine", "pillow", "version"],
)
def test_what_does_not_work_is_named_and_ends_with_1(breaking: str, words: str) -> None:
    status, text = doctor(breaking=breaking)
    assert status == 1
    assert words in text and "Core: does not work" in text and "Traceback" not in text


def test_a_missing_extra_is_told_with_what_it_is_for_and_its_command(monkeypatch: pytest.MonkeyPatch) -> None:
    here = {"numpy": "2.0", "starlette": "1.0", "uvicorn": "0.39.9", "watchfiles": "1.1.1", "ezdxf": "1.3"}
    monkeypatch.setattr(inspection, "_version", here.get)
    extras = {extra.name: extra for extra in nw.doctor().extras}
    assert extras["studio"].missing == ("uvicorn>=0.40, not 0.39.9", "websockets")
    assert extras["print"].missing == ("manifold3d",)
    assert "ezdxf" not in extras["stacks"].missing
    text = str(nw.doctor())
    for name, purpose in EXTRAS.items():
        assert purpose in text and install(name) in text


def test_versions_are_compared_by_their_numbers() -> None:
    ordered = ["0.9", "1", "1.0.1rc1", "1.10", "2.17.7.post6"]
    assert [inspection._numbers(version) for version in ordered] == sorted(map(inspection._numbers, ordered))
    assert inspection._numbers("1.0") == inspection._numbers("1") > inspection._numbers("0.30.2")
