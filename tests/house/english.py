"""Counts of what makes a text hard to read, by folder: pronouns as names, openings without a subject, long sentences.

| count    | counts                                                                                         |
| -------- | ---------------------------------------------------------------------------------------------- |
| names    | places where a name is given to a variable, parameter, function or type that is a pronoun or a participle |
| openings | docs of Python and Rust, and paragraphs of the manual, whose first sentence has no subject      |
| long     | sentences of docs and of the manual with more than 35 words                                     |

`english.toml` has the number of each folder; `test_english.py` refuses one that grew. `python tests/house/english.py
FOLDER ...` lists the places in these folders; `--write` writes the numbers anew.
"""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from checkout import ROOT, tracked

TABLE = ROOT / "tests" / "house" / "english.toml"
FOLDERS = ("python/niwaki", "crates", "tests", "integrations", "benches", "docs")

#: Pronouns and participles: a reader learns nothing from such a name.
PRONOUNS = frozenset(
    "one ones found own owned told given said says asked wanted made gone taken begun meant carried_out "
    "know knows what which whose who others same such everything nothing somebody nobody something".split()
)
OPENINGS = re.compile(
    r"(?:The same\b(?! \w+ (?:is|are|as))|That of\b|Those of\b|That which\b|Of (?!course)"
    r"|What\b(?![^.]*\?)|Which\b(?![^.]*\?)|Whether (?:no|some)body\b"
    r"|So (?:is|does|do|are)\b|As (?:it|they) (?:is|are)\b)"
)
LONGEST = 35  # words
RUST_NAME = re.compile(
    r"(?:\blet (?:mut )?|\bfn |\bstruct |\benum |\btrait |\btype |\bmod |\bfor |\b(?:Some|Ok|Err)\(|[|(,{]\s*(?:mut )?)"
    r"([A-Za-z_]\w*)\b(?=\s*(?::[^:]|=[^=>]|\||,|\)| in |\(|\{|<|;))"
)


@dataclass(frozen=True)
class Fault:
    """A place that a count counts."""

    kind: str
    path: str
    line: int
    text: str

    @property
    def folder(self) -> str:
        """The folder whose number it raises."""
        parts = self.path.split("/")
        depth = 3 if parts[0] == "python" else 2
        return "/".join(parts[:depth] if len(parts) > depth else parts[:-1])


def sentences(text: str) -> Iterator[str]:
    """The sentences of running text, without code, tables, lists' marks and headings."""
    text = re.sub(r"```.*?```|<!--.*?-->|^ *\|.*$|^#.*$|^(?: {4}|\t).*$", "", text, flags=re.S | re.M)
    for paragraph in re.split(r"\n\s*\n|^\s*(?:[-*]|\d+\.) ", text, flags=re.M):
        for sentence in re.split(r"(?<=[.!?:;])\s+", " ".join(paragraph.split())):
            if sentence:
                yield sentence


def prose(path: str, line: int, text: str) -> Iterator[Fault]:
    """Faults of one doc."""
    first = True
    for sentence in sentences(text):
        if first and OPENINGS.match(sentence):
            yield Fault("openings", path, line, sentence)
        if len(sentence.split()) > LONGEST:
            yield Fault("long", path, line, sentence)
        first = False


def python(path: str, text: str) -> Iterator[Fault]:
    """Faults of a file of Python."""
    for node in ast.walk(ast.parse(text)):
        names: list[str] = []
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names = [node.id]
        elif isinstance(node, ast.arg):
            names = [node.arg]
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            names = [node.name]
        for name in names:
            if name.strip("_").lower() in PRONOUNS:
                yield Fault("names", path, getattr(node, "lineno", 1), name)
        if isinstance(node, ast.Module | ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            doc = ast.get_docstring(node)
            if doc:
                # The sections of NumPy's style list names, types and examples.
                head = re.split(r"\n[A-Z]\w+( \w+)?\n-{3,}", doc)[0]
                yield from prose(path, getattr(node, "lineno", 1), head)


def rust(path: str, text: str) -> Iterator[Fault]:
    """Faults of a file of Rust."""
    bare = re.sub(r'//[^\n]*|"(?:\\.|[^"\\])*"', lambda m: re.sub(r"[^\n]", " ", m[0]), text)
    for match in RUST_NAME.finditer(bare):
        if match[1].strip("_").lower() in PRONOUNS:
            yield Fault("names", path, bare.count("\n", 0, match.start(1)) + 1, match[1])
    for match in re.finditer(r"(?:^[ \t]*//[/!] ?.*\n)+", text, re.M):
        doc = re.sub(r"^[ \t]*//[/!] ?", "", match[0], flags=re.M)
        yield from prose(path, text.count("\n", 0, match.start()) + 1, doc)


def page(path: str, text: str) -> Iterator[Fault]:
    """Faults of a page of the manual."""
    bare = re.sub(r"```.*?```|<!--.*?-->", lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.S)
    for match in re.finditer(r"(?:^[^\n]*\S[^\n]*\n?)+", bare, re.M):
        yield from prose(path, bare.count("\n", 0, match.start()) + 1, match[0])


READERS = {".py": python, ".rs": rust, ".md": page}


def faults(folders: tuple[str, ...] = FOLDERS) -> list[Fault]:
    """All faults of the files in these folders."""
    places: list[Fault] = []
    for path in sorted(tracked()):
        name = path.relative_to(ROOT).as_posix()
        if path.suffix in READERS and any(
            f"{name}/".startswith(f"{folder.rstrip('/')}/") for folder in folders
        ):
            places += READERS[path.suffix](name, path.read_text(encoding="utf-8"))
    return places


def counts(places: list[Fault]) -> dict[str, Counter[str]]:
    """The number of each kind in each folder."""
    table: dict[str, Counter[str]] = {}
    for fault in places:
        table.setdefault(fault.folder, Counter())[fault.kind] += 1
    return table


def limits() -> dict[str, Counter[str]]:
    """The numbers that may not grow."""
    return {folder: Counter(row) for folder, row in tomllib.loads(TABLE.read_text(encoding="utf-8")).items()}


def written(table: dict[str, Counter[str]]) -> str:
    """The text of `english.toml`."""
    head = "# Places that are hard to read (tests/house/english.py), by folder. The numbers only go down.\n\n"
    rows = (
        f'"{folder}" = {{ ' + ", ".join(f"{kind} = {row[kind]}" for kind in sorted(row)) + " }\n"
        for folder, row in sorted(table.items())
    )
    return head + "".join(rows)


def main(arguments: list[str]) -> int:
    """List the places of some folders, or write the table."""
    if arguments == ["--write"]:
        TABLE.write_text(written(counts(faults())), encoding="utf-8")
        return 0
    places = faults(tuple(arguments) or FOLDERS)
    for fault in places:
        print(f"{fault.path}:{fault.line}: {fault.kind}: {fault.text[:160]}")
    total = Counter(fault.kind for fault in places)
    print(", ".join(f"{kind} {total[kind]}" for kind in ("names", "openings", "long")))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
