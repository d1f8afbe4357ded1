"""Claim: the manual has a page for each error, as in the table (`python -m niwaki.errors.catalogue docs/errors`)."""

from __future__ import annotations

import re
from pathlib import Path

from niwaki.errors.catalogue import pages
from niwaki.errors.messages import MESSAGES

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "docs" / "errors"
#: Where the engine and the package name the code of an error.
RAISED = re.compile(
    r"""(?:Fault|GeomError)::new\(\s*"([a-z-]+)"|^\s+\w+ = "([a-z-]+)";|"code", "([a-z-]+)"|"""
    # Not the studio's own `CommandError`, whose codes have no pages.
    r"""(?:(?<!Command)Error|ModelFault|from_engine)\(\s*"([a-z]+(?:-[a-z]+)+)\"""",
    re.MULTILINE,
)


def test_the_pages_agree_with_the_table() -> None:
    written = {path.name: path.read_text() for path in FOLDER.glob("*.md") if path.name != "index.md"}
    assert written == pages()
    assert set(written) == {f"{code}.md" for code in MESSAGES}


def test_every_page_has_a_cure() -> None:
    for text in pages().values():
        assert "## What to do" in text
        assert "{" not in text.split("```")[0]


def test_every_code_in_the_sources_has_a_page() -> None:
    sources = [*ROOT.glob("crates/*/src/**/*.rs"), *ROOT.glob("python/niwaki/**/*.py")]
    texts = [path.read_text().partition("#[cfg(test)]\nmod tests")[0] for path in sources]
    codes = {code for text in texts for match in RAISED.findall(text) for code in match if code}
    assert len(codes) > 100
    assert codes <= set(MESSAGES), sorted(codes - set(MESSAGES))
