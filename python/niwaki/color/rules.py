"""Rules about the regions of a drawing; a small TOML file.

background = "sky"                            # one region; else the one that holds the picture's edge
lightness = [["wall", "wall-shade", "ink"]]   # each about 15 units of CIELAB lightness above the next
lighter = [["wall", "roof"]]                  # each at least 12 units above the next
same-chroma = [["wall", "wall-shade"]]        # shades of one colour: equal a and b
same-hue = [["roof", "door"]]                 # strong or pale, but of one hue

[muted]                                       # how far from grey, most; CIELAB units
all = 60                                      # what has no number of its own
sky = 30

[held]
ink = "#1a1a2e"                               # a colour that is not to change
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

from niwaki.color.agree import contradiction
from niwaki.color.drawing import own
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
    """Rules about the regions of a drawing, by their names.

    Attributes
    ----------
    lightness, lighter, same_chroma, same_hue : list of list of str
        Chains of regions; a rule holds between each and the next.
    muted : dict of str to float
        How far from grey a region may be, CIELAB units; `all` for those without their own number.
    background : str or None
        The region that the others lie on; None for the one that holds the picture's edge.
    held : dict of str to str
        Colours that do not change, `#rrggbb` by region.
    place : path or None
        Where they were read from, for messages.

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
        """Rules from a TOML file, or those of one of our own drawings by name."""
        path = own(place, ".toml")
        data = toml_of(text_of(path, "rules", ".toml"), path)
        return cls.of(data, path)

    @classmethod
    def of(cls, data: dict[str, Any], place: str | Path | None = None) -> Rules:
        """Rules from the tables of a TOML file."""
        # The table `held` was `pinned` in the first files.
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
                    reason=f"`{key:.80}` is no rule" + (f"; did you mean `{near[0]}`?" if near else ""),
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
                    reason=f"`{name:.80}` is muted to {shown(most)}, not to a number from 0 to 200",
                )
        if not isinstance(held, dict):
            raise FileError("rules-unclear", place, reason="`held` is not a table of colours by region")
        for name, value in held.items():
            if not isinstance(value, str) or not re.fullmatch(r"#[0-9a-fA-F]{6}", value):
                raise FileError(
                    "rules-unclear",
                    place,
                    reason=f"`{name:.80}` is held at {shown(value)}, not to a `#rrggbb`",
                )
        chains = {field_: data.get(key, []) for key, field_ in CHAINS.items()}
        return cls(**chains, muted=muted, background=background, held=held, place=place)

    def __iter__(self) -> Iterator[Rule]:
        """The rules one by one: one for each neighbouring pair of each chain, those of single regions last."""
        for kind, name in CHAINS.items():
            for chain in getattr(self, name):
                for first, second in zip(chain, chain[1:], strict=False):
                    yield Rule(kind, first, second)
        for name, most in self.muted.items():
            if name != "all":
                yield Rule("muted", name, most=most)

    def toml(self) -> str:
        """The rules as a file, which `load` reads."""
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
        """The rules on a drawing of these regions: `all` becomes a rule for each region without its own."""
        yield from self
        if "all" in self.muted:
            for name in names:
                if name not in self.muted and name not in self.held:
                    yield Rule("muted", name, most=self.muted["all"])

    def check(self, names: Sequence[str]) -> None:
        """Refuse rules that name no region of a drawing, and rules that cannot hold together.

        Raises
        ------
        FileError
            `rules-no-region` with the name, or `rules-contradict` with the rules.
        """
        used = [one for rule in self for one in (rule.first, rule.second) if one]
        used += [self.background] if self.background is not None else []
        for name in [*used, *self.held]:
            if name not in names:
                near = get_close_matches(name, names, n=1)
                reason = f"did you mean `{near[0]}`?" if near else f"it has {', '.join(names)}"
                raise FileError("rules-no-region", self.place, name=name, reason=reason)
        found = contradiction(self)
        if found:
            raise FileError("rules-contradict", self.place, rules="; ".join(found))


def _is_chains(value: Any) -> bool:
    return isinstance(value, list) and all(
        isinstance(chain, list) and len(chain) >= 2 and all(isinstance(one, str) for one in chain)
        for chain in value
    )


def _quoted(value: Any) -> str:
    """A text, a number or a list of texts in TOML."""
    return json.dumps(value, ensure_ascii=False)
