"""Drags of a part of a run to a point, by choices that move along the derivatives of its position.

The position of a point fixed to a part is a function of the real choices that the part depends on; the engine records
it with its derivatives (`crates/grad/src/positions.rs`). Each answer is a damped Gauss-Newton descent (Levenberg 1944,
Marquardt 1963) to

    argmin  |position(x) - to|^2 + damping |z|^2,    z = (x - start) / spread,

with x within the supports of the choices and `spread` the deviation of each prior. So the descent changes the choices
least. Several answers differ in the choices that may change. If no real choice takes the part to the point, the search
tries discrete choices that decide the structure of the part.

- `held`       parts that are held by a point, and the place of the point
- `descent`    descents of real choices to the point
- `structure`  discrete choices that decide the part
- `reasons`    reasons why a part does not reach the point
- `source`     changes of numbers in the source that explain a drag
- `dragging`   the answers for a point, the least change first

Results of drags are in `niwaki.result.dragged`.
"""

from niwaki.result.dragged import Drag, Dragged, Moved
from niwaki.search.drag.dragging import Dragging, dragged

__all__ = ["Drag", "Dragged", "Dragging", "Moved", "dragged"]
