"""The models of `niwaki.stacks`, each with its tolerance, which is the original's."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from niwaki import stacks

#: Standard deviations of net forces and torques of the original: half a percent of the mean weight, or one.
TIGHT, LOOSE = 0.005, 0.01


@dataclass(frozen=True)
class Kind:
    """A model and its tolerance."""

    name: str
    width: float

    @property
    def model(self) -> Any:
        return getattr(stacks, self.name)


#: In the order of the table; small ones first, so that much is there early.
KINDS = {
    name: Kind(name, width)
    for name, width in {
        "stack": TIGHT,
        "lean": TIGHT,
        "top_heavy": TIGHT,
        "cut_stack": LOOSE,
        "cut_lean": LOOSE,
        "cut_top_heavy": LOOSE,
        "cut_arch": LOOSE,
        "tilt_stack": LOOSE,
        "tilt_arch": LOOSE,
        "every_step": TIGHT,
        "arch": LOOSE,
        "symmetric_arch": LOOSE,
        "platforms": LOOSE,
        "tri_arch": LOOSE,
        "symmetric_tri_arch": LOOSE,
        "wheel": LOOSE,
    }.items()
}
