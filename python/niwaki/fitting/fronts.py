"""A camera for an image that comes without one: from the front, and as high as the model in the middle of its ranges.

The image alone does not tell the size of things. So the mesh in the middle of all ranges gets the height of the
silhouette in the image, and its middle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import InputError
from niwaki.fitting.discovery import probe
from niwaki.fitting.generator import Generator
from niwaki.fitting.meshes import mesh_of
from niwaki.fitting.pool import Here, Limit, Workers
from niwaki.targets.camera import Camera

#: Seconds of the call.
LIMIT = 60.0


def front_camera(generator: Generator, image: NDArray[np.bool_]) -> Camera:
    """Return an orthographic camera that looks along -z.

    Parameters
    ----------
    generator
        The model; it is called once.
    image : (rows, columns) bool
        The silhouette.

    Raises
    ------
    InputError
        `all-failed`: the model gives no mesh in the middle of its ranges.
    """
    numbers = probe(0, 0) if generator.space is None else _middle(generator)
    recipe, limit = generator.recipe(), Limit(LIMIT)
    caller = (
        Here(generator, limit) if recipe is None else Workers(recipe, 1, limit, generator.worker_command())
    )
    try:
        ((_, reply),) = caller.call([numbers])
    finally:
        caller.close()
    if reply.vertices is None or not len(reply.vertices):
        raise InputError(
            "all-failed", name=generator.name, count=1, reason=reply.failed or "its mesh is empty"
        )
    vertices, _ = mesh_of((reply.vertices, reply.faces))
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    rows, columns = np.nonzero(image.any(axis=1))[0], np.nonzero(image.any(axis=0))[0]
    height = float(high[1] - low[1]) * image.shape[0] / (rows[-1] + 1 - rows[0])
    pixel = height / image.shape[0]
    middle = (low + high) / 2.0
    # The middle of the silhouette is not that of the image.
    right = ((columns[0] + columns[-1] + 1) / 2.0 - image.shape[1] / 2.0) * pixel
    up = (image.shape[0] / 2.0 - (rows[0] + rows[-1] + 1) / 2.0) * pixel
    at = middle - np.array([right, up, 0.0])
    far = 10.0 * float((high - low).max())
    return Camera.orthographic(at + np.array([0.0, 0.0, far]), at, height=height)


def _middle(generator: Generator) -> dict[str, float]:
    """Return the plain numbers in the middle of all ranges, of parameters that are used there."""
    space = generator.space
    assert space is not None
    numbers = {}
    for axis in space.axes:
        if axis.kind == "choice":
            numbers[axis.name] = float((len(axis.values) - 1) // 2)
        else:
            numbers[axis.name] = float(axis.value(0.5))
    return numbers
