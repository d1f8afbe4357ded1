"""Cameras as values: the views of images to match, written in Python or in a JSON file.

camera = Camera.perspective((31, 2, 33), look_at=(-3, 5, 0))
camera = Camera.load("cam.json")      # {"kind": "perspective", "position": [31, 2, 33], "look_at": [-3, 5, 0]}
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot, radians
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.errors.files import write_whole
from niwaki.errors.settings import shown
from niwaki.inputs import text_of
from niwaki.inputs.texts import json_of

Triple = tuple[float, float, float]

#: The parameters of each kind of camera, with their defaults (None: must be given).
KINDS: dict[str, dict[str, float | None]] = {
    "perspective": {"fov_degrees": 45.0, "near": 0.1},
    "orthographic": {"height": None},
}


#: No coordinate is farther from 0: products of three stay finite.
FARTHEST = 1e100


@dataclass(frozen=True)
class Camera:
    """A camera in right-handed coordinates. Lengths are in scene units.

    Parameters
    ----------
    kind
        "perspective" or "orthographic".
    position
        Its position. An orthographic camera sees everything in front of the plane through this point, across its view.
    look_at
        The point in the middle of the picture.
    up
        The approximate direction of up in the picture.
    fov_degrees
        Perspective: vertical field of view.
    near
        Perspective: the distance along the view from which it sees.
    height
        Orthographic: the height of the picture, scene units.

    Examples
    --------
    >>> Camera.from_dict({"kind": "orthographic", "position": [0, 10, 0], "look_at": [0, 0, 0],
    ...                   "up": [0, 0, -1], "height": 27.3}).height
    27.3
    """

    kind: str
    position: Triple
    look_at: Triple
    up: Triple = (0.0, 1.0, 0.0)
    fov_degrees: float = 45.0
    near: float = 0.1
    height: float = 0.0

    def __post_init__(self) -> None:
        _check_kind(self.kind)
        for name in ("position", "look_at", "up"):
            object.__setattr__(self, name, _triple(name, getattr(self, name)))
        for name in KINDS[self.kind]:
            object.__setattr__(self, name, _number(name, getattr(self, name)))
        if self.kind == "perspective" and not 0 < self.fov_degrees < 180:
            raise InputError(
                "bad-camera",
                reason=f"`fov_degrees` is {self.fov_degrees:g}, expected more than 0 and less than 180",
            )
        for name in ("near",) if self.kind == "perspective" else ("height",):
            if getattr(self, name) <= 0:
                reason = f"`{name}` is {getattr(self, name):g}, expected a number above 0"
                raise InputError("bad-camera", reason=reason)
        view = _minus(self.look_at, self.position)
        if not any(view):
            raise InputError("bad-camera", reason=f"its position is its look_at: {self.position}")
        across = _cross(view, self.up)
        if _length(across) <= 1e-9 * _length(view) * _length(self.up):
            raise InputError(
                "bad-camera",
                reason=f"`up` is {self.up}, which is the direction of view; looking straight down, write (0, 0, -1)",
            )

    @classmethod
    def perspective(
        cls,
        position: Sequence[float],
        look_at: Sequence[float],
        up: Sequence[float] = (0.0, 1.0, 0.0),
        fov_degrees: float = 45.0,
        near: float = 0.1,
    ) -> Camera:
        """Make a camera whose rays start at its position."""
        return cls("perspective", position, look_at, up, fov_degrees, near)  # type: ignore[arg-type]

    @classmethod
    def orthographic(
        cls,
        position: Sequence[float],
        look_at: Sequence[float],
        up: Sequence[float] = (0.0, 1.0, 0.0),
        *,
        height: float,
    ) -> Camera:
        """Make a camera whose rays are parallel and whose picture shows `height` scene units."""
        return cls("orthographic", position, look_at, up, height=height)  # type: ignore[arg-type]

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Camera:
        """Read a camera from a JSON file.

        Raises
        ------
        FileError
            The file is missing or no JSON.
        InputError
            `bad-camera`: a name is missing or unknown, or a value makes no camera.
        """
        content = "a camera in JSON"
        return cls.from_dict(json_of(text_of(path, "camera", content), path, content), name=str(path))

    @classmethod
    def from_dict(cls, data: Any, name: str = "") -> Camera:
        """Make a camera from the content of its JSON; `name` is the file's, for messages."""
        if not isinstance(data, Mapping):
            raise InputError(
                "bad-camera", reason=f"found {type(data).__name__}, expected names and values", detail=name
            )
        kind = data.get("kind", "perspective")
        _check_kind(kind, name)
        settings = KINDS[kind]
        known = ("kind", "position", "look_at", "up", *settings)
        if unknown := [key for key in data if key not in known]:
            reason = f"there is no `{unknown[0]!s:.40}` in it; {kind} cameras have {', '.join(known)}"
            raise InputError("bad-camera", reason=reason, detail=name)
        required = ["position", "look_at", *(key for key, default in settings.items() if default is None)]
        if missing := [key for key in required if key not in data]:
            raise InputError("bad-camera", reason=f"`{missing[0]}` is missing", detail=name)
        try:
            return cls(**{**data, "kind": kind})
        except InputError as error:
            error.values["detail"] = name
            raise

    @classmethod
    def of(cls, camera: Camera | str | PathLike[str] | Mapping[str, Any]) -> Camera:
        """Return a camera as it is, or make one from a file or from names and values."""
        if isinstance(camera, Camera):
            return camera
        if isinstance(camera, (str, PathLike)):
            return cls.load(camera)
        return cls.from_dict(camera)

    def to_dict(self) -> dict[str, Any]:
        """Return names and values, as in the JSON file."""
        names = ("position", "look_at", "up", *KINDS[self.kind])
        values = {name: getattr(self, name) for name in names}
        return {"kind": self.kind} | {k: list(v) if isinstance(v, tuple) else v for k, v in values.items()}

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the JSON file."""
        return write_whole(Path(path), (json.dumps(self.to_dict(), indent=2) + "\n").encode())

    def lens(self) -> tuple[Triple, Triple, Triple, bool, float, float]:
        """Return the engine's arguments: position, look_at, up, perspective?, radians or height, near."""
        perspective = self.kind == "perspective"
        number = radians(self.fov_degrees) if perspective else self.height
        return (self.position, self.look_at, self.up, perspective, number, self.near)


def _check_kind(kind: Any, name: str = "") -> None:
    if not isinstance(kind, str) or kind not in KINDS:
        expected = " or ".join(f'"{known}"' for known in KINDS)
        raise InputError("bad-camera", reason=f"its kind is {shown(kind)}, expected {expected}", detail=name)


def _triple(name: str, value: Any) -> Triple:
    try:
        x, y, z = (_number(name, number) for number in value)
    except (TypeError, ValueError):
        raise InputError("bad-camera", reason=f"`{name}` is {shown(value)}, expected three numbers") from None
    return (x, y, z)


def _number(name: str, value: Any) -> float:
    # Products of coordinates stay finite; whole numbers of any length can be compared.
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not -FARTHEST <= value <= FARTHEST:
        reason = f"`{name}` has {shown(value)}, expected a finite number, at most {FARTHEST:g}"
        raise InputError("bad-camera", reason=reason)
    return float(value)


def _minus(a: Triple, b: Triple) -> Triple:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _cross(a: Triple, b: Triple) -> Triple:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _length(a: Triple) -> float:
    return hypot(*a)
