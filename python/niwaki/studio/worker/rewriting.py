"""Changes of the model's file: the last offers, one of which may be written."""

from __future__ import annotations

from typing import Any

from niwaki.errors import InputError
from niwaki.search.drag.source import SourceChange, as_defaults
from niwaki.studio.messages import Answer, Offer, Offered, ProposeDefaults, RewriteFile
from niwaki.studio.worker import models

_offers: list[SourceChange] = []


def offer(changes: list[SourceChange]) -> list[Offer]:
    """Offer these changes, and withdraw all earlier offers."""
    _offers[:] = changes
    return [Offer(change.description, change.difference(), not change.choices) for change in changes]


def propose(job: ProposeDefaults, send: Any) -> Answer:
    """Offer to make the arguments the defaults."""
    change = as_defaults(models.reference(job.question.model).model, job.question.arguments)
    send(Offered(job.id, offer([] if change is None else [change])))
    return Answer()


def rewrite(job: RewriteFile) -> Answer:
    """Write a change of the model's file."""
    for change in _offers:
        if change.difference() == job.difference:
            change.apply()
            return Answer()
    raise InputError("nothing-offered")
