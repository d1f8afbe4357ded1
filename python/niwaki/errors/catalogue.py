"""The manual's pages about errors, written from the table of messages: one page for each code.

`python -m niwaki.errors.catalogue docs/errors` writes them; a test compares the pages with the table.
"""

from __future__ import annotations

import ast
import sys
from pathlib import Path

from niwaki import _engine
from niwaki.errors.kinds import fill
from niwaki.errors.messages import ADVICE, CHAINS, FAULTS, FILES, INPUTS, LANGUAGE, SETTINGS, Message

KINDS = (
    (LANGUAGE, "Reported when a model is compiled, before anything runs."),
    (FAULTS, "Reported while a model runs; the message shows the model's own calls, outermost first."),
    (INPUTS, "Reported when a setting or an argument is checked."),
    (FILES, "Reported when a file is read or written."),
    (CHAINS, "Reported when a Markov chain, or a search with a proposal or held choices, starts or runs."),
    (SETTINGS, "Reported when a setting, a model's name or a run's file is checked."),
    (ADVICE, "Advice of `niwaki check`: the model is right, and a search of it could be more efficient."),
)


class _Shown(dict[str, str]):
    """Names of templates as a reader sees them."""

    def __missing__(self, key: str) -> str:
        return key.upper()


def page(message: Message, found: str) -> str:
    """One page, Markdown."""
    title, why, cure = (text.format_map(_Shown()) for text in (message.title, message.why, message.help))
    parts = [f"# {message.code}", f"{_sentence(title)} {found}"]
    if message.about:
        parts += ["## Why", message.about.replace("{constraints}", _constraints())]
    elif message.why not in ("", "{reason}"):
        parts += ["## Why", _sentence(why)]
    if message.example:
        parts += ["## Example", _block(message.example)]
    named = message.help in ("{suggestion}", "{cure}")
    parts += ["## What to do", "The message suggests what to write." if named else _sentence(cure)]
    if message.cure:
        parts.append(_block(message.cure))
    return "\n\n".join(parts) + "\n"


def _constraints() -> str:
    """Rows of a table: the sketches that forbid scenes."""
    texts = ((name, *both) for name, both in _engine.SKETCHES.items() if both is not None)
    return "".join(f"| `{name}` | a part {part} | {cure} |\n" for name, part, cure in texts)


def _block(text: str) -> str:
    """A block of code: Python, a shell command, or text of a file."""
    try:
        ast.parse(text)
        language = "python"
    except SyntaxError:
        language = "console" if text.startswith("niwaki ") else "text"
    return f"```{language}\n{text.rstrip()}\n```"


def _sentence(text: str) -> str:
    """A message as a sentence."""
    plain = fill(text, {})
    start = plain[:1] if plain.startswith("`") else plain[:1].upper()
    return start + plain[1:] + ("" if plain.endswith(("?", ".", "`:")) else ".")


def pages() -> dict[str, str]:
    """Every page by its file name."""
    return {f"{message.code}.md": page(message, found) for table, found in KINDS for message in table}


def write(folder: Path) -> None:
    """Write every page into a folder, and take away pages of codes that are gone; the index stays."""
    texts = pages()
    for old in folder.glob("*.md"):
        if old.name not in texts and old.name != "index.md":
            old.unlink()
    for name, text in texts.items():
        (folder / name).write_text(text)


if __name__ == "__main__":
    write(Path(sys.argv[1]))
