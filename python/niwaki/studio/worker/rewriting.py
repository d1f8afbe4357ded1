"""Changes of the model's file: those that were offered last, of which one may be written."""

from __future__ import annotations

from typing import Any

from niwaki.errors import InputError
from niwaki.search.drag.source import SourceChange, as_defaults
from niwaki.studio.messages import Answer, Offer, Offered, ProposeDefaults, RewriteFile
from niwaki.studio.worker import models

_offered: list[SourceChange] = []


def offered(changes: list[SourceChange]) -> list[Offer]:
    """Offer these, and nothing that was offered before."""
    _offered[:] = changes
    return [Offer(one.says, one.difference(), not one.choices) for one in changes]


def propose(job: ProposeDefaults, send: Any) -> Answer:
    """Offer the arguments as defaults."""
    change = as_defaults(models.reference(job.question.model).model, job.question.arguments)
    send(Offered(job.id, offered([] if change is None else [change])))
    return Answer()


def rewrite(job: RewriteFile) -> Answer:
    """Write a change of the model's file."""
    for one in _offered:
        if one.difference() == job.difference:
            one.apply()
            return Answer()
    raise InputError("nothing-offered")
