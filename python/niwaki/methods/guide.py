"""Guides as values: small networks that draw choices in place of the prior, and their files."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.files import write_whole
from niwaki.inputs import bytes_of
from niwaki.once import cached_property


class Guide:
    """Trained guide (dissertation chapter 6).

    A guide sees the variables in scope at a choice, the parameters of the choice's prior, and the surroundings of the
    current place in target and scene. The choice is drawn from the guide's distribution. Weights correct for the
    difference, so a search is right with any guide, and needs fewer particles with a good one.

    Parameters
    ----------
    data
        The bytes of a guide's file.

    See Also
    --------
    niwaki.train_guide : trains a guide.
    """

    def __init__(self, data: bytes) -> None:
        try:
            self._engine = _engine.Guide(data)
        except _engine.EngineFault as fault:
            raise InputError("bad-guide", detail=fault.message.removeprefix("this is no guide: ")) from None
        self._data = data

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Guide:
        """Read a guide from a file.

        Raises
        ------
        InputError
            The file is no guide, damaged, or of another format.
        FileError
            The file is missing, no regular file, or too large.
        """
        data = bytes_of(path, "guide")
        try:
            return cls(data)
        except InputError as error:
            raise InputError("bad-guide", detail=f"in `{path}`: {error.values['detail']}") from None

    def save(self, path: str | PathLike[str]) -> None:
        """Write the guide to a file, whole or not at all (safetensors)."""
        write_whole(Path(path), self.data)

    @property
    def data(self) -> bytes:
        """The bytes of its file."""
        return self._data

    @cached_property
    def hash(self) -> str:
        """SHA-256 of its bytes, in hexadecimal."""
        return hashlib.sha256(self._data).hexdigest()

    @cached_property
    def form(self) -> Mapping[str, Any]:
        """Its inputs and the choices that it draws, as plain data."""
        form: dict[str, Any] = json.loads(self._engine.form())
        return form

    @property
    def report(self) -> Mapping[str, Any]:
        """Its training data, and its scores on held-out data."""
        report: Mapping[str, Any] = self.form["report"]
        return report

    @property
    def model(self) -> str:
        """The name of its model."""
        name: str = self.form["model"]
        return name

    @property
    def looks_ahead(self) -> bool:
        """Whether the guide has learned to look ahead (`niwaki.guides.train_look_ahead`)."""
        return self.form.get("ahead") is not None

    def with_report(self, report: Mapping[str, Any]) -> Guide:
        """Copy the guide with another report."""
        return Guide(self._engine.with_report(json.dumps(report)).data())

    def __eq__(self, other: object) -> bool:
        return self.data == other.data if isinstance(other, Guide) else NotImplemented

    def __hash__(self) -> int:
        return int(self.hash[:15], 16)

    def __reduce__(self) -> tuple[Any, ...]:
        return Guide, (self.data,)

    def __repr__(self) -> str:
        return f"<guide of {self.model}: {len(self.form['sites'])} choices, {self._engine.weights()} weights>"

    def show(self) -> str:
        """Describe the inputs of each choice, as text."""
        form, inputs = self.form, self._engine.inputs()
        weights, share = self._engine.weights(), form["share"]
        lines = [f"guide of {form['model']}: {weights} weights, a share of {share} is the prior's"]
        for name, window in form["windows"]:
            points = window["points"]
            reach = max(sum(x * x for x in point["at"]) ** 0.5 for point in points)
            lines.append(
                f"window of {name}: {len(points)} points around the current place, up to {reach:.3g} units away"
            )
        if form.get("image"):
            lines.append(
                f"the page of {form['image']['sketch']}: windows of 3 by 3 in four resolutions, position, direction"
            )
        if form.get("part") is not None:
            lines.append(
                "the current place is a frame in scope, or else the middle of the last part, whose box it reads"
            )
        for site in form["sites"]:
            lines.append(
                f"{site['function']}/{site['label']}: {_family(site)}, {site['visits']} in the traces"
            )
            variables = [form["variables"][number] for number in site["variables"]]
            names = [
                name for variable in variables for name in _names(inputs, variable["first"], variable["kind"])
            ]
            lines.append(f"    sees {', '.join(names) or 'no variable'}")
        if self.looks_ahead:
            low, high = form["ahead"]["range"]
            lines.append(f"looks ahead: what a paused run will still gain, {low:.3g} to {high:.3g} nats")
        lines.extend(f"{name}: drawn from its prior, because {reason}" for name, reason in form["left"])
        return "\n".join(lines)


def _family(site: Mapping[str, Any]) -> str:
    """Describe the distribution of a choice."""
    ((kind, settings),) = site["head"].items()
    if kind == "Finite":
        return f"{site['family']}, one of {settings['values']} values"
    mixture = "a mixture" if kind == "Normal" else "a mixture over whole numbers"
    return f"{site['family']}, {mixture} of {settings['components']}"


def _names(inputs: list[str], first: int, kind: Any) -> list[str]:
    """Names of the inputs of a variable, without its function."""
    return [name.split(":", 1)[-1] for name in inputs[first : first + _size(kind)]]


def _size(kind: Any) -> int:
    """The number of inputs of a variable of a kind."""
    if isinstance(kind, str):
        return {"number": 1, "angle": 2}.get(kind, 0)
    ((name, form),) = kind.items()
    match name:
        case "point":
            return 2 * int(form["numbers"])
        case "parts":
            return sum(_size(part) for _, part in form)
        case "list":
            return 1 + _size(form)
        case _:
            return len(form)
