"""Pages of the manual about errors, one for each code, written from the table of messages.

`python -m niwaki.errors.catalogue docs/errors` writes the pages; a test compares them with the table.
"""

from __future__ import annotations

import ast
import sys
from pathlib import Path

from niwaki import _engine
from niwaki.errors.kinds import fill
from niwaki.errors.messages import ADVICE, CHAINS, FAULTS, FILES, INPUTS, LANGUAGE, SETTINGS, Message

KINDS = (
    (LANGUAGE, "Niwaki reports this error when it compiles the model, before a run."),
    (FAULTS, "Niwaki reports this error during a run; the message shows the model's calls, outermost first."),
    (INPUTS, "Niwaki reports this error about a setting, an argument or the result of a search."),
    (FILES, "Niwaki reports this error when it reads or writes a file."),
    (
        CHAINS,
        "A Markov chain, or a search with a proposal or held choices, reports this error when it starts or runs.",
    ),
    (SETTINGS, "Niwaki reports this error when it checks a setting, a model's name or a run file."),
    (
        ADVICE,
        "This is advice of `niwaki check`, not an error: a search of the model could be more efficient.",
    ),
)


class _Shown(dict[str, str]):
    """A template's names, which a page shows in capitals."""

    def __missing__(self, key: str) -> str:
        return key.upper()


def page(message: Message, time: str) -> str:
    """Return a message's page in Markdown; `time` says when Niwaki reports the error."""
    title, why, cure = (text.format_map(_Shown()) for text in (message.title, message.why, message.help))
    parts = [f"# {message.code}", f"{_sentence(title)} {time}"]
    if message.about:
        parts += ["## Why", message.about.replace("{constraints}", _constraints())]
    elif message.why not in ("", "{reason}"):
        parts += ["## Why", _sentence(why)]
    if message.example:
        parts += ["## Example", _block(message.example)]
    named = message.help in ("{suggestion}", "{cure}")
    parts += ["## What to do", "Follow the suggestion of the message." if named else _sentence(cure)]
    if message.cure:
        parts.append(_block(message.cure))
    return "\n\n".join(parts) + "\n"


def _constraints() -> str:
    """Rows of a table: the sketches that forbid scenes."""
    texts = ((name, *both) for name, both in _engine.SKETCHES.items() if both is not None)
    return "".join(f"| `{name}` | a part {part} | {cure} |\n" for name, part, cure in texts)


def _block(text: str) -> str:
    """Return a block of Markdown: Python, a shell command, or the text of a file."""
    try:
        ast.parse(text)
        language = "python"
    except SyntaxError:
        language = "console" if text.startswith("niwaki ") else "text"
    return f"```{language}\n{text.rstrip()}\n```"


def _sentence(text: str) -> str:
    """Return a message as a sentence."""
    plain = fill(text, {})
    start = plain[:1] if plain.startswith("`") else plain[:1].upper()
    return start + plain[1:] + ("" if plain.endswith(("?", ".", "`:")) else ".")


def pages() -> dict[str, str]:
    """Return all pages by file name."""
    return {f"{message.code}.md": page(message, time) for table, time in KINDS for message in table}


def write(folder: Path) -> None:
    """Write all pages into a folder, and remove pages of old codes; the index stays."""
    texts = pages()
    for old in folder.glob("*.md"):
        if old.name not in texts and old.name != "index.md":
            old.unlink()
    for name, text in texts.items():
        (folder / name).write_text(text)


if __name__ == "__main__":
    write(Path(sys.argv[1]))
