"""The wheel and the sdist hold what they should: every file of the package, the licences, and nothing else."""

from __future__ import annotations

import re
import subprocess
import tarfile
import zipfile
from email.parser import Parser
from pathlib import Path, PurePosixPath

from environments import ROOT

LICENCES = {"LICENSE-APACHE", "LICENSE-MIT", "NOTICE", "THIRD-PARTY"}


def tracked(*places: str) -> set[str]:
    listed = subprocess.run(
        ["git", "ls-files", *places], cwd=ROOT, check=True, capture_output=True, text=True
    )
    return set(listed.stdout.splitlines())


def test_the_wheel_has_each_file_of_the_package_and_no_other(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.endswith("/")}
    about = {name for name in names if ".dist-info/" in name}
    engine = {name for name in names if re.fullmatch(r"niwaki/_engine\.(abi3\.so|pyd)", name)}
    package = {name.removeprefix("python/") for name in tracked("python/niwaki")}
    assert len(engine) == 1
    assert names - about - engine == package
    assert {PurePosixPath(name).name for name in about if "/licenses/" in name} >= LICENCES
    assert not [name for name in names if re.search(r"(^|/)(tests?|target|benches)/|(^|/)test_", name)]


def test_the_wheel_is_for_every_python_from_3_11_on(wheel: Path) -> None:
    assert re.fullmatch(r"niwaki-[\d.]+-cp311-abi3-\w+\.whl", wheel.name)
    with zipfile.ZipFile(wheel) as archive:
        (place,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        about = Parser().parsestr(archive.read(place).decode())
        entries = archive.read(place.replace("METADATA", "entry_points.txt")).decode()
    assert about["Requires-Python"] == ">=3.11"
    assert about["License-Expression"] == "MIT OR Apache-2.0"
    assert "niwaki=niwaki.shell.main:main" in entries.replace(" ", "")
    assert wheel.stat().st_size < 20_000_000


def test_the_sdist_has_what_a_build_needs_and_no_other(sdist: Path) -> None:
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    sources = {
        name for name in tracked("crates", "python") if not re.match(r"crates/\w+/(tests|examples)/", name)
    }
    beside = {"Cargo.lock", "Cargo.toml", "README.md", "pyproject.toml", *LICENCES}
    assert names == sources | beside | {"PKG-INFO"}
