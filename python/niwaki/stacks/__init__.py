"""Structures of blocks that stand (dissertation 4.5)."""
from niwaki.stacks.towers import every_step, lean, stack, top_heavy
from niwaki.stacks.platforms import platforms
from niwaki.stacks.arches import arch, symmetric_arch, tri_arch, symmetric_tri_arch, wheel
from niwaki.stacks.cut_pieces import *
