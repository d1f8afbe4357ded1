"""The licences of all packages that the project uses: whether they are allowed, and the texts that a wheel must carry.

`deny.toml` lists the licences that a package may have. Crates are those of `Cargo.lock`, of every platform; packages
of Python are those of requirements/*.txt that are installed here.

    python tests/house/licences.py          what is not allowed, or not in THIRD-PARTY; `make lint` runs it
    python tests/house/licences.py --write  write THIRD-PARTY again
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tomllib
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
TEXTS = ROOT / "THIRD-PARTY"

#: Which licence is taken where an author offers several.
PREFERRED = ["MIT", "BSD-2-Clause", "Zlib", "Unicode-3.0", "Apache-2.0 WITH LLVM-exception", "Apache-2.0"]
#: The platforms that wheels are built for (.github/workflows/wheels.yml).
PLATFORMS = [
    "x86_64-unknown-linux-gnu",
    "aarch64-unknown-linux-gnu",
    "x86_64-apple-darwin",
    "aarch64-apple-darwin",
    "x86_64-pc-windows-msvc",
]
#: Also allowed for packages of Python, which are installed beside ours and are no part of it.
BESIDE = {"0BSD", "CC0-1.0", "MIT-CMU", "MPL-2.0", "PSF-2.0"}
#: Packages whose metadata names no licence: what their licence file says.
UNNAMED = {"resvg-py": "MIT"}
#: What authors write where there is no SPDX expression. Docutils: each of its files has one of these.
NAMES = {
    "Apache 2.0": "Apache-2.0",
    "Apache Software License": "Apache-2.0",
    "BSD License": "BSD-3-Clause",
    "BSD License; GNU General Public License (GPL); Public Domain": "BSD-3-Clause",
    "ISC License (ISCL)": "ISC",
    "MIT License": "MIT",
    "Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
    "Python Software Foundation License": "PSF-2.0",
}


def allowed() -> set[str]:
    """The licences that may come with a wheel."""
    return set(tomllib.loads((ROOT / "deny.toml").read_text())["licenses"]["allow"])


def choices(expression: str) -> list[set[str]]:
    """The sets of licences of which one set is enough, of an SPDX expression; `A/B` is an old way to write `A OR B`."""
    words = re.findall(r"\(|\)|[^\s()]+", expression.replace("/", " OR "))

    def either() -> list[set[str]]:
        options = both()
        while words and words[0] == "OR":
            words.pop(0)
            options += both()
        return options

    def both() -> list[set[str]]:
        options = term()
        while words and words[0] == "AND":
            words.pop(0)
            options = [left | right for right in term() for left in options]
        return options

    def term() -> list[set[str]]:
        word = words.pop(0)
        if word == "(":
            options_inside = either()
            words.pop(0)
            return options_inside
        if words and words[0] == "WITH":
            words.pop(0)
            word = f"{word} WITH {words.pop(0)}"
        return [{word}]

    return either()


@dataclass(frozen=True)
class Crate:
    """A crate from elsewhere."""

    name: str
    version: str
    licence: str
    folder: Path
    source: str
    shipped: bool

    def licences(self) -> set[str]:
        """Return the licences under which Niwaki uses the crate."""
        order = {name: place for place, name in enumerate(PREFERRED)}
        return min(choices(self.licence), key=lambda names: max(order.get(name, 99) for name in names))

    def texts(self) -> list[str]:
        """Return the crate's files of these licences."""
        files = [
            file for file in self.folder.rglob("*") if re.match(r"(licen[cs]e|copying)", file.name, re.I)
        ]
        files = [file for file in files if file.is_file() and file.suffix.lower() in ("", ".txt", ".md")]
        marked = "|".join(re.escape(name.split("-")[0].split()[0]) for name in self.licences())
        named = [file for file in files if re.search(marked, file.name, re.I)]
        of_other = r"apache|mit|zlib|unlicense|0bsd"
        plain = [file for file in files if not re.search(of_other, file.name, re.I)]
        inner = [file for file in files if file.parent != self.folder]
        chosen = sorted({*(named or plain or files), *(file for file in inner if file in plain)})
        return ["\n".join(line.rstrip() for line in file.read_text().strip().splitlines()) for file in chosen]


