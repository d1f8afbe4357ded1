"""Rules of the repository: tracked files are small, have a purpose, and name no machine."""

import ast
import re
import subprocess
import sys
import tomllib
from functools import cache
from pathlib import Path

import checkout
import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parents[2]
PICTURES = {".png", ".jpg", ".jpeg", ".gif", ".svg", ".webp"}
PICTURE_LIMIT = 300_000  # bytes: a page of the manual still loads at once
TOTAL_LIMIT = 10_000_000  # bytes: a clone takes seconds

# Cut in two, so that this page does not find itself.
FORBIDDEN = [
    "/" + "home/",
    "/" + "root/",
    "/" + "work/",
    "/" + "Users/",
    "../" + "shared",
    "pypi" + ".org",
    "python" + "hosted",
    "npm" + "js.",
    "npm" + "js.org",
    "static." + "crates",
    "--index" + "-url",
    "--find" + "-links",
]
# Cargo's name for its standard index is part of the format of every lock file, whichever mirror served it.
CARGO_INDEX = "registry+https://github.com/rust-lang/" + "crates.io-index"


@cache
def tracked() -> list[Path]:
    """Files of the checkout; without git the test is skipped."""
    files = checkout.tracked()
    if not files:
        pytest.skip("not a git checkout")
    return files


def texts() -> list[tuple[str, str]]:
    """Path and text of each tracked file that is a text."""
    files = []
    for path in tracked():
        try:
            files.append((path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")))
        except UnicodeDecodeError:
            continue
    return files


def test_no_file_names_a_machine_or_the_host_of_a_registry():
    lines = [
        f"{name}: {word}"
        for name, text in texts()
        for word in FORBIDDEN
        if word in text.replace(CARGO_INDEX, "")
    ]
    assert not lines


def test_no_file_refers_to_sources_that_readers_lack():
    pattern = re.compile(r"\b(issue|ticket|pull request|PR) #?\d+", re.I)
    assert not [f"{name}: {match[0]}" for name, text in texts() for match in pattern.finditer(text)]


def test_import_loads_nothing_that_is_not_always_needed():
    heavy = ["trimesh", "PIL", "typer", "rich", "matplotlib", "scipy"]
    # Not even when every public name is used.
    program = "import sys, niwaki; [getattr(niwaki, name) for name in niwaki.__all__]; "
    program += f"print([name for name in {heavy} if name in sys.modules])"
    shown = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True).stdout
    assert shown.strip() == "[]"


def test_locks_pin_every_requirement_with_a_hash():
    locks = sorted((ROOT / "requirements").glob("*.txt"))
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    unlocked = {"arviz", "color", "notebook", "parquet", "print", "stacks"}
    assert {lock.stem for lock in locks} == set(extras) - unlocked | {"core"}
    for lock in locks:
        entries = re.split(r"\n(?=\S)", lock.read_text().strip())
        assert all("==" in entry and "--hash=sha256:" in entry for entry in entries), lock.name


@pytest.mark.parametrize("python", ["3.11", "3.12", "3.13", "3.14"])
def test_locks_agree_with_one_another(python: str):
    # They are installed side by side; one may need a package only where another Python makes others unnecessary.
    machine = {"python_version": python, "python_full_version": f"{python}.0"}
    pins: dict[str, set[str]] = {}
    for lock in (ROOT / "requirements").glob("*.txt"):
        for line in re.findall(r"^[\w.-]+==.+?(?= *\\?$)", lock.read_text(), re.M):
            requirement = Requirement(line)
            if requirement.marker is None or requirement.marker.evaluate(machine):
                pins.setdefault(requirement.name, set()).add(str(requirement.specifier))
    assert len(pins) > 50
    assert {name: versions for name, versions in pins.items() if len(versions) > 1} == {}


def test_pictures_are_small_and_so_are_all_together():
    pictures = [path for path in tracked() if path.suffix in PICTURES]
    assert not [path.name for path in pictures if path.stat().st_size > PICTURE_LIMIT]
    assert sum(path.stat().st_size for path in pictures) < TOTAL_LIMIT


def test_every_rust_file_opens_with_what_it_is_for():
    sources = [path for path in tracked() if path.suffix == ".rs"]
    assert sources
    bare = [path for path in sources if not path.read_text().lstrip().startswith("//!")]
    assert not [path.relative_to(ROOT).as_posix() for path in bare]


def test_every_python_file_opens_with_what_it_is_for():
    sources = [path for path in tracked() if path.suffix == ".py"]
    assert sources
    bare = [path for path in sources if not re.match(r'(#.*\n|\s)*[rR]?"""', path.read_text())]
    assert not [path.relative_to(ROOT).as_posix() for path in bare]


#: Imports inside functions: `resource` is not on every system.
OPTIONAL = {("errors/memory.py", "resource")}
#: Who imports modules by a name of their own: a look at parts that may be broken, extras, the gallery's folder, the
#: shell's commands, the host functions of a search that was read, a generator in a worker process.
BY_NAME = {
    "checkup/inspection.py",
    "errors/extras.py",
    "fitting/functions.py",
    "fitting/in_blender/serve.py",
    "fitting/loading.py",
    "fitting/openscad.py",
    "gallery/__init__.py",
    "inputs/child.py",
    "search/data.py",
    "shell/app.py",
}


def test_no_function_imports_but_what_is_optional():
    package = ROOT / "python" / "niwaki"
    imports = {
        (path.relative_to(package).as_posix(), name)
        for path in package.rglob("*.py")
        for function in ast.walk(ast.parse(path.read_text()))
        if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef))
        for node in ast.walk(function)
        if isinstance(node, (ast.Import, ast.ImportFrom))
        for name in (
            [node.module] if isinstance(node, ast.ImportFrom) else [alias.name for alias in node.names]
        )
    }
    assert imports == OPTIONAL
    by_name = {
        path.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if re.search(r"import_module|__import__", path.read_text())
    }
    assert by_name == BY_NAME


