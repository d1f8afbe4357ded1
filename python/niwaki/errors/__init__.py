"""The errors of the package, each with a code, a place and a cure.

kinds      the classes of errors, and the renderer that draws the carets
files      files that are read or written, and the errors about them
extras     libraries that may be missing
settings   values of settings, and the error about them
warned     warnings at the user's line
memory     how much memory is free, and the refusal of what needs more
source     a file of a model, the places in it, and the syntax tree of a function object
messages   every message by its code; `texts` holds them by the part that reports the error
catalogue  a page of the manual for each message
"""

from niwaki.errors.files import FileError
from niwaki.errors.kinds import Call, InputError, ModelError, ModelFault, NiwakiError

__all__ = ["Call", "FileError", "InputError", "ModelError", "ModelFault", "NiwakiError"]
