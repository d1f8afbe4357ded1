"""Words of the modelling language: the functions and types that a model may use.

- choices: `sample`, `choose`
- draws: `flip`, `gaussian`, ...: draws from a family
- distributions: `Gaussian`, `Uniform`, ...: distributions as values
- effects: `factor`, `condition`, `observe`, `query`, `emit`, `future`, `force`, `infer`
- memo: `mem`, for memoised functions
- shapes: `box`, `cylinder`, ...: solids, and flat shapes such as `stroke`
- measures: `Frame`, `Bark`, which some shapes take
- colors: `rgb`, `hsv`, `lab`, `to_hsv`, `to_lab`, `color_difference`
- polygons: `polygon_area`, `polygon_contains`, `polygon_distance`, `polygon_disc_area`, `polygon_inset`
- frames: `look`, `place`, `mirrored`, `arrayed`
- vectors: `vec`, `dot`, `cross`, `norm`, `normalize`, `distance`, `rotate`, `rotation`
- numbers: `clip`, `lerp`, `linspace`, `sign`, `smoothstep`
- soft: `softeq`, `soft_at_least`, `soft_at_most`, `smooth_max`, `smooth_min`, `smooth_abs`
- running: the current run
"""

from niwaki.words import (
    choices,
    colors,
    distributions,
    draws,
    effects,
    frames,
    measures,
    memo,
    numbers,
    polygons,
    shapes,
    soft,
    vectors,
)
from niwaki.words.choices import *
from niwaki.words.colors import *
from niwaki.words.distributions import *
from niwaki.words.draws import *
from niwaki.words.effects import *
from niwaki.words.frames import *
from niwaki.words.measures import *
from niwaki.words.memo import *
from niwaki.words.numbers import *
from niwaki.words.polygons import *
from niwaki.words.shapes import *
from niwaki.words.soft import *
from niwaki.words.vectors import *

__all__ = []
__all__ += choices.__all__
__all__ += colors.__all__
__all__ += distributions.__all__
__all__ += draws.__all__
__all__ += effects.__all__
__all__ += frames.__all__
__all__ += measures.__all__
__all__ += memo.__all__
__all__ += numbers.__all__
__all__ += polygons.__all__
__all__ += shapes.__all__
__all__ += soft.__all__
__all__ += vectors.__all__
