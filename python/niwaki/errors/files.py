"""Files that are read or written, and the errors about them; their texts are in `niwaki.errors.texts.files`.

A message has a code, a title, the file it is about, the reason and the cure.
"""

from __future__ import annotations

import errno
import os
import secrets
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.errors.kinds import NiwakiError
from niwaki.errors.texts.files import FILES

#: How the name of a file begins and ends while it is written.
PART = (".niwaki-", ".part")

#: code: (title, why, help); the names in braces are filled in where the error is raised.
FILE_MESSAGES: dict[str, tuple[str, str, str]] = {
    message.code: (message.title, message.why, message.help) for message in FILES
}


class FileError(NiwakiError):
    """A file cannot be used.

    Parameters
    ----------
    code
        A code of `FILE_MESSAGES`.
    place
        The file, if there is one.
    values
        What the message's templates name.

    Examples
    --------
    >>> print(FileError("scene-empty", verb="draw"))
    error[scene-empty]: there is nothing to draw
     = why: the scene has no parts
     = help: let the model `emit` at least one shape
    """

    def __init__(self, code: str, place: str | PathLike[str] | None = None, **values: Any) -> None:
        super().__init__(code)
        self.code = code
        self.place = place
        self.values = values

    def render(self) -> str:
        """Return the whole message: title, file, reason, cure."""
        title, why, cure = (text.format_map(self.values) for text in FILE_MESSAGES[self.code])
        lines = [f"error[{self.code}]: {title}"]
        if self.place is not None:
            lines.append(f"  --> {self.place}")
        return "\n".join([*lines, f" = why: {why}", f" = help: {cure}"])


def is_file(place: Path) -> bool:
    """Whether there is a regular file; a name that no file can have is none."""
    try:
        return place.is_file()
    except (OSError, ValueError):
        return False


def write_whole(place: Path, data: bytes, private: bool = False) -> Path:
    """Write a file so that readers see all of it or none, also after the power fails.

    The bytes go to a file of their own in the same folder, to the disk, and then take the name. So of two writers, in
    threads or in processes, one leaves its file. Where anything fails the file that was there stays.

    Parameters
    ----------
    place
        The file. A link is followed, and a file that is there keeps its permissions.
    data
        Its bytes.
    private
        Whether the file is for this user alone: a new file takes the place of whatever has the name, also of a link,
        and where the system has permissions nobody else may read it.

    Raises
    ------
    FileError
        `file-unwritable`: no folder, no permission, no room, or the place is not a regular file.
    """
    with written_beside(place, data, private) as take_place:
        take_place()
    return place


def write_all(number: int, data: bytes) -> None:
    """Write all bytes to an open file: the system may take fewer at a time."""
    left = memoryview(data)
    while left:
        left = left[os.write(number, left) :]


@contextmanager
def written_beside(place: Path, data: bytes, private: bool = False) -> Iterator[Callable[[], None]]:
    """Write a file beside its place, on the disk; the function that is given puts it there, in one step."""
    temporary: Path | None = None
    try:
        # A link keeps pointing to the file: what it points to is replaced, not the link. A private file replaces it.
        real = place if private else Path(os.path.realpath(place))
        mode = None if private else _replaceable(real)
        temporary = real.with_name(f"{PART[0]}{secrets.token_hex(8)}{PART[1]}")
        # The system gives the permissions that it gives to any new file; `O_EXCL`: the file is ours alone.
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
        number = os.open(temporary, flags, 0o600 if private else 0o666)
        with os.fdopen(number, "wb") as file:
            if mode is not None:
                os.chmod(temporary, mode)
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
    except BaseException as error:
        _discard(temporary)
        if isinstance(error, (OSError, ValueError)):
            raise unwritable(place, error) from error
        raise

    def take_place() -> None:
        try:
            os.replace(temporary, real)
            sync_folder(real.parent)
        except OSError as error:
            raise unwritable(place, error) from error

    try:
        yield take_place
    finally:
        _discard(temporary)


def check_place(place: Path) -> Path:
    """Refuse, before the work, a place where no file can be written.

    Raises
    ------
    FileError
        There is no such folder; what is there is no regular file, or write-protected; or no file can have the name.
    """
    try:
        if not os.path.isdir(place.parent):
            raise FileNotFoundError(errno.ENOENT, "there is no such folder")
        _replaceable(Path(os.path.realpath(place)))
    except (OSError, ValueError) as error:
        raise unwritable(place, error) from error
    return place


def _discard(temporary: Path | None) -> None:
    """Remove a file that did not get its place."""
    if temporary is not None:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def sync_folder(folder: Path) -> None:
    """Bring the names of a folder to the disk, where the system can."""
    if os.name == "nt":
        return
    number = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(number)
    except OSError as error:
        # Some file systems cannot do this to a folder; the file itself is on the disk.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.EBADF):
            raise
    finally:
        os.close(number)


def unwritable(place: str | PathLike[str], error: Exception) -> FileError:
    """The error about a place that cannot be written to."""
    reason = getattr(error, "strerror", None) or str(error)
    return FileError("file-unwritable", place, reason=reason)


@contextmanager
def unreadable(place: Path, what: str = "a file") -> Iterator[None]:
    """What the system says inside, as the error about a place that cannot be read."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise FileError("file-unreadable", place, suffix=what, reason=reason) from error


def ensure_folder(place: Path) -> Path:
    """The folder, created if it does not exist."""
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(place, error) from error
    return place


def _replaceable(place: Path) -> int | None:
    """The permissions of the file that is there, None where there is none; an error where it must not be replaced."""
    try:
        found = place.stat()
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(found.st_mode):
        raise OSError(errno.EINVAL, "it is a device or a pipe, and only regular files are replaced")
    if not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, "the file that is there is write-protected")
    return stat.S_IMODE(found.st_mode)
