"""Writing of whole files, and errors about files (texts in `niwaki.errors.texts.files`).

A message has a code, a title, the file, the reason and the cure.
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

#: The beginning and the end of the temporary name of a file that is being written.
PART = (".niwaki-", ".part")

#: Title, reason and help by code; the raiser of an error gives values for the names in braces.
FILE_MESSAGES: dict[str, tuple[str, str, str]] = {
    message.code: (message.title, message.why, message.help) for message in FILES
}


class FileError(NiwakiError):
    """Error about a file that cannot be used.

    Parameters
    ----------
    code
        A code of `FILE_MESSAGES`.
    place
        The file, if there is one.
    values
        Values for the names in the message's templates.

    Examples
    --------
    >>> print(FileError("scene-empty", verb="draw"))
    error[scene-empty]: there is nothing to draw: the scene has no parts
     = why: only `emit` adds parts to a scene
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
    """Return whether a regular file has this name; False for a name that no file can have."""
    try:
        return place.is_file()
    except (OSError, ValueError):
        return False


def write_whole(place: Path, data: bytes, private: bool = False) -> Path:
    """Write a file so that readers see all of it or none, also after a power failure.

    The bytes go to a temporary file in the same folder, then to the disk, and then the file gets its name. Of two
    writers, in threads or processes, one wins with its whole file. After any failure the old file stays.

    Parameters
    ----------
    place
        The file. A link is followed, and an existing file keeps its permissions.
    data
        The file's bytes.
    private
        Whether the file is for this user alone: a new file replaces an old file or a link of the name, and no other
        user may read it, where the system has permissions.

    Raises
    ------
    FileError
        `file-unwritable`: no folder, no permission, a full disk, or the place is not a regular file.
    """
    with written_beside(place, data, private) as take_place:
        take_place()
    return place


def write_all(number: int, data: bytes) -> None:
    """Write all bytes to an open file, also where the system takes fewer bytes at a time."""
    left = memoryview(data)
    while left:
        left = left[os.write(number, left) :]


@contextmanager
def written_beside(place: Path, data: bytes, private: bool = False) -> Iterator[Callable[[], None]]:
    """Write a temporary file beside its place, and yield a function that moves it there in one step."""
    temporary: Path | None = None
    try:
        # The file behind a link is replaced, and the link stays. A private file replaces the link.
        real = place if private else Path(os.path.realpath(place))
        mode = None if private else _replaceable(real)
        temporary = real.with_name(f"{PART[0]}{secrets.token_hex(8)}{PART[1]}")
        # Permissions are those of any new file; `O_EXCL` refuses a file that another process created.
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
    """Check, before a long search, that a file can be written to a place.

    Raises
    ------
    FileError
        The folder does not exist, a file there is not regular or is write-protected, or the name is impossible.
    """
    try:
        if not os.path.isdir(place.parent):
            raise FileNotFoundError(errno.ENOENT, "there is no such folder")
        _replaceable(Path(os.path.realpath(place)))
    except (OSError, ValueError) as error:
        raise unwritable(place, error) from error
    return place


def _discard(temporary: Path | None) -> None:
    """Remove a temporary file that did not get its place."""
    if temporary is not None:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def sync_folder(folder: Path) -> None:
    """Flush a folder's names to the disk, where the system can."""
    if os.name == "nt":
        return
    number = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(number)
    except OSError as error:
        # Some file systems cannot flush a folder; the file itself is on the disk.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.EBADF):
            raise
    finally:
        os.close(number)


def unwritable(place: str | PathLike[str], error: Exception) -> FileError:
    """Return the error about a place that cannot be written to."""
    reason = getattr(error, "strerror", None) or str(error)
    return FileError("file-unwritable", place, reason=reason)


@contextmanager
def unreadable(place: Path, kind: str = "a file") -> Iterator[None]:
    """Turn an `OSError` of the block into the error about a place that cannot be read."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise FileError("file-unreadable", place, suffix=kind, reason=reason) from error


def ensure_folder(place: Path) -> Path:
    """Return the folder, created if it does not exist."""
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(place, error) from error
    return place


def _replaceable(place: Path) -> int | None:
    """Return the permissions of an existing file, or None without a file; refuse a file that must not be replaced."""
    try:
        status = place.stat()
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(status.st_mode):
        raise OSError(errno.EINVAL, "it is a device or a pipe, and only a regular file can be replaced")
    if not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, "the existing file is write-protected")
    return stat.S_IMODE(status.st_mode)
