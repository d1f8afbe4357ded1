"""Errors of the package, each with a code, a place and a cure.

- kinds: the classes of errors, and the renderer that draws the carets
- files: writing of whole files, and the errors about files
- folders: locks on folders of results
- processes: worker processes, ended with all that they have started
- schema: JSON, checked against a schema
- extras: optional libraries
- settings: checks of settings, and the error about their values
- warned: warnings at the line of the user's code
- memory: free memory, and checks before a search takes more
- source: a model's file, places in it, and the syntax tree of a function object
- messages: every message by its code; `texts` has a file for each part that reports errors
- catalogue: the manual's page for each message
"""

from niwaki.errors.files import FileError
from niwaki.errors.kinds import Call, InputError, ModelError, ModelFault, NiwakiError

__all__ = ["Call", "FileError", "InputError", "ModelError", "ModelFault", "NiwakiError"]
