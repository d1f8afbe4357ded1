"""A spaceship: a body of boxes, cylinders and clusters of cylinders, with wings, guns, fins and a nose.

This is the generative process of dissertation 5.5. The long axis is z, with the tail at z = -5 and the nose towards +z;
the ship is mirror-symmetric in x by construction. The first coin of every loop always lands on "continue", so every
loop makes at least two parts. Futures decide about wings, guns and fins, so that a stochastic order can postpone them.
"""

from math import exp

from niwaki import box, cylinder, discrete_uniform, emit, flip, future, model, uniform

TITLE = "a spaceship of boxes and cylinders"
TARGET = "ship"
VOXEL = 0.25

BOX, CYLINDER, CLUSTER, NO_SECTION = 0, 1, 2, 3

HULL = (0.80, 0.79, 0.76)
TRIM = (0.64, 0.66, 0.69)
METAL = (0.36, 0.39, 0.44)
ACCENT = (0.88, 0.42, 0.18)


@model
def spaceship():
    """Build the body from tail to nose, with wings and fins in futures."""
    previous, width, height, rear = NO_SECTION, -1.0, -1.0, -5.0
    i = 0
    going_on = True
    while going_on:
        kind = discrete_uniform(BOX, CLUSTER)
        if kind == BOX:
            width, height = box_section(previous, width, height)
            length = uniform(2.0, 5.0)
            emit(box((0.0, 0.0, rear + length / 2), (width, height, length), color=HULL))
        elif kind == CYLINDER:
            radius = cylinder_radius(previous, 0.5 * min(width, height), 0.3, 1.25)
            length = uniform(2.0, 5.0)
            width, height = 2.0 * radius, 2.0 * radius
            emit(cylinder((0.0, 0.0, rear + length / 2), radius, length, axis="z", color=TRIM))
        else:
            radius = cylinder_radius(previous, 0.25 * min(width, height), 0.15, 0.625)
            length = uniform(2.0, 5.0)
            width, height = 4.0 * radius, 4.0 * radius
            middle = rear + length / 2
            emit(
                cylinder((radius, radius, middle), radius, length, axis="z", color=METAL),
                cylinder((-radius, radius, middle), radius, length, axis="z", color=METAL),
                cylinder((radius, -radius, middle), radius, length, axis="z", color=METAL),
                cylinder((-radius, -radius, middle), radius, length, axis="z", color=METAL),
            )
        rear = rear + length
        future(wings, i, width / 2, rear - length + 0.5, rear - 0.5)
        future(fins, height / 2, rear - length, rear, 0.6 * width)
        previous = kind
        going_on = flip(exp(-0.4 * i))
        i = i + 1
    if flip(0.75):
        width, height = box_section(previous, width, height)
        length = uniform(1.0, 3.0)
        taper = uniform(0.25, 0.75)
        emit(box((0.0, 0.0, rear + length / 2), (width, height, length), taper=taper, color=HULL))


def box_section(previous, width, height):
    """Draw width and height of a box, at least those of a section before it that is not a box."""
    wide = uniform(1.0, 3.0)
    high = uniform(0.5, 1.0) * wide
    if previous != BOX:
        wide = max(wide, width)
        high = max(high, height)
    return wide, high


def cylinder_radius(previous, limit, lo, hi):
    """Draw the radius of a body cylinder: between `lo` and `hi`, or within the face of a box before it."""
    if previous == BOX:
        return uniform(0.4 * limit, limit)
    return uniform(lo, hi)


def wings(i, base, back, front):
    """Perhaps build a pair of wings on body segment `i`, at x = +-base, within z from `back` to `front`."""
    if flip(exp(-0.5 * (i + 1))):
        j = 0
        going_on = True
        while going_on:
            if flip(0.5):
                z = uniform(back, front)
                radius = uniform(0.15, 0.7)
                length = uniform(1.0, 5.0)
                width = 2.0 * radius
                emit(
                    cylinder((base + radius, 0.0, z), radius, length, axis="z", color=METAL),
                    cylinder((-base - radius, 0.0, z), radius, length, axis="z", color=METAL),
                )
            else:
                z = uniform(back, front)
                width = uniform(0.25, 2.0)
                height = uniform(0.25, 1.25)
                length = uniform(0.5, 4.0)
                emit(
                    box((base + width / 2, 0.0, z), (width, height, length), color=TRIM),
                    box((-base - width / 2, 0.0, z), (width, height, length), color=TRIM),
                )
                future(guns, base + width / 2, height / 2 + 0.15, z, length)
            base = base + width
            back, front = z - length / 2, z + length / 2
            going_on = flip(exp(-0.6 * j))
            j = j + 1


def guns(x, y, z, wing):
    """Perhaps add four guns above and below a pair of wing boxes of length `wing`."""
    if flip(0.5):
        length = uniform(1.0, 1.2) * wing
        emit([gun(x, y, z, length), gun(x, -y, z, length), gun(-x, y, z, length), gun(-x, -y, z, length)])


def gun(x, y, z, length):
    """Make a barrel and its tip."""
    tip = 0.4
    return (
        cylinder((x, y, z), 0.15, length, axis="z", color=METAL),
        cylinder((x, y, z + length / 2 + tip / 2), 0.15, tip, axis="z", top_radius=0.03, color=METAL),
    )


def fins(base, back, front, width):
    """Perhaps build a stack of fins on a body segment, from y = base upwards."""
    if flip(0.7):
        middle = (back + front) / 2
        length = front - back
        j = 0
        going_on = True
        while going_on:
            width = uniform(0.5, 1.0) * width
            height = uniform(0.1, 0.5)
            length = uniform(0.5, 1.0) * length
            emit(box((0.0, base + height / 2, middle), (width, height, length), color=ACCENT))
            base = base + height
            going_on = flip(exp(-0.2 * j))
            j = j + 1


MODEL = spaceship
