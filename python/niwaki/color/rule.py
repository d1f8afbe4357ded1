"""One rule about the regions of a drawing."""

from __future__ import annotations

from dataclasses import dataclass

#: Units of CIELAB lightness between neighbours in a `lightness` chain (dissertation appendix B.1), a `lighter` chain.
STEP, LEAST = 15.0, 12.0


@dataclass(frozen=True)
class Rule:
    """One rule about one or two regions.

    Attributes
    ----------
    kind : str
        "lightness", "lighter", "same-chroma", "same-hue" or "muted".
    first, second : str
        The regions, the lighter region first; `second` is empty for "muted".
    most : float
        For "muted": the largest distance from grey, CIELAB units.
    """

    kind: str
    first: str
    second: str = ""
    most: float = 0.0

    def __str__(self) -> str:
        if self.kind == "same-chroma":
            return f"`{self.first}` and `{self.second}` are shades of one colour"
        if self.kind == "same-hue":
            return f"`{self.first}` and `{self.second}` have one hue"
        if self.kind == "muted":
            return f"`{self.first}` is at most {self.most:g} units from grey"
        much = f"{STEP:.0f} units" if self.kind == "lightness" else f"at least {LEAST:.0f} units"
        return f"`{self.first}` is {much} lighter than `{self.second}`"
