"""A maze of square pipes on a grid, each at right angles to the one before, for the shadow that they cast together.

This is the generative process of dissertation 5.5. From the end of each pipe up to two others grow, in futures: a
shorter pipe, and a pipe of the same kind. A network can have two thousand pipes.
"""

from math import exp

from niwaki import box, discrete_uniform, emit, flip, future, model, poisson

TITLE = "a maze of square pipes, for its shadow"
PARTICLES = 100

#: Size of a grid cell in scene units; distance from the middle and lowest height at which a pipe may end, in cells.
CELL = 0.2
REACH = 100
LOWEST = 5

STEEL = ((0.62, 0.64, 0.66), (0.68, 0.62, 0.53), (0.55, 0.58, 0.62), (0.72, 0.54, 0.40))


@model
def pipes(height=60, factor=10.0):
    """Grow pipes from `height` cells above the origin; their mean length starts at `factor` cells."""
    grow((0, height, 0), factor, (0, 0, 0), 0)


@model
def grow(start, factor, before, generation):
    """Lay a pipe from `start`, at right angles to the direction `before`, and postpone the pipes after it.

    A length of two cells or fewer ends the line. A pipe that would end too low or too far out is drawn again, and may
    then end the line.
    """
    searching = True
    end, along, cells = start, before, 0
    while searching:
        cells = poisson(factor)
        if cells <= 2:
            searching = False
        else:
            along = across(before)
            end = (start[0] + cells * along[0], start[1] + cells * along[1], start[2] + cells * along[2])
            searching = not (end[1] > LOWEST and abs(end[0]) < REACH and abs(end[2]) < REACH)
    if cells > 2:
        emit(pipe(start, along, cells, STEEL[generation % 4]))
        future(go_on, 0.6, end, 0.7 * factor, along, generation + 1)
        future(go_on, 0.9 + 0.09 * exp(-generation / 50.0), end, factor, along, generation + 1)


@model
def go_on(odds, start, factor, before, generation):
    """Perhaps lay another pipe from here."""
    if flip(odds):
        grow(start, factor, before, generation)


@model
def across(before):
    """Draw one of the six directions, at right angles to `before`; the first pipe can have any direction but up."""
    searching = True
    direction = before
    while searching:
        axis = discrete_uniform(0, 2)
        way = 1 if flip(0.5) else -1
        direction = (way if axis == 1 else 0, way if axis == 0 else 0, way if axis == 2 else 0)
        level = before[0] * direction[0] + before[1] * direction[1] + before[2] * direction[2] == 0
        first_goes_up = before == (0, 0, 0) and direction == (0, 1, 0)
        searching = not level or first_goes_up
    return direction


def pipe(start, along, cells, color):
    """Make a pipe, one cell thick, over the cells after `start` up to its end."""
    middle = 0.5 * (cells + 1)
    center = [CELL * (s + middle * a) for s, a in zip(start, along, strict=True)]
    size = [CELL * (1 + (cells - 1) * abs(a)) for a in along]
    return box(center, size, bevel=0.3, color=color)


MODEL = pipes
