"""How much of CIELAB a chain's colours reach, and maps of it (dissertation figure 4.5).

256 bins: 4 of lightness, [0, 100], by 8 of a and 8 of b, [-100, 100], each a cube with edges of 25 units. 139 of them
hold a colour of the screen, so that 54 % is the most that can be reached.
"""

import numpy as np
from niwaki.color import Drawing, lab
from numpy.typing import NDArray
from PIL import Image

EDGE, REACHABLE, ALL = 25.0, 139, 256
WHITE, BLUE = np.array([255.0, 255.0, 255.0]), np.array([20.0, 60.0, 160.0])
#: The share of all bins that is drawn as full blue.
DEEPEST = 0.35


def bins(colors: NDArray[np.float64]) -> NDArray[np.int64]:
    """The bin of each colour in [0, 1], (..., 3) to (...)."""
    indices = np.floor((lab.of_rgb(colors) + np.array([0.0, 100.0, 100.0])) / EDGE).astype(np.int64)
    return np.asarray(np.clip(indices, 0, (3, 7, 7)) @ np.array([64, 8, 1]))


def reached(colors: NDArray[np.float64]) -> NDArray[np.int64]:
    """Bins that each region's colours reach; (draws, regions, 3) to (regions,)."""
    number = bins(colors)
    return np.array([len(np.unique(number[:, k])) for k in range(number.shape[1])])


def picture(drawing: Drawing, covered: NDArray[np.int64], size: int = 400) -> Image.Image:
    """The drawing, each region from white to blue by the bins that it reached."""
    shares = np.clip(covered / ALL / DEEPEST, 0.0, 1.0)
    shades = {
        name: lab.hexed((WHITE + share * (BLUE - WHITE)) / 255.0)
        for name, share in zip(drawing.names, shares, strict=True)
    }
    paper = Image.new("RGB", drawing.picture(shades, size).size, (255, 255, 255))
    image = drawing.picture(shades, size)
    paper.paste(image, (0, 0), image)
    return paper
