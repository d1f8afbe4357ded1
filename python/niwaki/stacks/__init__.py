"""Structures of blocks that stand: models, judges, files (dissertation 4.5, figures 4.8 to 4.13).

Models: `stack`, `lean`, `top_heavy`, `every_step`; `platforms`; `arch`, `symmetric_arch`, `tri_arch`,
`symmetric_tri_arch`, `wheel`. Models of pieces to cut: `cut_stack`, `cut_lean`, `cut_top_heavy`, `cut_arch`,
`tilt_stack`, `tilt_arch`. All choices are continuous. `start` finds the start of a chain, and `polished` makes the
balance of a draw more exact. A sample becomes a `Structure`: `balanced` and `simulated` judge it, `carried` computes
its forces, and `cut_sheet` lays it out on boards. Libraries of the extra `stacks` are imported when they are used.
"""

from niwaki.stacks.arches import arch, symmetric_arch, symmetric_tri_arch, tri_arch, wheel
from niwaki.stacks.cut_pieces import cut_arch, cut_lean, cut_stack, cut_top_heavy, tilt_arch, tilt_stack
from niwaki.stacks.cut_sheet import Assembly, Piece, Sheet, assembly, cut_sheet
from niwaki.stacks.judges import Balance, Simulation, balanced, simulated
from niwaki.stacks.platforms import platforms
from niwaki.stacks.starts import polished, start
from niwaki.stacks.structure import Structure, Touch, plain
from niwaki.stacks.supports import Carried, carried
from niwaki.stacks.towers import every_step, lean, stack, top_heavy

__all__ = [
    "Assembly",
    "Balance",
    "Carried",
    "Piece",
    "Sheet",
    "Simulation",
    "Structure",
    "Touch",
    "arch",
    "assembly",
    "balanced",
    "carried",
    "cut_arch",
    "cut_lean",
    "cut_sheet",
    "cut_stack",
    "cut_top_heavy",
    "every_step",
    "lean",
    "plain",
    "platforms",
    "polished",
    "simulated",
    "stack",
    "start",
    "symmetric_arch",
    "symmetric_tri_arch",
    "tilt_arch",
    "tilt_stack",
    "top_heavy",
    "tri_arch",
    "wheel",
]
