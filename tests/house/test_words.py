"""The package and the manual contain the words of the engine's table of solids."""

import pytest
import words

TEXTS = words.texts()


@pytest.mark.parametrize("file", TEXTS)
def test_what_follows_from_the_engine_is_written(file: str) -> None:
    assert (words.ROOT / file).read_text(encoding="utf-8") == TEXTS[file], "run make words"
