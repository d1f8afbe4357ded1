"""Everything that a model may say.

models          `@model`, `@host`
choices         `sample`, `flip`, `gaussian`, ...: draws
distributions   `Gaussian`, `Uniform`, ...: distributions as values
effects         `factor`, `condition`, `observe`, `query`, `emit`, `future`, `force`, `infer`
shapes          `box`, `cylinder`, `limb`, `segment`, `mesh`
colors          `hsv`, `lab`, `to_hsv`, `to_lab`, `color_difference`
polygons        `polygon_area`, `polygon_contains`, `polygon_distance`, `polygon_disc_area`, `polygon_inset`
vectors         `vec`, `dot`, `cross`, `norm`, `normalize`, `distance`, `rotate`, `rotation`
numbers         `clip`, `lerp`, `sign`
soft            `softeq`, `soft_at_least`, `soft_at_most`, `smooth_max`, `smooth_min`, `smooth_abs`
running         which run a word belongs to
"""

from niwaki.words import choices, distributions, shapes
from niwaki.words.choices import *  # noqa: F403
from niwaki.words.colors import color_difference, hsv, lab, to_hsv, to_lab
from niwaki.words.distributions import *  # noqa: F403
from niwaki.words.effects import condition, emit, factor, force, future, infer, observe, query
from niwaki.words.models import Host, Model, host, model
from niwaki.words.numbers import clip, lerp, sign
from niwaki.words.polygons import (
    polygon_area,
    polygon_contains,
    polygon_disc_area,
    polygon_distance,
    polygon_inset,
)
from niwaki.words.shapes import *  # noqa: F403
from niwaki.words.soft import smooth_abs, smooth_max, smooth_min, soft_at_least, soft_at_most, softeq
from niwaki.words.vectors import Rotation, Vec, cross, distance, dot, norm, normalize, rotate, rotation, vec

__all__ = [
    "Host",
    "Model",
    "Rotation",
    "Vec",
    "clip",
    "color_difference",
    "condition",
    "cross",
    "distance",
    "dot",
    "emit",
    "factor",
    "force",
    "future",
    "host",
    "hsv",
    "infer",
    "lab",
    "lerp",
    "model",
    "norm",
    "normalize",
    "observe",
    "polygon_area",
    "polygon_contains",
    "polygon_disc_area",
    "polygon_distance",
    "polygon_inset",
    "query",
    "rotate",
    "rotation",
    "sign",
    "smooth_abs",
    "smooth_max",
    "smooth_min",
    "soft_at_least",
    "soft_at_most",
    "softeq",
    "to_hsv",
    "to_lab",
    "vec",
]
__all__ += choices.__all__
__all__ += distributions.__all__
__all__ += shapes.__all__
