"""Every message can be drawn, every code that is raised is in the table, and every code of the table is raised."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from niwaki.errors import Call, InputError, ModelError, ModelFault, NiwakiError
from niwaki.errors.kinds import place
from niwaki.errors.messages import (
    ADVICE,
    CHAINS,
    FAULTS,
    FILES,
    INPUTS,
    LANGUAGE,
    MESSAGES,
    SETTINGS,
    Message,
)
from specification import PRELUDE, load

REPOSITORY = Path(__file__).parents[3]
GOLDEN = REPOSITORY / "tests" / "golden"

# Raised by parts of the house that are not built yet; the list may only shrink.
AWAITED = {
    *(
        "missing-file unknown-file-kind unreadable-file empty-mesh non-finite-mesh bad-face no-cell-filled"
    ).split(),
    *(
        "too-many-cells unreadable-image bad-setting unknown-setting everything-impossible out-of-time"
    ).split(),
    *("model-arguments argument-value not-a-shape bad-choice not-enumerable").split(),
    *("too-many-runs rejection-budget rejection-bound wrong-arity not-runnable").split(),
    *(
        "waiting-cycle step-budget memory-budget integer-overflow not-callable host-function missing-method"
    ).split(),
    *("argument-count bad-shape").split(),
}


def test_codes_and_titles_have_the_house_style() -> None:
    tables = (LANGUAGE, FAULTS, INPUTS, FILES, SETTINGS, ADVICE, CHAINS)
    assert len(MESSAGES) == sum(len(table) for table in tables) >= 45
    for message in MESSAGES.values():
        assert re.fullmatch(r"[a-z]+(-[a-z]+)*", message.code)
        assert not message.title.endswith("."), message.code
        assert message.title[0].islower() or message.title.startswith(("`", "{")), message.code
        assert message.help, message.code
        for word in ("ast.", "AST", "node", "lowered", "core form", "closure", "None of"):
            shown = (message.title, message.label, message.second, message.why, message.help)
            assert all(word not in text for text in shown), (message.code, word)


def refused(message: Message) -> ModelError:
    with pytest.raises(ModelError) as found:
        load(message.example, "model.py").core()
    return found.value


@pytest.mark.parametrize("message", LANGUAGE, ids=lambda message: message.code)
def test_each_rule_refuses_its_example_and_takes_its_cure(message: Message) -> None:
    error = refused(message)
    assert error.code == message.code
    assert "{" not in error.render().splitlines()[0]
    load(message.cure, "model.py").core()


def test_messages_of_the_language_are_as_reviewed(golden) -> None:
    golden(GOLDEN / "messages.txt", "\n\n".join(str(refused(message)) for message in LANGUAGE) + "\n")


def test_faults_and_inputs_are_as_reviewed(golden) -> None:
    path = str(Path(__file__))
    call = [Call("ship", place(path, 1, 1, 1, 5)), Call("wing", place(path, 3, 1, 3, 5))]
    faults: list[NiwakiError] = [ModelFault(message.code, stack=call, replay="seed=1") for message in FAULTS]
    for message in INPUTS:
        names = re.findall(r"\{(\w+)\}", message.title + message.why + message.help)
        faults.append(InputError(message.code, **{name: name.upper() for name in names}))
    text = "\n\n".join(str(fault).replace(path, "ship.py") for fault in faults)
    golden(GOLDEN / "faults.txt", text + "\n")


def test_raised_codes_are_those_of_the_table() -> None:
    sources = [*REPOSITORY.glob("python/niwaki/**/*.py")]
    raised: set[str] = set()
    quoted: set[str] = set()
    for path in sources:
        if path.parent.name == "texts":
            continue
        text = path.read_text()
        raised |= set(re.findall(r'(?:refuse|ModelError|InputError|ModelFault)\(\s*"([a-z-]+)"', text))
        quoted |= set(re.findall(r'"([a-z]+(?:-[a-z]+)*)"', text))
    for path in REPOSITORY.glob("crates/*/src/**/*.rs"):
        quoted |= set(re.findall(r'"([a-z]+(?:-[a-z]+)*)"', path.read_text()))
    assert raised <= set(MESSAGES), raised - set(MESSAGES)
    unused = set(MESSAGES) - quoted
    assert unused <= AWAITED, unused - AWAITED


def test_the_layout_is_the_one_of_the_style_guide() -> None:
    text = "\n" * 11 + (
        "def tree(n):\n    xs = []\n    for i in range(n):\n        xs.append(branch(i))\n    return xs\n"
        "def branch(i):\n    return i\n@model\ndef m():\n    return tree(2)\n"
    )
    with pytest.raises(ModelError) as found:
        load(text, "tree.py").core()
    assert str(found.value) == (
        "error[changes-a-value]: a model cannot change a value in place\n"
        "  --> tree.py:15:9\n"
        "   |\n"
        "13 |     xs = []\n"
        "   |     -- created here\n"
        "15 |         xs.append(branch(i))\n"
        "   |         ^^^^^^^^^^^^^^^^^^^^ changes `xs`\n"
        "   |\n"
        "   = why: a run can be resumed from any of its choices; "
        "all of these continuations would share the changed value\n"
        "   = help: write `xs = xs + [branch(i)]`"
    )


def test_two_files_are_shown_one_after_the_other() -> None:
    first, second = place(__file__, 1, 1, 1, 4), place(load.__code__.co_filename, 2, 1, 2, 3)
    text = ModelError("unknown-keyword", first, second, name="f", keyword="k").render()
    assert "::: " in text and text.count("-->") == 1


def test_the_prelude_is_one_line() -> None:
    assert PRELUDE.count("\n") == 1
