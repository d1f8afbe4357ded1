"""What is asked of the regions of a drawing; a small TOML file.

    background = "sky"                            # one region; else the one that holds the picture's edge
    lightness = [["wall", "wall-shade", "ink"]]   # each about 15 units of CIELAB lightness above the next
    lighter = [["wall", "roof"]]                  # each at least 12 units above the next
    same-chroma = [["wall", "wall-shade"]]        # shades of one colour: equal a and b

    [pinned]
    ink = "#1a1a2e"                               # a colour that is not to change
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.color.drawing import OWN
from niwaki.file_errors import FileError

CHAINS = {"lightness": "lightness", "lighter": "lighter", "same-chroma": "same_chroma"}


@dataclass(frozen=True)
class Rule:
    """One rule about two regions.

    Attributes
    ----------
    kind : str
        "lightness", "lighter" or "same-chroma".
    first, second : str
        The regions; the lighter one first.
    """

    kind: str
    first: str
    second: str

    def __str__(self) -> str:
        if self.kind == "same-chroma":
            return f"`{self.first}` and `{self.second}` are shades of one colour"
        much = f"{STEP:.0f} units" if self.kind == "lightness" else f"at least {LEAST:.0f} units"
        return f"`{self.first}` is {much} lighter than `{self.second}`"


#: Units of CIELAB lightness between neighbours in a `lightness` chain (dissertation appendix B.1), a `lighter` one.
STEP, LEAST = 15.0, 12.0


@dataclass(frozen=True)
class Rules:
    """Rules about the regions of a drawing, by their names.

    Attributes
    ----------
    lightness, lighter, same_chroma : list of list of str
        Chains of regions; a rule holds between each and the next.
    background : str or None
        The region that the others lie on; None for the one that holds the picture's edge.
    pinned : dict of str to str
        Colours that do not change, `#rrggbb` by region.
    place : path or None
        Where they were read from, for messages.

    Examples
    --------
    >>> rules = Rules(lightness=[["wall", "shade", "ink"]], pinned={"ink": "#1a1a2e"})
    >>> [str(rule) for rule in rules][1]
    '`shade` is 15 units lighter than `ink`'
    """

    lightness: Sequence[Sequence[str]] = ()
    lighter: Sequence[Sequence[str]] = ()
    same_chroma: Sequence[Sequence[str]] = ()
    background: str | None = None
    pinned: dict[str, str] = field(default_factory=dict)
    place: str | Path | None = None

    @classmethod
    def load(cls, place: str | PathLike[str]) -> Rules:
        """Rules from a TOML file, or those of one of our own drawings by name."""
        path = Path(place)
        if not path.exists() and (OWN / f"{place}.toml").is_file():
            path = OWN / f"{place}.toml"
        if not path.is_file():
            raise FileError("file-missing", place, absolute=path.absolute(), folder=Path.cwd())
        try:
            data = tomllib.loads(path.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise FileError("file-unreadable", path, suffix=".toml", reason=str(error)) from error
        return cls.of(data, path)

    @classmethod
    def of(cls, data: dict[str, Any], place: str | Path | None = None) -> Rules:
        """Rules from the tables of a TOML file."""
        known = [*CHAINS, "background", "pinned"]
        for key, value in data.items():
            if key not in known:
                near = get_close_matches(key, known, n=1)
                raise FileError(
                    "rules-unclear",
                    place,
                    reason=f"`{key}` is no rule" + (f"; did you mean `{near[0]}`?" if near else ""),
                )
            if key in CHAINS and not _is_chains(value):
                raise FileError(
                    "rules-unclear", place, reason=f"`{key}` is not a list of chains of two regions or more"
                )
        background, pinned = data.get("background"), data.get("pinned", {})
        if background is not None and not isinstance(background, str):
            raise FileError("rules-unclear", place, reason="`background` is not the name of one region")
        if not isinstance(pinned, dict):
            raise FileError("rules-unclear", place, reason="`pinned` is not a table of colours by region")
        for name, value in pinned.items():
            if not isinstance(value, str) or not re.fullmatch(r"#[0-9a-fA-F]{6}", value):
                raise FileError(
                    "rules-unclear", place, reason=f"`{name}` is pinned to {value!r}, not to a `#rrggbb`"
                )
        chains = {field_: data.get(key, []) for key, field_ in CHAINS.items()}
        return cls(**chains, background=background, pinned=pinned, place=place)

    def __iter__(self) -> Iterator[Rule]:
        """The rules about two regions, one for each neighbouring pair of each chain."""
        for kind, name in CHAINS.items():
            for chain in getattr(self, name):
                for first, second in zip(chain, chain[1:], strict=False):
                    yield Rule(kind, first, second)

    def check(self, names: Sequence[str]) -> None:
        """Refuse rules that name no region of a drawing, and rules that cannot hold together.

        Raises
        ------
        FileError
            `rules-no-region` with the name, or `rules-contradict` with the rules.
        """
        used = [one for rule in self for one in (rule.first, rule.second)]
        used += [self.background] if self.background is not None else []
        for name in [*used, *self.pinned]:
            if name not in names:
                near = get_close_matches(name, names, n=1)
                reason = f"did you mean `{near[0]}`?" if near else f"it has {', '.join(names)}"
                raise FileError("rules-no-region", self.place, name=name, reason=reason)
        from niwaki.color.agree import contradiction

        found = contradiction(self)
        if found:
            raise FileError("rules-contradict", self.place, rules="; ".join(found))


def _is_chains(value: Any) -> bool:
    return isinstance(value, list) and all(
        isinstance(chain, list) and len(chain) >= 2 and all(isinstance(one, str) for one in chain)
        for chain in value
    )
