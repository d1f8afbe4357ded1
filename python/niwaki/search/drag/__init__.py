"""Dragging a part of a run to a point: the choices above it are moved by the derivatives of its position.

The position of a point fixed to a part is a function of the real choices that the part depends on; the engine records
it with its derivatives (`crates/grad/src/positions.rs`). Each answer is a damped Gauss-Newton descent (Levenberg 1944,
Marquardt 1963) to

    argmin  |position(x) - to|^2 + damping |z|^2,    z = (x - start) / spread,

with x within the supports of the choices and `spread` the deviation of each prior, so that of all ways there the one
is taken that changes the choices least. Where the edit has several answers, these differ in the choices that may
change. Where no real choice takes the part there, discrete choices that decide its structure are tried, too.

- `held`       a part that is held by a point of it, and where the point is
- `descent`    real choices moved until the point is there
- `structure`  discrete choices that decide the part
- `reasons`    why a part is not there
- `source`     a drag that a number of the source explains, as a change of the file
- `dragging`   the answers for a point, the least change first

What a drag gives is in `niwaki.result.dragged`.
"""

from niwaki.result.dragged import Drag, Dragged, Moved
from niwaki.search.drag.dragging import Dragging, dragged

__all__ = ["Drag", "Dragged", "Dragging", "Moved", "dragged"]
