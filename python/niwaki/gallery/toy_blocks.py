"""Toy blocks scattered over a floor: boxes and cylinders, some of them lying on their sides.

This is the generative process of dissertation 5.5, where the shadow of the blocks should be a face in profile. The
model has no branches, so it has no futures, and every order is the same.
"""

from math import cos, exp, pi, sin

from niwaki import box, cylinder, emit, flip, model, rotation, uniform, vec

TITLE = "toy blocks on a floor, for their shadow"
PARTICLES = 300

PAINTS = ((0.79, 0.26, 0.22), (0.90, 0.66, 0.20), (0.23, 0.46, 0.64), (0.36, 0.57, 0.36), (0.85, 0.76, 0.60))
UP = vec(0.0, 1.0, 0.0)


@model
def toy_blocks(decay=0.0075):
    """Place blocks; after block i another follows with probability exp(-decay i)."""
    i = 0
    going_on = True
    while going_on:
        paint = PAINTS[i % 5]
        if flip(0.5):
            height = uniform(0.25, 4.0)
            radius = uniform(0.25, 1.0)
            x, z = uniform(-10.0, 10.0), uniform(-10.0, 10.0)
            if flip(0.5):
                emit(cylinder((x, 0.5 * height, z), radius, height, color=paint))
            else:
                # Two of the cylinder's eight sides are level, and the vertices between reach the floor.
                turn = uniform(0.0, 2.0 * pi)
                along = vec(cos(turn), 0.0, -sin(turn))
                emit(cylinder((x, radius, z), radius, height, axis=along, color=paint))
        else:
            size = (uniform(0.25, 2.0), uniform(0.25, 2.0), uniform(0.25, 2.0))
            x, z = uniform(-10.0, 10.0), uniform(-10.0, 10.0)
            turn = uniform(0.0, 2.0 * pi)
            emit(box((x, 0.5 * size[1], z), size, rotation=rotation(UP, turn), color=paint))
        going_on = flip(exp(-decay * i))
        i = i + 1


MODEL = toy_blocks
