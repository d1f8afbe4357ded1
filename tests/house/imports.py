"""Imports between the files of each crate and of the package: circles, and a map of the folders.

    python tests/house/imports.py          all circles, and what tests/house/circles.toml no longer allows
    python tests/house/imports.py --write  write the map again, docs/ideas/imports.md, and the drawing of the crates

A circle is a set of files of which each imports each, perhaps through others: whoever changes a part has to know the
whole. Folders are looked at in the same way, each with the files that are directly in it: `x/mod.rs` is of folder `x`.
"""

from __future__ import annotations

import os
import sys
import tomllib
from functools import cache
from pathlib import Path, PurePosixPath

from import_drawing import svg
from python_imports import Package
from rust_imports import Graph, Workspace

ROOT = Path(__file__).resolve().parents[2]
MAP = ROOT / "docs" / "ideas" / "imports.md"
DRAWING = ROOT / "docs" / "pictures" / "crates.svg"
EXCEPTIONS = ROOT / "tests" / "house" / "circles.toml"
#: Files of a circle that a reader still keeps in mind.
LIMIT = 7
PACKAGE = "python/niwaki"


@cache
def imports() -> Graph:
    """Files and the files that they import."""
    return Workspace(ROOT).graph() | Package(ROOT, ROOT / PACKAGE).graph()


def circles(graph: Graph) -> list[list[str]]:
    """Sets of more than one node that all lead to one another, the largest first (Tarjan 1972, without recursion)."""
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    waiting: list[str] = []
    sets = []
    for start in sorted(graph):
        if start in order:
            continue
        order[start] = low[start] = len(order)
        waiting.append(start)
        open_nodes = [(start, iter(sorted(graph[start])))]
        while open_nodes:
            node, rest = open_nodes[-1]
            for after in rest:
                if after not in order:
                    order[after] = low[after] = len(order)
                    waiting.append(after)
                    open_nodes.append((after, iter(sorted(graph.get(after, ())))))
                    break
                if after in waiting:
                    low[node] = min(low[node], order[after])
            else:
                open_nodes.pop()
                if open_nodes:
                    low[open_nodes[-1][0]] = min(low[open_nodes[-1][0]], low[node])
                if low[node] == order[node]:
                    place = waiting.index(node)
                    sets.append(sorted(waiting[place:]))
                    del waiting[place:]
    return sorted((each for each in sets if len(each) > 1), key=lambda each: (-len(each), each))


@cache
def room(file: str) -> str:
    """The crate of a file, or the package."""
    return PACKAGE if file.startswith(PACKAGE) else "/".join(PurePosixPath(file).parts[:2])


@cache
def folder(file: str) -> str:
    """The folder of a file; that of `x.rs` is `x`, if there is one."""
    path = PurePosixPath(file)
    beside = path.with_suffix("")
    return str(beside if (ROOT / beside).is_dir() else path.parent)


def folders(graph: Graph) -> Graph:
    """Return the graph of imports with a node for each folder."""
    nodes: Graph = {folder(file): set() for file in graph}
    for file, imported in graph.items():
        nodes[folder(file)] |= {folder(each) for each in imported} - {folder(file)}
    return nodes


def rooms(graph: Graph) -> list[str]:
    """The crates and the package, each after those that it imports."""
    between: Graph = {room(file): set() for file in graph}
    for file, imported in graph.items():
        between[room(file)] |= {room(each) for each in imported} - {room(file)}
    placed: list[str] = []
    while len(placed) < len(between):
        free = sorted(each for each in between if each not in placed and between[each] <= set(placed))
        assert free, "crates import one another"
        placed.append(free[0])
    return placed


def named(sets: list[list[str]]) -> dict[str, int]:
    """Circles and their sizes; a circle has the name of the folder that its parts share, and a number if others do."""
    sizes: dict[str, int] = {}
    for circle in sets:
        shared = os.path.commonpath(circle)
        number = 2
        name = shared
        while name in sizes:
            name, number = f"{shared} {number}", number + 1
        sizes[name] = len(circle)
    return sizes


def faults(graph: Graph, allowed: dict[str, dict[str, int]]) -> list[str]:
    """Return circles that the table of exceptions does not allow, and exceptions without a circle."""
    large = [each for each in circles(graph) if len(each) > LIMIT]
    lines = []
    for kind, present in ("files", named(large)), ("folders", named(circles(folders(graph)))):
        table = allowed.get(kind, {})
        for name in sorted(present.keys() | table.keys()):
            size, limit = present.get(name, 0), table.get(name, 0)
            if size > limit:
                lines.append(f"{name}: a circle of {size} {kind}, {limit or 'none'} allowed")
            elif size < limit:
                lines.append(f"{name}: {size} {kind} in place of {limit}: {EXCEPTIONS.name} allows too much")
    return lines


