"""A release has the same name, version and requirements everywhere, and its workflows run pinned actions."""

import re
import tomllib
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


def pinned(package: str) -> str:
    """The version in the locks."""
    (version,) = re.findall(rf"^{package}==([\w.]+)", (ROOT / "requirements" / "build.txt").read_text(), re.M)
    return version


def test_one_version_stands_everywhere():
    cargo = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]
    citation = (ROOT / "CITATION.cff").read_text()
    assert PROJECT["version"] == cargo["version"] == metadata.version("niwaki")
    assert f"\nversion: {PROJECT['version']}\n" in citation
    changes = (ROOT / "CHANGELOG.md").read_text()
    assert re.search(rf"^## \[{PROJECT['version']}\]", changes, re.M) or "\n## [Unreleased]\n" in changes


def test_the_licences_are_named_and_are_there():
    cargo = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]
    assert PROJECT["license"] == cargo["license"] == "MIT OR Apache-2.0"
    assert all((ROOT / name).is_file() for name in PROJECT["license-files"])
    assert re.findall(r"^  - (MIT|Apache-2.0)$", (ROOT / "CITATION.cff").read_text(), re.M) == PROJECT[
        "license"
    ].split(" OR ")


def test_every_crate_of_the_lock_that_is_in_the_engine_has_its_licence_in_the_wheel():
    # `make lint` compares the whole file; here the versions, so that a new lock alone is found.
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text())["package"]
    versions = {f"{crate['name']} {crate['version']}" for crate in lock}
    texts = (ROOT / "THIRD-PARTY").read_text()
    listed = set(re.findall(r"^  ([\w-]+ [\w.+-]+): ", texts, re.M))
    assert len(listed) > 50 and listed <= versions
    assert {name.split()[0] for name in listed} >= {
        "pyo3",
        "rayon",
        "cranelift-jit",
        "mimalloc",
        "libmimalloc-sys",
    }


def test_what_the_package_needs_can_be_had_on_the_pythons_that_it_names():
    named = [
        classifier.rpartition(" ")[2]
        for classifier in PROJECT["classifiers"]
        if re.search(r":: 3\.\d+$", classifier)
    ]
    supported = SpecifierSet(PROJECT["requires-python"])
    assert "3.11" in named and all(supported.contains(version) for version in named)
    for text in PROJECT["dependencies"]:
        assert Requirement(text).specifier, f"{text} has no least version"


@pytest.mark.parametrize("workflow", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_is_pinned_and_says_whether_it_has_run(workflow: Path):
    text = workflow.read_text()
    assert "THIS WORKFLOW HAS NOT RUN" in text
    assert "permissions:\n  contents: read\n" in text
    used = re.findall(r"uses: (\S+)(.*)", text)
    assert used
    for action, comment in used:
        assert re.fullmatch(r"[\w-]+/[\w-]+@[0-9a-f]{40}", action), action
        assert re.fullmatch(r" # v\d+\.\d+\.\d+", comment), action
    assert all(f"v{pinned('maturin')}" == version for version in re.findall(r"maturin-version: (\S+)", text))


def test_an_action_has_one_pin():
    pins: dict[str, set[str]] = {}
    for workflow in WORKFLOWS:
        for action, pin in re.findall(r"uses: (\S+?)@(\S+)", workflow.read_text()):
            pins.setdefault(action, set()).add(pin)
    assert len(pins) >= 4 and all(len(versions) == 1 for versions in pins.values())


@pytest.mark.parametrize(
    ("expression", "enough"),
    [
        ("MIT", [{"MIT"}]),
        ("MIT/Apache-2.0", [{"MIT"}, {"Apache-2.0"}]),
        ("(MIT OR Apache-2.0) AND Unicode-3.0", [{"MIT", "Unicode-3.0"}, {"Apache-2.0", "Unicode-3.0"}]),
        ("Apache-2.0 WITH LLVM-exception", [{"Apache-2.0 WITH LLVM-exception"}]),
        ("GPL-3.0 AND MIT OR Zlib", [{"GPL-3.0", "MIT"}, {"Zlib"}]),
    ],
)
def test_expressions_of_licences_are_read(expression: str, enough: list[set[str]]):
    from licences import choices

    assert choices(expression) == enough
