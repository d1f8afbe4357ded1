"""Three log densities over unconstrained coordinates, for `jax.numpy` or `numpy`; what `reference.txt` was made with.

ring      2 coordinates: a point near a curve (dissertation 4.2), sigma 0.005
coloring  60: 20 regions, a logistic for each channel; the factors of appendix B.1, 6 + 6 rules
stack     118: 6 blocks (46 numbers of shape, logistic), 6 contacts of 4 forces; the factors of appendix B.2

Constants of normal densities are dropped. `crates/grad/tests/peers` has the same in Rust, over numbers that record.
"""

from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).parent
DIMS = {"ring": 2, "coloring": 60, "stack": 118}
#: Leapfrog steps of a trajectory.
STEPS = {"ring": 100, "coloring": 100, "stack": 1000}
#: Step sizes at a unit metric: near the dissertation's acceptance of 0.65 (0.85 on the stack's narrow start).
STEP_SIZES = {"ring": 0.0059, "coloring": 0.055, "stack": 0.0014}


def density(xp: Any, name: str) -> Any:
    """A log density as a function of one array."""
    function = {"ring": ring, "coloring": coloring, "stack": stack}[name]
    return lambda x: function(xp, x)


def start(name: str) -> np.ndarray:
    """Where chains start before their warm-up."""
    if name == "ring":
        return np.array([0.5, 0.1])
    if name == "coloring":
        return np.random.default_rng(3).normal(size=60)
    x = np.zeros(DIMS["stack"])
    # Half of what six nominal blocks weigh is 1.9 each; a contact carries all above it, on four corners.
    carried = 1.9 * np.arange(BLOCKS, 0, -1) / 4.0
    x[SHAPE : SHAPE + 4 * BLOCKS] = np.log(np.repeat(carried, 4))
    return x


def known(name: str) -> list[tuple[np.ndarray, float, np.ndarray]]:
    """Points at which value and gradient are known."""
    rows = []
    for line in (HERE / "reference.txt").read_text().splitlines():
        words = line.split()
        if words[0] == name:
            n, numbers = int(words[1]), np.array(words[2:], float)
            rows.append((numbers[1 : 1 + n], float(numbers[0]), numbers[1 + n :]))
    return rows


def sigmoid(xp: Any, v: Any) -> Any:
    return 1.0 / (1.0 + xp.exp(-v))


def log_jacobian(xp: Any, v: Any) -> Any:
    """`log s(v) + log s(-v)`, which shares its exponential with `s(v)`."""
    return 2.0 * xp.log(sigmoid(xp, v)) - v


def ring(xp: Any, x: Any) -> Any:
    y2 = x[1] * x[1]
    z = (y2 * y2 - y2 + x[0] * x[0] - 0.25) / 0.005
    return -0.5 * z * z


