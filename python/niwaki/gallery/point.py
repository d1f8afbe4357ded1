"""A point of the plane near a curve: the smallest design with a tight constraint.

In dissertation 4.2, eq. 4.1, `x` and `y` are uniform on [-1.5, 1.5], and `y^4 - y^2 + x^2 - 1/4` is softly equal to 0
within `width`: 0.1 in the top row of Figure 4.2, 0.005 in the bottom row. On a narrow curve a random walk can only take
small steps; a chain that follows the gradient keeps its pace.
"""

from niwaki import cylinder, emit, factor, model, softeq, uniform

TITLE = "a point near a curve, within a width"

INK = (0.20, 0.32, 0.52)


@model
def point(width=0.005):
    """Choose a point and score its distance from the curve."""
    x = uniform(-1.5, 1.5)
    y = uniform(-1.5, 1.5)
    factor(softeq(y**4 - y**2 + x**2, 0.25, width))
    emit(cylinder((x, y, 0.0), 0.03, 0.02, axis="z", color=INK))
    return x, y


MODEL = point
