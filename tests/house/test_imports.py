"""Circles of imports stay small, within one folder, and the map of the folders is as the files are."""

import re
from pathlib import Path

import imports
import pytest
from python_imports import Package
from rust_imports import Workspace

MANIFEST = '[package]\nname = "niwaki-{}"\n'


def written(root: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return root


def test_circles_are_small_and_within_a_folder_but_for_those_that_are_listed():
    assert imports.faults(imports.imports(), imports.exceptions()) == []


def test_the_map_of_imports_is_as_the_files_are():
    assert imports.MAP.read_text() == imports.drawn(), "out of date: make imports"
    assert imports.DRAWING.read_text() == imports.drawing(), "out of date: make imports"


def ring(folder: str, size: int) -> imports.Graph:
    return {f"{folder}/{k}.rs": {f"{folder}/{(k + 1) % size}.rs"} for k in range(size)}


def test_a_circle_of_seven_files_may_be_and_one_of_eight_may_not():
    assert imports.faults(ring("crates/a/src", 7), {}) == []
    assert imports.faults(ring("crates/a/src", 8), {}) == ["crates/a/src: a circle of 8 files, none allowed"]


def test_an_exception_neither_grows_nor_outlives_its_circle():
    table = {"files": {"crates/a/src": 9}}
    assert imports.faults(ring("crates/a/src", 9), table) == []
    assert "a circle of 10 files, 9 allowed" in imports.faults(ring("crates/a/src", 10), table)[0]
    assert "8 files in place of 9" in imports.faults(ring("crates/a/src", 8), table)[0]
    assert "0 files in place of 9" in imports.faults({}, table)[0]
    # A second circle beside the one that is listed.
    both = ring("crates/a/src", 9) | {
        f"{name}x": {f"{each}x" for each in to} for name, to in ring("crates/a/src", 8).items()
    }
    assert imports.faults(both, table) == ["crates/a/src 2: a circle of 8 files, none allowed"]


def test_folders_in_a_circle_are_refused_though_no_files_are():
    graph = {
        "a/x/one.rs": {"a/y/one.rs"},
        "a/y/two.rs": {"a/x/two.rs"},
        "a/y/one.rs": set(),
        "a/x/two.rs": set(),
    }
    assert imports.circles(graph) == []
    assert imports.faults(graph, {}) == ["a: a circle of 2 folders, none allowed"]


def test_circles_are_those_that_a_search_of_all_paths_has():
    graph = {
        "a": {"b"},
        "b": {"c", "d"},
        "c": {"a", "e"},
        "d": {"e"},
        "e": {"f"},
        "f": {"e", "g"},
        "g": set(),
    }
    assert imports.circles(graph) == [["a", "b", "c"], ["e", "f"]]


@pytest.mark.parametrize(
    ("text", "imported"),
    [
        ("use crate::deep::Item;", {"deep/item.rs"}),
        ("use crate::{deep::{self, Item as Other}, plain};", {"deep/item.rs", "deep/mod.rs", "plain.rs"}),
        ("use super::plain::*; fn f() { plain_function() }", {"plain.rs"}),
        ("use super::plain::*; fn f() { another() }", set()),
        ("use super::Top;", {"lib.rs"}),
        ("use super::deep;\nfn f() { deep::Item::new() }", {"deep/item.rs"}),
        ("fn f() { crate::deep::item::Item::new(); }", {"deep/item.rs"}),
        ("fn f() -> Vec<super::plain::Plain<'static>> { loop {} }", {"plain.rs"}),
        ("pub(in crate::deep) fn f() {}", set()),
        ("/// [`crate::plain`]\nfn f() { /* crate::plain::x() */ \"crate::plain::x()\"; 'c'; }", set()),
        ('fn f() { r#"" crate::plain::x() "#; }', set()),
        ("mod inner { use super::super::plain::Plain; }", {"plain.rs"}),
        ("#[cfg(test)]\nmod tests { use super::super::plain::Plain; }\nuse crate::Top;", {"lib.rs"}),
        ("#[cfg(test)]\nuse crate::{plain::Plain};\n#[cfg(test)]\nfn f() { crate::deep::x() }", set()),
        ("use niwaki_b::Passed;", {"../../b/src/within.rs"}),
        ("use niwaki_b::made::by_a_macro;", {"../../b/src/made.rs"}),
        ("use std::fmt; fn f() { fmt::Debug }", set()),
    ],
)
def test_an_import_of_rust_leads_to_the_file_that_defines_it(tmp_path: Path, text: str, imported: set[str]):
    files = {
        "crates/a/Cargo.toml": MANIFEST.format("a"),
        "crates/a/src/lib.rs": "mod plain; pub mod deep; mod reader; pub struct Top; #[cfg(test)] mod absent;",
        "crates/a/src/plain.rs": "pub struct Plain<'a>(&'a u8); pub fn plain_function() {}",
        "crates/a/src/deep/mod.rs": "mod item; pub use item::Item; pub fn own() {}",
        "crates/a/src/deep/item.rs": "pub struct Item;",
        "crates/a/src/reader.rs": text,
        "crates/b/Cargo.toml": MANIFEST.format("b"),
        "crates/b/src/lib.rs": "mod within; pub mod made; pub use within::*;",
        "crates/b/src/within.rs": "pub enum Passed { On }",
        "crates/b/src/made.rs": "functions! { by_a_macro }",
    }
    graph = Workspace(written(tmp_path, files)).graph()
    source = tmp_path / "crates" / "a" / "src"
    assert graph["crates/a/src/reader.rs"] == {
        (source / name).resolve().relative_to(tmp_path).as_posix() for name in imported
    }
    # A parent that declares a child, and passes on what is in it, does not import it.
    assert graph["crates/a/src/lib.rs"] == set() and graph["crates/a/src/deep/mod.rs"] == set()


@pytest.mark.parametrize(
    ("text", "imported"),
    [
        ("from niwaki.part import Item", {"part/item.py"}),
        ("from niwaki.lazy import Item", {"part/item.py"}),
        ("from .lazy import Item as Other", {"part/item.py"}),
        ("from .starred import Item", {"part/item.py"}),
        ("from niwaki.part import item", {"part/item.py"}),
        ("from niwaki.part import of_the_part", {"part/__init__.py"}),
        ("from niwaki import part\nx = part.Item, part.of_the_part", {"part/item.py", "part/__init__.py"}),
        ("import niwaki.part\nx = niwaki.part.Item", {"part/item.py"}),
        ("import niwaki.part.item", {"part/item.py"}),
        ("from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .plain import x", {"plain.py"}),
        ("def f():\n    from niwaki.plain import x", {"plain.py"}),
        ("import json\nfrom numpy import array", set()),
        ("from niwaki import _engine\nx = _engine.part", set()),
        ("from niwaki.part import of_the_part\nx = of_the_part.Item", {"part/__init__.py"}),
    ],
)
def test_an_import_of_python_leads_to_the_file_that_defines_it(tmp_path: Path, text: str, imported: set[str]):
    files = {
        "niwaki/__init__.py": "",
        "niwaki/_engine.pyi": "",
        "niwaki/plain.py": "x = 1",
        "niwaki/reader.py": text,
        "niwaki/part/__init__.py": "from niwaki.part.item import Item\ndef of_the_part(): ...",
        "niwaki/part/item.py": "class Item: ...",
        "niwaki/lazy/__init__.py": "import lazy_loader",
        "niwaki/lazy/__init__.pyi": "from ..part import Item as Item",
        "niwaki/starred/__init__.py": "from niwaki.part.item import *",
    }
    graph = Package(written(tmp_path, files), tmp_path / "niwaki").graph()
    assert graph["niwaki/reader.py"] == {f"niwaki/{name}" for name in imported}


def test_every_file_of_a_crate_is_read_and_every_name_is_found_but_for_those_of_macros():
    root = imports.ROOT
    crates = Workspace(root)
    read = crates.graph().keys()
    tests_alone = {"tests", "testing"}
    unread = {path.relative_to(root) for path in root.glob("crates/*/src/**/*.rs")} - {
        Path(each) for each in read
    }
    assert {path for path in unread if not tests_alone & {*path.parent.parts, path.stem}} == set()
    texts = {file: (root / file).read_text() for file in read}
    # A macro for other crates is a name of the root; a call of a macro defines what it will.
    exported = re.findall(r"#\[macro_export\]\s+macro_rules! (\w+)", "\n".join(texts.values()))
    calls = re.compile(r"macro_rules!|^[a-z_]+! \{", re.MULTILINE)
    assert {
        file for file, name in crates.unknown if name not in exported and not calls.search(texts[file])
    } == set()
