"""The manual has a page for each error, in step with the table (`python -m niwaki.errors.catalogue docs/errors`)."""

from __future__ import annotations

from pathlib import Path

from niwaki.errors.catalogue import pages
from niwaki.errors.messages import MESSAGES

FOLDER = Path(__file__).parents[3] / "docs" / "errors"


def test_the_pages_are_those_of_the_table() -> None:
    written = {path.name: path.read_text() for path in FOLDER.glob("*.md") if path.name != "index.md"}
    assert written == pages()
    assert set(written) == {f"{code}.md" for code in MESSAGES}


def test_every_page_says_what_to_do() -> None:
    for text in pages().values():
        assert "## What to do" in text
        assert "{" not in text.split("```")[0]
