"""What the shape should be like, as flags: each is one control, and controls multiply.

    --target crown.obj --avoid wall.obj --floor 0
    --match-image skyline.png --camera cam.json
    --match-image letter.png                        (models that draw in the plane)
    --match-shadow face.png --weight-image face_w.png --light -1,-0.3,0 --receiver floor.obj

Flags that contradict one another, or need another flag, are refused before any file is read.
"""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import shell, targets
from niwaki.errors import InputError

Triple = tuple[float, float, float]
Box = tuple[tuple[float, float], tuple[float, float]]

#: The longer side of a drawing when it is compared (dissertation 6.5.2, as its code has it).
PIXELS = 50


def _file(flag: str, text: str) -> Any:
    return typer.Option(flag, metavar="FILE", help=text)


TargetFile = Annotated[
    str | None, _file("--target", "A mesh to fill: OBJ, STL, PLY, GLB, or `gallery:` and a name.")
]
AvoidFiles = Annotated[list[str] | None, _file("--avoid", "A mesh to avoid; may be repeated.")]
Floor = Annotated[float | None, typer.Option("--floor", metavar="Y", help="A height to stay above.")]
Within = Annotated[
    str | None,
    typer.Option("--within", metavar="X,Y,Z,X,Y,Z", help="Low and high corner of a box to stay in; soft."),
]
ImageFile = Annotated[
    str | None,
    _file(
        "--match-image",
        "A silhouette to match, seen by --camera; for models that draw, ink on white paper, or a drawing's name.",
    ),
]
Window = Annotated[
    str | None,
    typer.Option(
        "--window",
        metavar="X,Y,X,Y",
        help="Low and high corner of what a drawing shows. Default: the model's.",
    ),
]
Pixels = Annotated[
    int | None,
    typer.Option("--pixels", metavar="N", help="Longer side of a drawing when it is compared. Default: 50."),
]
ShadowFile = Annotated[str | None, _file("--match-shadow", "A shadow to cast; needs --light and --receiver.")]
CameraFile = Annotated[
    str | None, _file("--camera", "The camera that sees the image or the shadow, a JSON file.")
]
WeightFile = Annotated[str | None, _file("--weight-image", "An image, white where a pixel counts more.")]
Weight = Annotated[
    float | None,
    typer.Option("--weight", metavar="NUMBER", help="How much more a white pixel counts. Default: 10."),
]
Light = Annotated[
    str | None, typer.Option("--light", metavar="X,Y,Z", help="The direction in which the light travels.")
]
ReceiverFile = Annotated[str | None, _file("--receiver", "A mesh that the shadow falls on.")]
Voxel = Annotated[
    float | None,
    typer.Option("--voxel", metavar="SIZE", help="Cell size. Default: depends on the model or target."),
]
Sigma = Annotated[
    float | None,
    typer.Option(
        "--sigma",
        metavar="NUMBER",
        help="Strictness of the match; smaller is stricter. Default: 0.02, drawings 0.014.",
    ),
]