def test_help_names_only_what_there_is():
    import niwaki

    listed = re.findall(r"^    (\w+(?:, \w+)*)(?:, \.\.\.)?  ", niwaki.__doc__, re.M)
    names = {name for line in listed for name in line.split(", ")}
    assert len(names) == 26
    assert names <= set(niwaki.__all__)
    used = set(re.findall(r"\b(?:nw|niwaki)\.(\w+)", niwaki.__doc__))
    assert used and used <= set(niwaki.__all__)
    assert len(niwaki.__doc__.splitlines()) <= 36


def test_crates_import_only_the_rooms_above_them():
    crates = ["math", "geom", "render", "native", "vm", "grad", "guide", "continuous", "fit", "run"]
    crates += ["propose", "chain", "agreement", "particles", "search", "py"]
    assert set(crates) == {manifest.parent.name for manifest in (ROOT / "crates").glob("*/Cargo.toml")}
    for place, crate in enumerate(crates):
        manifest = tomllib.loads((ROOT / "crates" / crate / "Cargo.toml").read_text())
        used = {
            name.removeprefix("niwaki-") for name in manifest["dependencies"] if name.startswith("niwaki-")
        }
        assert used <= set(crates[:place]), crate
        assert crate == "py" or "pyo3" not in manifest["dependencies"], crate


def pages() -> list[Path]:
    """The pages for readers."""
    return [
        *(
            ROOT / f"{name}.md"
            for name in ("README", "ARCHITECTURE", "CHANGELOG", "CONTRIBUTING", "SECURITY")
        ),
        *sorted(page for page in (ROOT / "docs").rglob("*.md") if ROOT / "docs" / "made" not in page.parents),
    ]


def test_the_pages_name_only_commands_that_exist():
    targets = set(re.findall(r"^([a-z0-9-]+):", (ROOT / "Makefile").read_text(), re.M))
    named = {
        word
        for page in pages()
        for word in re.findall(r"(?:^    |`)make ([a-z0-9-]+)", page.read_text(), re.M)
    }
    assert {"demo", "test"} <= named <= targets


def test_the_pages_link_to_files_that_exist():
    for page in pages():
        for link in re.findall(r"\]\(([^)#:]+)\)", page.read_text()):
            # What is below `made` is made when the manual is built; Sphinx refuses what is missing there.
            if not link.startswith("../made/"):
                assert (page.parent / link).exists(), f"{page.relative_to(ROOT)}: {link}"


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.stem)
def test_the_programs_on_a_page_are_python(page: Path):
    for program in re.findall(r"^```python\n(.*?)^```", page.read_text(), re.M | re.S):
        ast.parse(program)


def test_the_files_that_contributing_names_exist():
    named = re.findall(r"`([\w.-]+/[\w./-]+|[A-Z][\w-]+\.\w+)`", (ROOT / "CONTRIBUTING.md").read_text())
    assert len(named) > 30
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_what_is_promised_is_tested():
    text = (ROOT / "docs" / "guide" / "promises.md").read_text()
    rows = [
        line
        for line in text.splitlines()
        if line.startswith("| ") and not line.startswith(("| promise", "| ---"))
    ]
    assert len(rows) > 15
    for row in rows:
        named = re.findall(r"`((?:tests|crates|fuzz)/[\w/.-]+)::(\w+)`", row)
        assert named, f"this promise names no test: {row}"
        for place, test in named:
            source = ROOT / place
            assert source.is_file(), f"there is no {place}"
            assert re.search(rf"\b(?:def|fn) {test}\b", source.read_text()), f"{place} has no test `{test}`"
