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
        found = both()
        while words and words[0] == "OR":
            words.pop(0)
            found += both()
        return found

    def both() -> list[set[str]]:
        found = one()
        while words and words[0] == "AND":
            words.pop(0)
            found = [left | right for right in one() for left in found]
        return found

    def one() -> list[set[str]]:
        word = words.pop(0)
        if word == "(":
            found = either()
            words.pop(0)
            return found
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

    def taken(self) -> set[str]:
        """The licences under which it is used here."""
        order = {name: place for place, name in enumerate(PREFERRED)}
        return min(choices(self.licence), key=lambda found: max(order.get(one, 99) for one in found))

    def texts(self) -> list[str]:
        """Its files of these licences."""
        files = [
            file for file in self.folder.rglob("*") if re.match(r"(licen[cs]e|copying)", file.name, re.I)
        ]
        files = [file for file in files if file.is_file() and file.suffix.lower() in ("", ".txt", ".md")]
        marked = "|".join(re.escape(one.split("-")[0].split()[0]) for one in self.taken())
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
    found = cargo("--filter-platform", platform)
    packages = {package["id"]: package for package in found["packages"]}
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
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


def texts(crate: Crate, others: Iterable[Crate]) -> list[str]:
    """A crate's texts of its licences. Apache's text names no author, so one that lacks it has another crate's."""
    own = crate.texts()
    if own or not all(name.startswith("Apache-2.0") for name in crate.taken()):
        return own
    return next((one.texts() for one in others if one.taken() == crate.taken() and one.texts()), [])


def third_party(found: Iterable[Crate]) -> str:
    """The list of the crates in the engine, and the texts of their licences, each once."""
    inside = [crate for crate in found if crate.shipped]
    lines = ["The compiled engine of Niwaki contains code of these packages, under these licences:", ""]
    lines += [f"  {one.name} {one.version}: {' AND '.join(sorted(one.taken()))}" for one in inside]
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
    found = {plain(one.metadata["Name"]): one for one in metadata.distributions()}
    return [(name, UNNAMED.get(name) or licence(found[name])) for name in sorted(pinned & set(found))]


def plain(name: str) -> str:
    """The name of a package as the index compares it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def licence(package: metadata.Distribution) -> str:
    """Its SPDX expression, as it says or as its classifiers or its short text say."""
    about = package.metadata
    if "License-Expression" in about:
        return str(about["License-Expression"])
    classifiers = [one.split(" :: ") for one in about.get_all("Classifier") or ()]
    said = "; ".join(sorted(one[-1] for one in classifiers if one[0] == "License" and len(one) > 1))
    if said in ("", "OSI Approved"):
        said = (str(about.get("License") or "").strip().splitlines() or [""])[0]
    return NAMES.get(said, said)


def faults() -> list[str]:
    """What is not allowed, and what is out of date."""
    permitted, all_crates = allowed(), crates()
    found = [
        f"the crate {one.name} {one.version} has the licence `{one.licence}`"
        for one in all_crates
        if not one.licence or not any(each <= permitted for each in choices(one.licence))
    ]
    found += [
        f"the crate {one.name} comes from {one.source}"
        for one in all_crates
        if not one.source.startswith("registry+")
    ]
    inside = [one for one in all_crates if one.shipped]
    found += [f"the crate {one.name} has no text of its licence" for one in inside if not texts(one, inside)]
    for name, expression in packages():
        if not expression or not any(each <= permitted | BESIDE for each in choices(expression)):
            found.append(f"the package {name} has the licence `{expression or 'none'}`")
    if not TEXTS.exists() or TEXTS.read_text() != third_party(all_crates):
        found.append("THIRD-PARTY is out of date: python tests/house/licences.py --write")
    return found


if __name__ == "__main__":
    if "--write" in sys.argv:
        TEXTS.write_text(third_party(crates()))
    else:
        for fault in (found := faults()):
            print(fault, file=sys.stderr)
        print(
            f"licences: {len(crates())} crates and {len(packages())} packages of Python, {len(found)} faults"
        )
        sys.exit(bool(found))
