"""A few blocks of an old downtown: masonry towers that step back as they rise, glass slabs, walk-ups, water towers.

Nine lots lie between narrow streets. A future builds each lot, each next step of a tower, and the top of each roof. A
step, with its floors, piers and cornice, is a single part: dark glass behind light stone. Slabs of stone run through
the whole block, so that each box makes the piers of two facades.
"""

from niwaki import box, cylinder, discrete_uniform, emit, flip, future, model, uniform

TITLE = "a downtown of setbacks, slabs and water towers"
TARGET = "downtown"
VOXEL = 0.6
PARTICLES = 300

#: Distance between the middles of lots, side of a lot, height of a floor.
PITCH, LOT, FLOOR = 9.3, 8.2, 1.0

GLASS = (0.17, 0.21, 0.26)
STONES = ((0.80, 0.74, 0.64), (0.70, 0.45, 0.35), (0.75, 0.68, 0.56), (0.60, 0.36, 0.29), (0.84, 0.81, 0.75))
STEEL = (0.66, 0.69, 0.71)
CEDAR = (0.50, 0.36, 0.25)
IRON = (0.24, 0.25, 0.26)
GRASS, WALK = (0.41, 0.52, 0.31), (0.77, 0.75, 0.71)


@model
def downtown():
    """Plan three by three lots."""
    for column in (-1, 0, 1):
        for row in (-1, 0, 1):
            future(lot, column * PITCH, row * PITCH)


@model
def lot(x, z):
    """Build on the lot around (x, z): a tower of stone, a slab of glass, or a green."""
    paint = discrete_uniform(0, 4)
    if flip(0.65):
        wide, deep = uniform(0.75, 1.0) * LOT, uniform(0.75, 1.0) * LOT
        floors = discrete_uniform(3, 9)
        emit(masonry(x, z, 0.0, wide, deep, floors, STONES[paint]))
        future(setback, x, z, FLOOR * floors, wide, deep, STONES[paint])
    elif flip(0.8):
        wide, deep = uniform(0.55, 0.95) * LOT, uniform(0.4, 0.9) * LOT
        floors = discrete_uniform(6, 22)
        emit(curtain_wall(x, z, wide, deep, floors))
        future(plant, x, z, FLOOR * floors, wide, deep)
    else:
        emit(
            box((x, 0.1, z), (LOT, 0.2, LOT), color=WALK),
            box((x, 0.2, z), (0.8 * LOT, 0.3, 0.8 * LOT), color=GRASS),
        )


@model
def setback(x, z, base, wide, deep, stone):
    """Build on the roof at height `base`: a smaller step, a water tower or a machine room."""
    if min(wide, deep) > 2.2 and flip(0.6):
        wider, deeper = uniform(0.55, 0.85) * wide, uniform(0.55, 0.85) * deep
        floors = discrete_uniform(2, 6)
        emit(masonry(x, z, base, wider, deeper, floors, stone))
        future(setback, x, z, base + FLOOR * floors, wider, deeper, stone)
    elif flip(0.7):
        size = min(uniform(0.8, 1.1), 0.3 * min(wide, deep))
        dx, dz = uniform(-0.2, 0.2) * wide, uniform(-0.2, 0.2) * deep
        emit(water_tower(x + dx, z + dz, base, size))
    else:
        future(plant, x, z, base, wide, deep)


@model
def plant(x, z, base, wide, deep):
    """Build a machine room on a flat roof, sometimes with a mast."""
    height = uniform(0.6, 1.4)
    room = box((x, base + 0.5 * height, z), (0.5 * wide, height, 0.5 * deep), color=STEEL)
    if flip(0.3):
        tall = uniform(2.0, 5.0)
        emit(room, cylinder((x, base + height + 0.5 * tall, z), 0.14, tall, top_radius=0.05, color=IRON))
    else:
        emit(room)


def masonry(x, z, base, wide, deep, floors, stone):
    """Make a step of a stone tower: glass, a band below each floor's windows, piers through the block, a cornice."""
    tall = FLOOR * floors - 0.2
    middle = base + 0.5 * tall
    glass = [box((x, middle, z), (wide - 0.6, tall, deep - 0.6), bevel=0.0, color=GLASS)]
    bands = [
        box((x, base + FLOOR * k + 0.2, z), (wide - 0.4, 0.4, deep - 0.4), bevel=0.0, color=stone)
        for k in range(floors)
    ]
    piers = [
        box((x + at, middle, z), (0.32, tall, deep - 0.2), bevel=0.0, color=stone) for at in spaced(wide)
    ] + [box((x, middle, z + at), (wide - 0.2, tall, 0.32), bevel=0.0, color=stone) for at in spaced(deep)]
    corners = [
        box(
            (x + dx * (0.5 * wide - 0.4), middle, z + dz * (0.5 * deep - 0.4)),
            (0.7, tall, 0.7),
            bevel=0.04,
            color=stone,
        )
        for dx, dz in ((-1, -1), (-1, 1), (1, -1), (1, 1))
    ]
    cornice = [box((x, base + tall - 0.05, z), (wide, 0.5, deep), bevel=0.2, color=stone)]
    return glass + bands + piers + corners + cornice


def curtain_wall(x, z, wide, deep, floors):
    """Make a slab of glass with a thin edge of steel at each floor, and a wall at each end."""
    tall = FLOOR * floors
    glass = [box((x, 0.5 * tall - 0.1, z), (wide - 0.2, tall - 0.2, deep - 0.3), bevel=0.0, color=GLASS)]
    edges = [
        box((x, FLOOR * (k + 1) - 0.09, z), (wide - 0.2, 0.18, deep), bevel=0.0, color=STEEL)
        for k in range(floors)
    ]
    ends = [
        box(
            (x + side * (0.5 * wide - 0.2), 0.5 * tall - 0.02, z),
            (0.4, tall - 0.04, deep + 0.1),
            bevel=0.0,
            color=STEEL,
        )
        for side in (-1, 1)
    ]
    return glass + edges + ends


def water_tower(x, z, base, size):
    """Make a barrel of cedar on four iron legs, with a cone as its roof."""
    leg, belly = 1.1 * size, 1.5 * size
    legs = [
        cylinder((x + dx * 0.6 * size, base + 0.5 * leg, z + dz * 0.6 * size), 0.09 * size, leg, color=IRON)
        for dx, dz in ((-1, -1), (-1, 1), (1, -1), (1, 1))
    ]
    deck = cylinder((x, base + leg + 0.06 * size, z), 1.05 * size, 0.12 * size, color=IRON)
    barrel = cylinder((x, base + leg + 0.5 * belly, z), size, belly, top_radius=0.95 * size, color=CEDAR)
    hat = cylinder(
        (x, base + leg + belly + 0.35 * size, z), 1.08 * size, 0.7 * size, top_radius=0.08 * size, color=IRON
    )
    return legs + [deck, barrel, hat]


def spaced(width):
    """Return the places of piers between the corners of a facade, about 1.3 apart."""
    count = max(2, round(width / 1.3))
    return [width * (k / count - 0.5) for k in range(1, count)]


MODEL = downtown
