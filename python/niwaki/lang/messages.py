"""The one table of all messages, by code."""

from __future__ import annotations

from niwaki.lang.texts.advice import ADVICE
from niwaki.lang.texts.chains import CHAINS
from niwaki.lang.texts.doors import DOORS
from niwaki.lang.texts.faults import FAULTS
from niwaki.lang.texts.files import FILES
from niwaki.lang.texts.inputs import INPUTS
from niwaki.lang.texts.language import LANGUAGE
from niwaki.lang.texts.message import Message

MESSAGES: dict[str, Message] = {
    message.code: message for message in (*LANGUAGE, *FAULTS, *INPUTS, *FILES, *DOORS, *ADVICE, *CHAINS)
}

__all__ = ["ADVICE", "CHAINS", "DOORS", "FAULTS", "FILES", "INPUTS", "LANGUAGE", "MESSAGES", "Message"]
