"""A building complex: towers of boxes or cylinders that shrink as they rise, and spread over the ground.

This is the generative process of dissertation 5.5. All storeys of a tower have the same kind. At each open side of the
ground storey another tower may begin, flush with it, on a lot of the same size; far from the first tower this is less
likely. Each tower has at least two storeys, because the first coin of the loop always lands on "continue". Neighbours
are built in futures, which also decide whether there is a neighbour.
"""

from math import exp

from niwaki import box, cylinder, emit, flip, future, model, uniform

TITLE = "a building complex of stepped towers"
TARGET = "crescent"
VOXEL = 0.25
PARTICLES = 1000

#: Sides of a lot: -x, +x, -z, +z. The first tower has no parent.
LEFT, RIGHT, DOWN, UP, NOWHERE = 0, 1, 2, 3, 4
OPPOSITE = (RIGHT, LEFT, UP, DOWN, NOWHERE)

STONE = ((0.83, 0.79, 0.71), (0.78, 0.73, 0.65), (0.73, 0.68, 0.60), (0.80, 0.77, 0.72))
BRICK = ((0.66, 0.47, 0.37), (0.61, 0.43, 0.34), (0.70, 0.52, 0.41), (0.58, 0.42, 0.35))
ROOF = (0.36, 0.45, 0.44)


@model
def building():
    """Build a tower on the lot from -2 to 2, and the towers around it."""
    tower(0, (-2.0, 2.0, -2.0, 2.0), NOWHERE)


@model
def tower(depth, lot, side):
    """Build a tower that is `depth` towers away from the first tower, on a `side` of its parent.

    `lot` is (lowest x, highest x, lowest z, highest z).
    """
    is_round = flip(0.5)
    base, floor, i = lot, 0.0, 0
    going_on = True
    while going_on:
        x0, x1, z0, z1 = base
        if is_round:
            radius = uniform(0.5, 1.0) * 0.5 * min(x1 - x0, z1 - z0)
            height = uniform(1.0, 3.0)
            wide, deep = 2.0 * radius, 2.0 * radius
        else:
            wide = uniform(0.5, 1.0) * (x1 - x0)
            deep = uniform(0.5, 1.0) * (z1 - z0)
            height = uniform(1.0, 3.0)
        # Only a ground storey is pushed against the parent.
        base = footprint(base, wide, deep, side if i == 0 else NOWHERE)
        emit(storey(is_round, base, floor, height, 1.0, BRICK[i % 4] if is_round else STONE[i % 4]))
        if i == 0:
            for direction in (LEFT, RIGHT, DOWN, UP):
                if direction != OPPOSITE[side]:
                    future(neighbour, depth, lot, base, direction)
        floor = floor + height
        going_on = flip(exp(-0.4 * i))
        i = i + 1
    if flip(0.5):
        height = uniform(0.5, 1.5)
        emit(storey(is_round, base, floor, height, uniform(0.1, 0.5), ROOF))


@model
def neighbour(depth, lot, placed, direction):
    """Perhaps build a tower on the next lot, which begins at the face of the storey `placed` on this lot."""
    if flip(0.5 - 0.05 * depth):
        x0, x1, z0, z1 = lot
        wide, deep = x1 - x0, z1 - z0
        if direction == LEFT:
            there = (placed[0] - wide, placed[0], z0, z1)
        elif direction == RIGHT:
            there = (placed[1], placed[1] + wide, z0, z1)
        elif direction == DOWN:
            there = (x0, x1, placed[2] - deep, placed[2])
        else:
            there = (x0, x1, placed[3], placed[3] + deep)
        tower(depth + 1, there, direction)


def footprint(lot, wide, deep, side):
    """Return a rectangle in the middle of the lot, or flush with the parent's side."""
    x, z = 0.5 * (lot[0] + lot[1]), 0.5 * (lot[2] + lot[3])
    x0, x1, z0, z1 = x - 0.5 * wide, x + 0.5 * wide, z - 0.5 * deep, z + 0.5 * deep
    if side == LEFT:
        x0, x1 = lot[1] - wide, lot[1]
    elif side == RIGHT:
        x0, x1 = lot[0], lot[0] + wide
    elif side == DOWN:
        z0, z1 = lot[3] - deep, lot[3]
    elif side == UP:
        z0, z1 = lot[2], lot[2] + deep
    return x0, x1, z0, z1


def storey(is_round, rectangle, floor, height, taper, color):
    """Make a box or cylinder over the rectangle, with its top scaled by `taper`."""
    x0, x1, z0, z1 = rectangle
    center = (0.5 * (x0 + x1), floor + 0.5 * height, 0.5 * (z0 + z1))
    if is_round:
        radius = 0.5 * (x1 - x0)
        return cylinder(center, radius, height, top_radius=taper * radius, bevel=0.05, color=color)
    size = (x1 - x0, height, z1 - z0)
    return box(center, size, taper=taper, taper_axis="y", bevel=0.05, color=color)


MODEL = building
