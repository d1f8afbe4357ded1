"""Rules about the regions of a drawing; a small TOML file.

An example of a file:

    background = "sky"                            # without this line: the region at the picture's edge
    lightness = [["wall", "wall-shade", "ink"]]   # each about 15 units of CIELAB lightness above the next
    lighter = [["wall", "roof"]]                  # each at least 12 units above the next
    same-chroma = [["wall", "wall-shade"]]        # shades of one colour: equal a and b
    same-hue = [["roof", "door"]]                 # one hue, strong or pale

    [muted]                                       # largest distance from grey, CIELAB units
    all = 60                                      # regions without a number of their own
    sky = 30

    [held]
    ink = "#1a1a2e"                               # a colour that does not change
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.color.consistency import contradiction
from niwaki.color.drawing import example_or_file
from niwaki.color.rule import Rule
from niwaki.errors import FileError
from niwaki.errors.settings import shown
from niwaki.inputs import text_of
from niwaki.inputs.limits import check
from niwaki.inputs.texts import toml_of

CHAINS = {
    "lightness": "lightness",
    "lighter": "lighter",
    "same-chroma": "same_chroma",
    "same-hue": "same_hue",
}


@dataclass(frozen=True)
class Rules:
    """Rules about the regions of a drawing.

    Attributes
    ----------
    lightness, lighter, same_chroma, same_hue : list of list of str
        Chains of regions; a rule holds between each region and the next.
    muted : dict of str to float
        The largest distance from grey by region, CIELAB units; `all` for regions without their own number.
    background : str or None
        The region behind all other regions; None for the region at the picture's edge.
    held : dict of str to str
        Colours that do not change, `#rrggbb` by region.
    place : path or None
        The file that was read, for messages.

    Examples
    --------
    >>> rules = Rules(lightness=[["wall", "shade", "ink"]], held={"ink": "#1a1a2e"})
    >>> [str(rule) for rule in rules][1]
    '`shade` is 15 units lighter than `ink`'
    """

    lightness: Sequence[Sequence[str]] = ()
    lighter: Sequence[Sequence[str]] = ()
    same_chroma: Sequence[Sequence[str]] = ()
    same_hue: Sequence[Sequence[str]] = ()
    muted: dict[str, float] = field(default_factory=dict)
    background: str | None = None
    held: dict[str, str] = field(default_factory=dict)
    place: str | Path | None = None

    @classmethod
    def load(cls, place: str | PathLike[str]) -> Rules:
        """Load rules from a TOML file, or the rules of a drawing of the package by its name."""
        path = example_or_file(place, ".toml")
        data = toml_of(text_of(path, "rules", ".toml"), path)
        return cls.of(data, path)

    @classmethod
    def of(cls, data: dict[str, Any], place: str | Path | None = None) -> Rules:
        """Read rules from the tables of a TOML file."""
        # In the first files the table `held` had the name `pinned`.
        data = {
            "held" if key == "pinned" and "held" not in data else key: value for key, value in data.items()
        }
        chained = [value for value in data.values() if isinstance(value, list)]
        named = sum(len(chain) for value in chained for chain in value if isinstance(chain, list))
        check("rule-regions", named, place)
        known = [*CHAINS, "background", "muted", "held"]
        for key, value in data.items():
            if key not in known:
                near = get_close_matches(key, known, n=1)
                raise FileError(
                    "rules-unclear",
                    place,
                    reason=f"`{key:.80}` is not a rule" + (f"; did you mean `{near[0]}`?" if near else ""),
                )
            if key in CHAINS and not _is_chains(value):
                raise FileError(
                    "rules-unclear", place, reason=f"`{key}` is not a list of chains of two regions or more"
                )
        background = data.get("background")
        muted, held = data.get("muted", {}), data.get("held", {})
        if background is not None and not isinstance(background, str):
            raise FileError("rules-unclear", place, reason="`background` is not the name of one region")
        if not isinstance(muted, dict):
            raise FileError("rules-unclear", place, reason="`muted` is not a table of numbers by region")
        for name, most in muted.items():
            if isinstance(most, bool) or not isinstance(most, int | float) or not 0 <= most <= 200:
                raise FileError(
                    "rules-unclear",
                    place,
                    reason=f"`{name:.80}` is muted to {shown(most)}, which is not a number from 0 to 200",
                )
        if not isinstance(held, dict):
            raise FileError("rules-unclear", place, reason="`held` is not a table of colours by region")
        for name, value in held.items():
            if not isinstance(value, str) or not re.fullmatch(r"#[0-9a-fA-F]{6}", value):
                raise FileError(
                    "rules-unclear",
                    place,
                    reason=f"`{name:.80}` is held at {shown(value)}, which is not a colour `#rrggbb`",
                )
        chains = {field_: data.get(key, []) for key, field_ in CHAINS.items()}
        return cls(**chains, muted=muted, background=background, held=held, place=place)

    def __iter__(self) -> Iterator[Rule]:
        """Go through the rules: each neighbouring pair of each chain, then the muted regions."""
        for kind, name in CHAINS.items():
            for chain in getattr(self, name):
                for first, second in zip(chain, chain[1:], strict=False):
                    yield Rule(kind, first, second)
        for name, most in self.muted.items():
            if name != "all":
                yield Rule("muted", name, most=most)

    def toml(self) -> str:
        """Write the rules as the text of a file, which `load` reads."""
        lines = [] if self.background is None else [f"background = {_quoted(self.background)}"]
        for key, name in CHAINS.items():
            if chains := getattr(self, name):
                rows = "".join(f"  {_quoted(list(chain))},\n" for chain in chains)
                lines.append(f"{key} = [\n{rows}]")
        for key in ("muted", "held"):
            if table := getattr(self, key):
                lines.append(f"\n[{key}]")
                lines += [f"{_quoted(name)} = {_quoted(value)}" for name, value in table.items()]
        return "\n".join([*lines, ""])

    def on(self, names: Sequence[str]) -> Iterator[Rule]:
        """Go through the rules on these regions: `all` becomes a rule for each region without its own number."""
        yield from self
        if "all" in self.muted:
            for name in names:
                if name not in self.muted and name not in self.held:
                    yield Rule("muted", name, most=self.muted["all"])

    def check(self, names: Sequence[str]) -> None:
        """Check that the rules name regions of a drawing and can hold together.

        Raises
        ------
        FileError
            `rules-no-region` with the name, or `rules-contradict` with the rules.
        """
        used = [name for rule in self for name in (rule.first, rule.second) if name]
        used += [self.background] if self.background is not None else []
        for name in [*used, *self.held]:
            if name not in names:
                near = get_close_matches(name, names, n=1)
                reason = f"did you mean `{near[0]}`?" if near else f"it has {', '.join(names)}"
                raise FileError("rules-no-region", self.place, name=name, reason=reason)
        conflict = contradiction(self)
        if conflict:
            raise FileError("rules-contradict", self.place, rules="; ".join(conflict))


def _is_chains(value: Any) -> bool:
    return isinstance(value, list) and all(
        isinstance(chain, list) and len(chain) >= 2 and all(isinstance(name, str) for name in chain)
        for chain in value
    )


def _quoted(value: Any) -> str:
    """Write a text, a number or a list of texts in TOML."""
    return json.dumps(value, ensure_ascii=False)
