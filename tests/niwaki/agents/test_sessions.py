"""Recorded sessions: a client writes models, mends them by what the answers say, grows, holds, exports.

All sessions use one server, one after another, each in a folder of its own. Every answer keeps its limits (`agent.py`).
"""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest
from agent import Agent

TABLE = tomllib.loads((Path(__file__).parent / "sessions.toml").read_text())
SESSIONS = TABLE["session"]
#: Keys of a call that are no arguments of its tool.
EXPECTED = ("tool", "has", "hasnot", "fails", "results", "picture", "offers", "of", "swap")


def test_there_are_thirty_sessions():
    assert len(SESSIONS) == 30 and len({session["name"] for session in SESSIONS}) == 30


@pytest.mark.parametrize("session", SESSIONS, ids=[session["name"] for session in SESSIONS])
def test_a_session(agent: Agent, session: dict[str, Any]):
    replay(agent, session, f"session-{SESSIONS.index(session)}")


def replay(agent: Agent, session: dict[str, Any], folder: str) -> None:
    """Repeat a session in a folder of its own."""
    client = Recorded(agent, folder)
    if "requirements" in session:
        (agent.folder / folder / "requirements.toml").write_text(session["requirements"])
    if "model" in session:
        client.mend(session["model"], session.get("faults", []))
    for call in session["calls"]:
        client.send(call)


class Recorded:
    """A client that repeats the calls of a session, in a folder of its own."""

    def __init__(self, agent: Agent, folder: str) -> None:
        self._agent, self._folder = agent, folder
        (agent.folder / folder).mkdir(exist_ok=True)
        self._keys: dict[str, Any] = {}
        self._offer = ""

    def mend(self, name: str, faults: list[list[str]]) -> None:
        """Write a model with all faults, and mend one after the other: that which the answer names."""
        path, text = f"{name}.py", TABLE["models"][name].lstrip()
        left = list(faults)
        while left:
            broken = text
            for right, wrong, _ in left:
                assert right in broken, right
                broken = broken.replace(right, wrong)
            answer = self._agent.failed("write", path=self._below(path), text=broken)
            mended = [fault for fault in left if self._below(fault[2], path) in answer]
            assert len(mended) == 1, (answer, left)
            left.remove(mended[0])
        self._agent.done("write", path=self._below(path), text=text)

    def send(self, call: dict[str, Any]) -> None:
        """Send a call, and hold its answer against what the session expects."""
        arguments = {name: self._value(name, value) for name, value in call.items() if name not in EXPECTED}
        if "of" in call:
            text = TABLE["models"][call["of"]].lstrip()
            for right, wrong in call.get("swap", []):
                assert right in text, right
                text = text.replace(right, wrong)
            arguments["text"] = text
        reply = self._agent.call(call["tool"], **arguments)
        assert reply.has_failed == ("fails" in call), reply.text
        for words in (*call.get("has", []), *call.get("fails", [])):
            assert self._below(words, ".py") in reply.text, (words, reply.text)
        assert not [words for words in call.get("hasnot", []) if words in reply.text], reply.text
        if "offers" in call:
            # An offer is JSON in the answer, as every table is.
            self._offer = json.loads(reply.text[reply.text.index('{"label"') :].splitlines()[0])["difference"]
        assert (reply.picture is not None) == call.get("picture", False)
        self._note(reply.text, call.get("results"))

    def _below(self, words: str, path: str = "") -> str:
        """Return a path, or words that name one, as the server says it: from the folder of all sessions."""
        name = path or words
        return words.replace(name, f"{self._folder}/{name}") if path != ".py" else words

    def _value(self, name: str, value: Any) -> Any:
        """Return an argument: a file's path from the folder of all sessions, and a key of a result."""
        if name == "key":
            return self._keys[value] if isinstance(value, str) else value
        if value == "OFFERED":
            return self._offer
        is_file = (
            isinstance(value, str) and value.rpartition(":")[0].endswith(".py") or str(value).endswith(".py")
        )
        return f"{self._folder}/{value}" if name == "path" or (name == "reference" and is_file) else value

    def _note(self, text: str, count: int | None) -> None:
        """Note the keys of results, which an answer lists if they have changed."""
        lines = text.splitlines()
        if "results:" in lines:
            rows = []
            for line in lines[lines.index("results:") + 1 :]:
                if not line.startswith("  {"):
                    break
                rows.append(json.loads(line)["key"])
            self._keys |= dict(zip(("best", "second"), rows, strict=False))
            assert count is None or len(rows) == count, text
        else:
            assert count is None, text
        for line in lines:
            if line.startswith("picked: "):
                self._keys["picked"] = json.loads(line.removeprefix("picked: "))