@cache
def cargo(*flags: str) -> Any:
    """The crates of the lock and what needs what."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked", *flags]
    return json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True).stdout)


def in_the_engine(platform: str) -> set[str]:
    """The crates whose code is in the engine of a platform: neither those of build scripts nor macros."""
    metadata_of_crates = cargo("--filter-platform", platform)
    packages = {package["id"]: package for package in metadata_of_crates["packages"]}
    nodes = {node["id"]: node for node in metadata_of_crates["resolve"]["nodes"]}
    (start,) = (key for key, package in packages.items() if package["name"] == "niwaki-py")
    shipped: set[str] = set()
    waiting = [start]
    while waiting:
        key = waiting.pop()
        macro = any("proc-macro" in target["kind"] for target in packages[key]["targets"])
        if key in shipped or macro:
            continue
        shipped.add(key)
        waiting += [
            edge["pkg"]
            for edge in nodes[key]["deps"]
            if any(kind["kind"] is None for kind in edge["dep_kinds"])
        ]
    return shipped


def crates() -> list[Crate]:
    """Every crate of the lock, of all platforms."""
    packages = {package["id"]: package for package in cargo()["packages"]}
    shipped = set().union(*map(in_the_engine, PLATFORMS))
    return [
        Crate(
            package["name"],
            package["version"],
            package["license"] or "",
            Path(package["manifest_path"]).parent,
            package["source"],
            key in shipped,
        )
        for key, package in sorted(packages.items(), key=lambda pair: (pair[1]["name"], pair[1]["version"]))
        if package["source"] is not None
    ]


def texts(crate: Crate, other_crates: Iterable[Crate]) -> list[str]:
    """Return a crate's licence texts; a crate without Apache's text, which names no author, takes another crate's."""
    texts_of_crate = crate.texts()
    if texts_of_crate or not all(name.startswith("Apache-2.0") for name in crate.licences()):
        return texts_of_crate
    return next(
        (other.texts() for other in other_crates if other.licences() == crate.licences() and other.texts()),
        [],
    )


def third_party(all_crates: Iterable[Crate]) -> str:
    """The list of the crates in the engine, and the texts of their licences, each once."""
    inside = [crate for crate in all_crates if crate.shipped]
    lines = ["The compiled engine of Niwaki contains code of these packages, under these licences:", ""]
    lines += [f"  {crate.name} {crate.version}: {' AND '.join(sorted(crate.licences()))}" for crate in inside]
    lines += ["", "and the standard library of Rust, (c) The Rust Project Contributors: MIT"]
    users: dict[str, list[str]] = defaultdict(list)
    for crate in inside:
        for text in texts(crate, inside):
            users[text].append(crate.name)
    for text, names in users.items():
        lines += ["", "-" * 100, ", ".join(dict.fromkeys(names)), "", text]
    return "\n".join(lines) + "\n"


def packages() -> list[tuple[str, str]]:
    """Packages of the locks that are installed here, each with its licence."""
    locks = "\n".join(lock.read_text() for lock in (ROOT / "requirements").glob("*.txt"))
    pinned = {plain(name) for name in re.findall(r"^([\w.-]+)==", locks, re.M)}
    installed = {plain(package.metadata["Name"]): package for package in metadata.distributions()}
    return [(name, UNNAMED.get(name) or licence(installed[name])) for name in sorted(pinned & set(installed))]


def plain(name: str) -> str:
    """The name of a package as the index compares it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def licence(package: metadata.Distribution) -> str:
    """Return a package's SPDX expression, from its metadata, its classifiers or its short text."""
    about = package.metadata
    if "License-Expression" in about:
        return str(about["License-Expression"])
    classifiers = [classifier.split(" :: ") for classifier in about.get_all("Classifier") or ()]
    text = "; ".join(
        sorted(
            classifier[-1] for classifier in classifiers if classifier[0] == "License" and len(classifier) > 1
        )
    )
    if text in ("", "OSI Approved"):
        text = (str(about.get("License") or "").strip().splitlines() or [""])[0]
    return NAMES.get(text, text)


def faults() -> list[str]:
    """Return the licences that are not allowed, and the texts that are out of date."""
    permitted, all_crates = allowed(), crates()
    lines = [
        f"the crate {crate.name} {crate.version} has the licence `{crate.licence}`"
        for crate in all_crates
        if not crate.licence or not any(each <= permitted for each in choices(crate.licence))
    ]
    lines += [
        f"the crate {crate.name} comes from {crate.source}"
        for crate in all_crates
        if not crate.source.startswith("registry+")
    ]
    inside = [crate for crate in all_crates if crate.shipped]
    lines += [
        f"the crate {crate.name} has no text of its licence" for crate in inside if not texts(crate, inside)
    ]
    for name, expression in packages():
        if not expression or not any(each <= permitted | BESIDE for each in choices(expression)):
            lines.append(f"the package {name} has the licence `{expression or 'none'}`")
    if not TEXTS.exists() or TEXTS.read_text() != third_party(all_crates):
        lines.append("THIRD-PARTY is out of date: python tests/house/licences.py --write")
    return lines


if __name__ == "__main__":
    if "--write" in sys.argv:
        TEXTS.write_text(third_party(crates()))
    else:
        for fault in (lines := faults()):
            print(fault, file=sys.stderr)
        print(
            f"licences: {len(crates())} crates and {len(packages())} packages of Python, {len(lines)} faults"
        )
        sys.exit(bool(lines))
