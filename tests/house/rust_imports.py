"""Imports between the files of a crate: the text of the crates, read without a compiler.

The modules are those that `mod` declares from `lib.rs` on. What counts is a `use` and a path in the code; a name that a
file only passes on (`pub use`) leads to the file that defines it. Tests and documentation do not count.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

Graph = dict[str, set[str]]

TOKEN = re.compile(
    r"""
    (?P<blank>\s+|//[^\n]*)
  | (?P<block>/\*)
  | (?P<raw>b?c?r(?P<hashes>\#*)".*?"(?P=hashes))
  | (?P<string>[bc]?"(?:\\.|[^"\\])*")
  | (?P<char>b?'(?:\\(?:x..|u\{[^}]*\}|.)|[^'\\])')
  | (?P<life>'\w+)
  | (?P<word>(?:r\#)?[A-Za-z_]\w*)
  | (?P<number>\d\w*)
  | (?P<sign>::|.)
    """,
    re.X | re.S,
)
OPENING, CLOSING = set("([{"), set(")]}")
#: Words before the name of what a module defines.
DEFINING = {"fn", "struct", "enum", "trait", "type", "static", "const", "union"}
#: Conditions under which code is not in the engine.
APART = (["cfg", "(", "test", ")"], ["cfg", "(", "doc", ")"])


def tokens(text: str) -> list[str]:
    """Words and signs; a literal is one token, `""`."""
    list_of_tokens, place = [], 0
    while place < len(text):
        match = TOKEN.match(text, place)
        assert match is not None
        place = match.end()
        if match.lastgroup == "block":
            place = _after_comment(text, place)
        elif match["string"] or match["raw"] or match["char"]:
            list_of_tokens.append('""')
        elif match["word"]:
            list_of_tokens.append(match["word"].removeprefix("r#"))
        elif match["sign"]:
            list_of_tokens.append(match["sign"])
    return list_of_tokens


def _after_comment(text: str, place: int) -> int:
    depth = 1
    while depth:
        match = re.compile(r"/\*|\*/").search(text, place)
        assert match is not None, "a comment has no end"
        depth += 1 if match[0] == "/*" else -1
        place = match.end()
    return place


@dataclass
class Use:
    """A leaf of a `use`: the path, the name that it gives, and whether others may take that name from here."""

    path: list[str]
    name: str  # "*" for all names
    passed_on: bool


@dataclass(eq=False)
class Module:
    """A module, in a file of its own or inside one."""

    name: tuple[str, ...]
    file: Path
    parent: Module | None
    children: dict[str, Module] = field(default_factory=dict)
    defined: set[str] = field(default_factory=set)
    uses: list[Use] = field(default_factory=list)
    paths: list[list[str]] = field(default_factory=list)
    words: set[str] = field(default_factory=set)

    @property
    def root(self) -> Module:
        """The module of `lib.rs`."""
        return self if self.parent is None else self.parent.root

    def tree(self) -> Iterator[Module]:
        """The module and all below it."""
        yield self
        for child in self.children.values():
            yield from child.tree()


class Reader:
    """One file, read into its module; files that it declares are read too."""

    def __init__(self, module: Module, folder: Path) -> None:
        self.text = tokens(module.file.read_text(encoding="utf-8"))
        self.place = 0
        self._module(module, folder, len(self.text))

    def _module(self, module: Module, folder: Path, end: int) -> None:
        depth = 0
        while self.place < end:
            word = self.text[self.place]
            after = self.text[self.place + 1] if self.place + 1 < end else ""
            if word == "#" and after in ("[", "!"):
                self._attribute()
            elif word == "pub" and after == "(":
                self.place = self._closing(self.place + 1) + 1
                if self.text[self.place] == "use":
                    self._use(module, passed_on=True)
            elif word == "pub" and after == "use":
                self.place += 1
                self._use(module, passed_on=True)
            elif word == "use":
                self._use(module, passed_on=False)
            elif word == "mod" and self.text[self.place + 2] in (";", "{"):
                self._child(module, folder)
            elif word == "macro_rules" and after == "!":
                module.defined.add(self.text[self.place + 2])
                self.place += 3
            elif word.isidentifier():
                if depth == 0 and word in DEFINING and after.isidentifier():
                    module.defined.add(self.text[self.place + 2] if after == "mut" else after)
                self._path(module)
            else:
                depth += (word == "{") - (word == "}")
                self.place += 1

    def _attribute(self) -> None:
        opening = self.place + 1 + (self.text[self.place + 1] == "!")
        closing = self._closing(opening)
        self.place = closing + 1
        if self.text[opening + 1 : closing] in APART:
            self._skip_item()

    def _skip_item(self) -> None:
        while self.text[self.place] == "#":
            self.place = self._closing(self.place + 1) + 1
        if self.text[self.place] == "pub":
            self.place += 1
            if self.text[self.place] == "(":
                self.place = self._closing(self.place) + 1
        first, second = self.text[self.place : self.place + 2]
        ends = (
            {";"}
            if first in ("use", "static", "let") or (first == "const" and second != "fn")
            else {";", "{"}
        )
        ends |= {","} if second == ":" else set()
        while self.text[self.place] not in ends:
            self.place = self._closing(self.place) if self.text[self.place] in OPENING else self.place
            self.place += 1
        self.place = (self._closing(self.place) if self.text[self.place] == "{" else self.place) + 1

    def _closing(self, place: int) -> int:
        depth = 0
        while True:
            depth += (self.text[place] in OPENING) - (self.text[place] in CLOSING)
            if depth == 0:
                return place
            place += 1

    def _child(self, module: Module, folder: Path) -> None:
        name, how = self.text[self.place + 1 : self.place + 3]
        if how == "{":
            end = self._closing(self.place + 2)
            self.place += 3
            child = Module((*module.name, name), module.file, module)
            self._module(child, folder / name, end)
            self.place = end + 1
        else:
            self.place += 3
            beside, within = folder / f"{name}.rs", folder / name / "mod.rs"
            child = Module((*module.name, name), beside if beside.exists() else within, module)
            Reader(child, folder / name)
        module.children[name] = child

    def _use(self, module: Module, passed_on: bool) -> None:
        self.place += 1
        module.uses += [Use(path, name, passed_on) for path, name in self._tree([])]

    def _tree(self, before: list[str]) -> list[tuple[list[str], str]]:
        path = list(before)
        while True:
            word = self.text[self.place]
            self.place += 1
            if word == "{":
                uses = []
                while self.text[self.place] != "}":
                    if self.text[self.place] == ",":
                        self.place += 1
                    else:
                        uses += self._tree(path)
                self.place += 1
                return uses
            if word == "*":
                return [(path, "*")]
            if word != "::":
                path += [] if word == "self" and path else [word]
            if self.text[self.place] == "as":
                self.place += 2
                return [(path, self.text[self.place - 1])]
            if self.text[self.place] in (",", "}", ";"):
                return [(path, path[-1])]

    def _path(self, module: Module) -> None:
        path = [self.text[self.place]]
        continued = self.place > 0 and self.text[self.place - 1] == "::" and self._goes_on(self.place - 2)
        self.place += 1
        while self.place + 1 < len(self.text) and self.text[self.place] == "::":
            if not self.text[self.place + 1].isidentifier():
                break
            path.append(self.text[self.place + 1])
            self.place += 2
        module.words.add(path[0])
        if len(path) > 1 and not continued:
            module.paths.append(path)

    def _goes_on(self, place: int) -> bool:
        return place >= 0 and (self.text[place].isidentifier() or self.text[place] == ">")


@dataclass(frozen=True)
class Target:
    """The target of a name: a module, or something that is defined in it."""

    module: Module
    item: bool


class Workspace:
    """The crates of a folder, with the names that they know one another by."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.crates: dict[str, Module] = {}
        #: Names, with the file that they are asked from, that no text defines: those that a macro makes.
        self.unknown: set[tuple[str, str]] = set()
        for manifest in sorted(root.glob("crates/*/Cargo.toml")):
            data = tomllib.loads(manifest.read_text(encoding="utf-8"))
            name = data.get("lib", {}).get("name", data["package"]["name"]).replace("-", "_")
            source = manifest.parent / "src"
            self.crates[name] = Module((name,), source / "lib.rs", None)
            Reader(self.crates[name], source)

    def graph(self) -> Graph:
        """Files and the files that they import, named from the root of the repository."""
        nodes: Graph = {}
        for crate in self.crates.values():
            for module in crate.tree():
                imports = {self._name(file) for file in self._imports(module)}
                name = self._name(module.file)
                nodes[name] = nodes.get(name, set()) | imports - {name}
        return nodes

    def _name(self, file: Path) -> str:
        return file.relative_to(self.root).as_posix()

    def _imports(self, module: Module) -> Iterator[Path]:
        through = {path[0] for path in module.paths}
        for use in module.uses:
            targets = self._targets(module, use.path)
            if use.name == "*":
                for target in targets:
                    yield from self._all_of(module, target)
                continue
            for target in targets:
                below = target.module.name[: len(module.name)] == module.name
                if use.passed_on and below and use.name not in module.words:
                    continue
                # The paths through a module say which file is meant.
                if target.item or use.name not in through:
                    yield target.module.file
        for path in module.paths:
            for target in self._targets(module, path):
                yield target.module.file

    def _all_of(self, module: Module, target: Target) -> Iterator[Path]:
        if target.item:
            yield target.module.file
            return
        names = set(target.module.defined) | {use.name for use in target.module.uses if use.passed_on}
        for name in names & module.words:
            for target_of_name in self._named(target.module, name, set()):
                yield target_of_name.module.file

    def _targets(self, module: Module, path: list[str]) -> list[Target]:
        return self._follow(module, path, set())

    def _follow(self, module: Module, path: list[str], seen: set[tuple[Module, str]]) -> list[Target]:
        """Return the targets of a path: nothing for a path out of the workspace."""
        first, *rest = path
        if first == "crate":
            here = [Target(module.root, False)]
        elif first == "self":
            here = [Target(module, False)]
        elif first == "super":
            here = [Target(module.parent or module, False)]
        elif not (here := self._named(module, first, seen)):
            if first not in self.crates:
                return []
            here = [Target(self.crates[first], False)]
        for name in rest:
            modules = [target.module for target in here if not target.item]
            if not modules:
                break  # a variant, an associated function
            if name == "super":
                here = [Target(each.parent or each, False) for each in modules]
                continue
            here = [target for each in modules for target in self._named(each, name, seen)]
            if not here:
                # A macro defines it, as far as the text says.
                self.unknown.add((self._name(modules[0].file), name))
                return [Target(modules[0], True)]
        return here

    def _named(self, module: Module, name: str, seen: set[tuple[Module, str]]) -> list[Target]:
        if (module, name) in seen:
            return []
        seen = seen | {(module, name)}
        targets = [Target(module, True)] if name in module.defined else []
        targets += [Target(module.children[name], False)] if name in module.children else []
        for use in module.uses:
            if use.name == name:
                # A name from elsewhere is this module's, as far as others see.
                targets += self._follow(module, use.path, seen) or [Target(module, True)]
            elif use.name == "*":
                for target in self._follow(module, use.path, seen):
                    targets += [] if target.item else self._named(target.module, name, seen)
        return targets