def exceptions() -> dict[str, dict[str, int]]:
    """Circles that there are still, by name: the size that each may have."""
    return tomllib.loads(EXCEPTIONS.read_text(encoding="utf-8"))


def report() -> str:
    """For each crate and the package: how many circles, how large; the parts of each, and what they import of it."""
    graph = imports()
    of_files, of_folders = circles(graph), circles(folders(graph))
    lines = [f"{'':18}{'files':>6}{'circles':>9}{'largest':>9}{'of folders':>12}"]
    for name in rooms(graph):
        files = [each for each in graph if room(each) == name]
        sizes = [len(each) for each in of_files if room(each[0]) == name]
        wide = [len(each) for each in of_folders if room(each[0]) == name]
        lines.append(f"{name:18}{len(files):>6}{len(sizes):>9}{max(sizes, default=0):>9}{len(wide):>12}")
    for kind, edges, sets in ("files", graph, of_files), ("folders", folders(graph), of_folders):
        for (name, size), circle in zip(named(sets).items(), sets, strict=True):
            shared = os.path.commonpath(circle)
            short = {each: os.path.relpath(each, shared) for each in circle}
            lines += ["", f"{name}: {size} {kind}"]
            for each in circle:
                to = " ".join(short[other] for other in circle if other in edges[each])
                lines.append(f"    {short[each]} -> {to}")
    return "\n".join(lines)


def in_order(graph: Graph) -> list[list[str]]:
    """Nodes, each after those that it imports; those of a circle are together."""
    together = {node: circle for circle in circles(graph) for node in circle}
    placed: list[list[str]] = []
    done: set[str] = set()
    while len(done) < len(graph):
        for node in sorted(graph.keys() - done):
            group = together.get(node, [node])
            if all(graph[each] <= done | set(group) for each in group):
                placed.append(group)
                done |= set(group)
                break
    return placed


def drawn() -> str:
    """The map: a table for the crates, and one for the folders of each crate and of the package."""
    graph = imports()
    between, order = folders(graph), rooms(graph)
    lines = [
        "# The map of imports",
        "",
        "Each line imports only lines above it. Where folders import one another in a circle, their names are bold.",
        "A folder stands for the files that are directly in it; what only tests import is not here. `make imports`",
        "writes this page, and shows which files are in each circle.",
        "",
        "| crate | imports |",
        "| --- | --- |",
    ]
    crates = [each for each in order if each != PACKAGE]
    for crate in crates:
        used = {room(target) for file in graph if room(file) == crate for target in graph[file]} - {crate}
        lines.append(f"| `{_short(crate)}` | {_list([_short(each) for each in crates if each in used])} |")
    for name in order:
        nodes = {
            node: {each for each in to if room(each) == name}
            for node, to in between.items()
            if room(node) == name
        }
        if len(nodes) < 2:
            continue
        groups = in_order(nodes)
        place = [each for group in groups for each in group]
        lines += ["", f"## {name}", "", "| folder | imports |", "| --- | --- |"]
        for group in groups:
            for node in group:
                shown = [_bold(_below(each, name), each in group) for each in place if each in nodes[node]]
                beyond = {room(each) for each in between[node]} - {name}
                shown = [f"`{_short(each)}`" for each in crates if each in beyond] + shown
                lines.append(f"| {_bold(_below(node, name), len(group) > 1)} | {', '.join(shown)} |")
    return "\n".join(lines) + "\n"


def drawing() -> str:
    """The crates with their imports, as a picture."""
    graph = imports()
    crates = [each for each in rooms(graph) if each != PACKAGE]
    edges = {
        _short(crate): {
            _short(room(target)) for file in graph if room(file) == crate for target in graph[file]
        }
        - {_short(crate)}
        for crate in crates
    }
    inside = {
        _short(crate): sorted(_below(node, crate) for node in folders(graph) if room(node) == crate)
        for crate in crates
    }
    return svg(edges, {name: [each for each in names if each != "lib"] for name, names in inside.items()})


def _short(crate: str) -> str:
    return PurePosixPath(crate).name


def _below(node: str, name: str) -> str:
    inside = PurePosixPath(node).relative_to(name).as_posix().removeprefix("src/")
    return f"{inside}/" if inside not in (".", "src") else "lib" if inside == "src" else "niwaki"


def _bold(name: str, marked: bool) -> str:
    return f"**{name}**" if marked else name


def _list(names: list[str]) -> str:
    return ", ".join(f"`{each}`" for each in names)


if __name__ == "__main__":
    if "--write" in sys.argv:
        MAP.write_text(drawn(), encoding="utf-8")
        DRAWING.write_text(drawing(), encoding="utf-8")
    print(report())
    for fault in (wrong := faults(imports(), exceptions())):
        print(fault, file=sys.stderr)
    sys.exit(bool(wrong))
