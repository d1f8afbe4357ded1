"""The functions and types that a model may use.

choices         `sample`, `flip`, `gaussian`, ...: draws
distributions   `Gaussian`, `Uniform`, ...: distributions as values
effects         `factor`, `condition`, `observe`, `query`, `emit`, `future`, `force`, `infer`
shapes          `box`, `cylinder`, `limb`, `segment`, `mesh`
colors          `hsv`, `lab`, `to_hsv`, `to_lab`, `color_difference`
polygons        `polygon_area`, `polygon_contains`, `polygon_distance`, `polygon_disc_area`, `polygon_inset`
vectors         `vec`, `dot`, `cross`, `norm`, `normalize`, `distance`, `rotate`, `rotation`
numbers         `clip`, `lerp`, `sign`
soft            `softeq`, `soft_at_least`, `soft_at_most`, `smooth_max`, `smooth_min`, `smooth_abs`
running         the run that a call belongs to
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