def read_drawing() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Areas, neighbours, pairs of one chroma, pairs 15 units of lightness apart."""
    words = (HERE / "coloring.txt").read_text().split()
    regions, edges, chroma, light = map(int, words[:4])
    area = np.array(words[4 : 4 + regions], float)
    pairs = np.array(words[4 + regions :], int).reshape(-1, 2)
    return area, pairs[:edges], pairs[edges : edges + chroma], pairs[edges + chroma :][:light]


DRAWING = read_drawing()
TO_XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
TO_RELATIVE = TO_XYZ / np.array([[0.95047], [1.0], [1.08883]])
FOOT = (6.0 / 29.0) ** 3


def coloring(xp: Any, x: Any) -> Any:
    area, edges, chroma, light = DRAWING
    v = x.reshape((-1, 3))
    s = sigmoid(xp, v)
    linear = xp.where(s <= 0.04045, s / 12.92, ((s + 0.055) / 1.055) ** 2.4)
    t = linear @ TO_RELATIVE.T
    f = xp.where(t > FOOT, t ** (1.0 / 3.0), t * (841.0 / 108.0) + 4.0 / 29.0)
    l, a, b = 116.0 * f[:, 1] - 16.0, 500.0 * (f[:, 0] - f[:, 1]), 200.0 * (f[:, 1] - f[:, 2])  # noqa: E741
    c2 = a * a + b * b
    saturation = xp.sqrt(c2 / (c2 + l * l))
    share = np.where(np.arange(len(area)) == 0, 0.3, 0.7)
    log = (-0.5 * area * (saturation - share) ** 2).sum()
    i, j = edges[:, 0], edges[:, 1]
    dl, da, db = (z[i] - z[j] for z in (l, a, b))
    apart = np.where((i == 0) | (j == 0), 0.3, 0.2)
    log = log + (-0.5 * ((xp.abs(dl) / 100.0 - apart) / 0.4) ** 2).sum()
    log = log + (-0.5 * ((xp.sqrt(dl * dl + da * da + db * db) / 300.0 - 0.3) / 0.2) ** 2).sum()
    i, j = chroma[:, 0], chroma[:, 1]
    log = log + (-0.5 * ((a[i] - a[j]) ** 2 + (b[i] - b[j]) ** 2) / 25.0).sum()
    i, j = light[:, 0], light[:, 1]
    log = log + (-0.5 * ((l[i] - l[j] - 15.0) / 5.0) ** 2).sum()
    return log + log_jacobian(xp, v).sum()


BLOCKS, FRICTION, TOLERANCE = 6, 0.5, 0.01
#: Half sizes, height, taper, how far the top is moved, the place of the next block on it.
BOUNDS = [(0.3, 1.0)] * 3 + [(0.5, 1.2)] * 2 + [(-0.3, 0.3)] + [(-0.6, 0.6)] * 2
COUNTS = [BLOCKS] * 6 + [BLOCKS - 1] * 2
SHAPE = sum(COUNTS)
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]


def stack(xp: Any, x: Any) -> Any:
    n = BLOCKS
    low = np.repeat([lo for lo, _ in BOUNDS], COUNTS)
    width = np.repeat([hi - lo for lo, hi in BOUNDS], COUNTS)
    shape = low + width * sigmoid(xp, x[:SHAPE])
    ends = np.cumsum(COUNTS)
    hx, hy, h, tx, ty, ux, ox, oy = (shape[e - c : e] for e, c in zip(ends, COUNTS, strict=True))
    push, first, second = (x[SHAPE + 4 * n * k : SHAPE + 4 * n * (k + 1)] for k in range(3))
    normal = xp.exp(push)
    sideways = [FRICTION * normal * (2.0 * sigmoid(xp, v) - 1.0) for v in (first, second)]
    log = log_jacobian(xp, x[:SHAPE]).sum() + 3.0 * push.sum()
    log = log + log_jacobian(xp, first).sum() + log_jacobian(xp, second).sum()
    # Places of blocks: sums over those below.
    zero, below = np.zeros(1), np.tril(np.ones((n, n)), -1)
    top_x, top_y = hx * tx, hy * ty
    cx = xp.concatenate([zero, below[1:, :-1] @ (ux[:-1] + ox * top_x[:-1])])
    cy = xp.concatenate([zero, below[1:, :-1] @ (oy * top_y[:-1])])
    z0 = below @ h
    z1, over = z0 + h, cx + ux
    xs = [cx - hx, cx + hx, cx + hx, cx - hx, over - top_x, over + top_x, over + top_x, over - top_x]
    ys = [cy - hy, cy - hy, cy + hy, cy + hy, cy - top_y, cy - top_y, cy + top_y, cy + top_y]
    corners = list(zip(xs, ys, [z0] * 4 + [z1] * 4, strict=True))
    volume, moment = 0.0, [0.0, 0.0, 0.0]
    for tetrahedron in TETRAHEDRA:
        p, q, r, s = (corners[k] for k in tetrahedron)
        a, b, d = ([u - v for u, v in zip(corner, p, strict=True)] for corner in (q, r, s))
        six = sum(
            a[k] * (b[(k + 1) % 3] * d[(k + 2) % 3] - b[(k + 2) % 3] * d[(k + 1) % 3]) for k in range(3)
        )
        volume = volume + six
        moment = [m + six * (p[k] + q[k] + r[k] + s[k]) for k, m in enumerate(moment)]
    mass = volume / 6.0
    gx, gy, gz = (0.25 * m / volume for m in moment)
    # Contacts: the ground under the first block, above it what two rectangles share.
    shared = [
        xp.concatenate([centre[:1], clip(centre[1:], other[:-1])])
        for centre, other, clip in (
            (cx - hx, over - top_x, xp.maximum),
            (cx + hx, over + top_x, xp.minimum),
            (cy - hy, cy - top_y, xp.maximum),
            (cy + hy, cy + top_y, xp.minimum),
        )
    ]
    px = xp.stack([shared[0], shared[1], shared[1], shared[0]], axis=1)
    py = xp.stack([shared[2], shared[2], shared[3], shared[3]], axis=1)
    fx, fy, fz = (force.reshape((n, 4)) for force in (*sideways, normal))

    def wrench(contacts: slice, blocks: slice) -> list[Any]:
        """Force and torque that contacts put on blocks."""
        rx, ry = px[contacts] - gx[blocks, None], py[contacts] - gy[blocks, None]
        rz = (z0[contacts] - gz[blocks])[:, None]
        u, v, w = fx[contacts], fy[contacts], fz[contacts]
        parts = (u, v, w, ry * w - rz * v, rz * u - rx * w, rx * v - ry * u)
        return [part.sum(axis=1) for part in parts]

    under, over = wrench(slice(n), slice(n)), wrench(slice(1, n), slice(n - 1))
    net = [mine - xp.concatenate([above, zero]) for mine, above in zip(under, over, strict=True)]
    net[2] = net[2] - mass
    width_of_force = TOLERANCE * mass.sum() / n
    width_of_torque = width_of_force * 0.5 * (hx.sum() + hy.sum()) / n
    force = sum((part * part).sum() for part in net[:3])
    torque = sum((part * part).sum() for part in net[3:])
    return log - 0.5 * force / width_of_force**2 - 0.5 * torque / width_of_torque**2
