"""The table of all messages, by code."""

from __future__ import annotations

from niwaki.errors.texts.advice import ADVICE
from niwaki.errors.texts.chains import CHAINS
from niwaki.errors.texts.faults import FAULTS
from niwaki.errors.texts.files import FILES
from niwaki.errors.texts.inputs import INPUTS
from niwaki.errors.texts.language import LANGUAGE
from niwaki.errors.texts.message import Message
from niwaki.errors.texts.settings import SETTINGS

MESSAGES: dict[str, Message] = {
    message.code: message for message in (*LANGUAGE, *FAULTS, *INPUTS, *FILES, *SETTINGS, *ADVICE, *CHAINS)
}

__all__ = ["ADVICE", "CHAINS", "SETTINGS", "FAULTS", "FILES", "INPUTS", "LANGUAGE", "MESSAGES", "Message"]
