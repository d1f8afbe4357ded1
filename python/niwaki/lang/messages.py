from __future__ import annotations
from dataclasses import dataclass

@dataclass(frozen=True)
class Message:
    code: str
    title: str
    label: str = ""
    second: str = ""
    why: str = ""
    help: str = ""

class _All(dict):
    def __missing__(self, k):
        return Message(k, k)
MESSAGES = _All()