@dataclass(frozen=True)
class Controls:
    """The controls as they were given; None for flags that were not given."""

    target: str | None = None
    avoid: tuple[str, ...] = ()
    floor: float | None = None
    within: str | None = None
    match_image: str | None = None
    camera: str | None = None
    match_shadow: str | None = None
    weight_image: str | None = None
    weight: float | None = None
    light: str | None = None
    receiver: str | None = None
    window: str | None = None
    pixels: int | None = None
    draws: bool = False

    def __post_init__(self) -> None:
        if self.match_image is not None and self.match_shadow is not None:
            raise InputError(
                "flags-exclude",
                flag="--match-image",
                other="--match-shadow",
                reason="both are seen by the one --camera and weighed by the one --weight-image",
                cure="multiply `match_image(...)` and `match_shadow(...)` in Python",
            )
        image, shadow = self.match_image is not None, self.match_shadow is not None
        pictures = "`--match-image` or `--match-shadow`"
        for flag, given, other, there, reason in (
            (
                "--match-image",
                image and not self.is_drawing,
                "`--camera`",
                self.camera is not None,
                "an image is seen by a camera; this model does not draw in a window of the plane",
            ),
            (
                "--window",
                self.window is not None,
                "`--match-image`",
                image,
                "it is what the image shows of the plane",
            ),
            (
                "--pixels",
                self.pixels is not None,
                "`--match-image`",
                self.is_drawing,
                "it is the size in which a drawing is compared",
            ),
            ("--match-shadow", shadow, "`--light`", self.light is not None, "a shadow needs a light"),
            (
                "--match-shadow",
                shadow,
                "`--receiver`",
                self.receiver is not None,
                "a shadow needs a receiver",
            ),
            ("--light", self.light is not None, "`--match-shadow`", shadow, "only a shadow has a light"),
            (
                "--receiver",
                self.receiver is not None,
                "`--match-shadow`",
                shadow,
                "only a shadow has a receiver",
            ),
            (
                "--camera",
                self.camera is not None,
                pictures,
                image or shadow,
                "only a picture is seen by a camera",
            ),
            (
                "--weight-image",
                self.weight_image is not None,
                pictures,
                image or shadow,
                "it weights the pixels of a picture",
            ),
            (
                "--weight",
                self.weight is not None,
                "`--weight-image`",
                self.weight_image is not None,
                "it is the weight of the white pixels",
            ),
        ):
            if given and not there:
                raise InputError("flag-alone", flag=flag, other=other, reason=reason)

    @property
    def is_drawing(self) -> bool:
        """Whether the image is a drawing in the plane, and not a silhouette seen by a camera."""
        return (
            self.match_image is not None and self.camera is None and (self.draws or self.window is not None)
        )

    def drawing(self, found: shell.references.ModelReference) -> targets.drawing.Drawing | None:
        """The drawing to follow: the one named; else the model's own."""
        if self.match_image is not None and self.is_drawing:
            return targets.drawings.find(self.match_image, self.pixels or PIXELS)
        entry = found.entry
        if (
            entry is None
            or entry.drawing_name is None
            or self.target is not None
            or self.match_image is not None
        ):
            return None
        return targets.drawings.find(entry.drawing_name)

    def page(self, found: shell.references.ModelReference) -> Box:
        """The part of the plane that a drawing shows."""
        if self.window is not None:
            x, y, right, high = numbers("--window", self.window, 4)
            return (x, y), (right, high)
        assert found.entry is not None and found.entry.window is not None
        return found.entry.window

    def aim(self, found: shell.references.ModelReference) -> nw.Target | None:
        """The volume to fill: the one named; else the model's own, unless there is a picture to match."""
        if self.target is not None:
            return nw.Target.find(self.target)
        if self.match_image is not None or self.match_shadow is not None:
            return None
        if found.entry is not None and found.entry.draws is not None:
            return None
        if found.entry is None or found.entry.target_name is None:
            raise InputError("no-target", name=found.reference)
        return nw.Target.find(f"gallery:{found.entry.target_name}")

    def score(
        self, found: shell.references.ModelReference, voxel: float | None, sigma: float | None
    ) -> nw.Score:
        """Everything but the volume; sketches that forbid scenes come first."""
        score = nw.Score()
        strict = {} if sigma is None else {"sigma": sigma}
        drawing = self.drawing(found)
        if drawing is not None:
            score *= drawing.score(self.page(found), **strict)
        elif found.entry is not None and found.entry.score is not None and self.aim(found) is None:
            score *= found.entry.score()
        if self.floor is not None:
            score *= nw.floor(self.floor)
        for obstacle in self.avoid:
            score *= nw.avoid(obstacle, voxel)
        weigh = {} if self.weight is None else {"weight": self.weight}
        if self.match_image is not None and not self.is_drawing:
            assert self.camera is not None
            score *= nw.match_image(
                self.match_image, self.camera, weight_image=self.weight_image, **strict, **weigh
            )
        if self.match_shadow is not None:
            assert self.light is not None and self.receiver is not None
            score *= nw.match_shadow(
                self.match_shadow,
                numbers("--light", self.light, 3),
                self.receiver,
                self.camera,
                weight_image=self.weight_image,
                **strict,
                **weigh,
            )
        if self.within is not None:
            score *= nw.overshoot(_box("--within", self.within), **strict)
        return score


def follows(model: nw.Model[..., Any]) -> bool:
    """Whether a model starts where a drawing does: its parameters are x, y and ahead."""
    return set(inspect.signature(model.function).parameters) >= {"x", "y", "ahead"}


def numbers(flag: str, text: str, count: int) -> tuple[float, ...]:
    """Numbers with commas between them."""
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        found = ()
    if len(found) != count:
        example = {6: "-5,0,-5,5,10,5", 4: "-12,-2,12,22"}.get(count, "-1,-0.3,0")
        raise InputError(
            "bad-setting",
            name=flag,
            found=repr(text),
            expected=f"{count} numbers with commas between them",
            suggestion=f"such numbers, for instance {example}",
        )
    return found


def _box(flag: str, text: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The low and the high corner of a box."""
    found = numbers(flag, text, 6)
    low, high = found[:3], found[3:]
    if not all(a < b for a, b in zip(low, high, strict=True)):
        raise InputError(
            "bad-setting",
            name=flag,
            found=repr(text),
            expected="a low corner, then one that is higher along x, y and z",
            suggestion="such a box, for instance -5,0,-5,5,10,5",
        )
    return low, high
