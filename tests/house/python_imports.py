"""Imports between the files of the package, wherever the import stands: for types alone and inside functions too.

A name that an `__init__.py`, or the `.pyi` beside it, only passes on leads to the file that defines it.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

Graph = dict[str, set[str]]


@dataclass
class File:
    """A file, with the names that it imports: their module, and their name there (none for the module itself)."""

    path: Path
    tree: ast.Module
    imports: list[tuple[str, str | None, str]] = field(default_factory=list)
    defined: set[str] = field(default_factory=set)


class Package:
    """The files below a folder that is a package, by the names of their modules."""

    def __init__(self, root: Path, folder: Path) -> None:
        self.root = root
        self.files = {self._module(folder, path): self._read(folder, path) for path in folder.rglob("*.py")}
        #: What the stub beside an `__init__.py` lists.
        self.stubs = {
            self._module(folder, path): self._read(folder, path) for path in folder.rglob("__init__.pyi")
        }
        #: Modules that are not written in Python: only their stub is.
        self.compiled = {self._module(folder, path) for path in folder.rglob("*.pyi")} - self.files.keys()

    def graph(self) -> Graph:
        """Files and the files that they import, named from the root of the repository."""
        return {self._name(file): self._imports(file) - {self._name(file)} for file in self.files.values()}

    def _name(self, file: File) -> str:
        return file.path.relative_to(self.root).as_posix()

    def _module(self, folder: Path, path: Path) -> str:
        parts = path.relative_to(folder.parent).with_suffix("").parts
        return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)

    def _read(self, folder: Path, path: Path) -> File:
        file = File(path, ast.parse(path.read_text(encoding="utf-8")))
        package = self._module(folder, path.with_name("__init__.py"))
        for node in ast.walk(file.tree):
            if isinstance(node, ast.Import):
                for alias in node.names:
                    file.imports.append((alias.name, None, alias.asname or alias.name))
            elif isinstance(node, ast.ImportFrom):
                above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
                module = ".".join([*above, *([node.module] if node.module else [])])
                file.imports += [(module, alias.name, alias.asname or alias.name) for alias in node.names]
        for statement in file.tree.body:
            for node in ast.walk(statement):
                if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
                    file.defined.add(node.name)
                elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                    file.defined.add(node.id)
        return file

    def _imports(self, file: File) -> set[str]:
        names = set()
        for module, name, known_as in file.imports:
            for target, is_item in self._targets(module, name):
                used = [target]
                if not is_item and self._is_package(target):
                    used = [*self._through(file, known_as, target)] or used
                names |= {self._name(self.files[each]) for each in used}
        return names

    def _is_package(self, module: str) -> bool:
        return self.files[module].path.name == "__init__.py"

    def _through(self, file: File, known_as: str, package: str) -> Iterator[str]:
        """The files that are meant by `package.name` where a package itself is imported."""
        for node in ast.walk(file.tree):
            if isinstance(node, ast.Attribute) and ast.unparse(node.value) == known_as:
                yield from (target for target, _ in self._targets(package, node.attr))

    def _targets(self, module: str, name: str | None) -> list[tuple[str, bool]]:
        """The modules of the package that a name leads to, and whether it is something in them; none from elsewhere."""
        if module not in self.files or f"{module}.{name}" in self.compiled:
            return []
        if name is None:
            return [(module, False)]
        if name == "*" or not self._is_package(module):
            return [(module, True)]
        passed_on = [*self.files[module].imports]
        if module in self.stubs:
            passed_on += self.stubs[module].imports
        for source, original, known_as in passed_on:
            if known_as == name and (source, original) != (module, name):
                return self._targets(source, original) or [(module, True)]
            if original == "*" and source in self.files and name in self.files[source].defined:
                return [(source, True)]
        if f"{module}.{name}" in self.files:
            return [(f"{module}.{name}", False)]
        return [(module, True)]
