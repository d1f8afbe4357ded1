"""Two judges of a structure, independent of the model's soft balance: a linear program and a simulation.

`balanced` solves a linear program (HiGHS, through SciPy) for contact forces in the friction cone that hold each block
exactly. The program is elastic: it always has a solution, with the smallest residual. `simulated` simulates the blocks
as rigid bodies in MuJoCo for some seconds.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from niwaki.errors import FileError
from niwaki.errors.extras import optional
from niwaki.stacks.structure import Floats, Structure

#: A residual up to this share of the mean weight counts as balance.
BALANCE = 1e-6

#: Sides of the polygon inside the friction cone: at most half a percent too strict.
SIDES = 32

#: A block that moves farther than this share of its size has fallen.
FALLEN = 0.05

#: Number of directions in which `Balance.margin` pushes.
PUSHES = 8


@dataclass(frozen=True)
class Balance:
    """The result of the linear program.

    Attributes
    ----------
    residual : float
        The largest unbalanced force or torque, in mean weights and mean weights times the cube root of the mean volume,
        with the forces that make it smallest; the worst of all directions of gravity and steps of construction.
    margin : float
        The largest sideways push that leaves balance, as a share of each block's weight, in the worst of eight
        directions. It is the tangent of the tilt at which the structure falls; 0 without balance, NaN if it was not
        computed.
    """

    residual: float
    margin: float

    @property
    def holds(self) -> bool:
        """Whether forces exist that hold all blocks."""
        return self.residual <= BALANCE


def balanced(structure: Structure, cone: bool = True, margin: bool = True) -> Balance:
    """Find contact forces that hold all blocks.

    Parameters
    ----------
    structure
        The structure.
    cone
        Whether friction stays in a polygon of 32 sides inside Coulomb's cone; else in the original's pyramid around it.
    margin
        Whether to compute the margin, which takes eight more programs.

    Raises
    ------
    FileError
        SciPy is missing (extra `stacks`).
    """
    worst = Balance(0.0, np.inf)
    for count in structure.prefixes:
        part = structure.first(count)
        rays, weights = program(part, cone)
        for down in structure.downs:
            residual = _residual(rays, weights, down)
            holds = residual <= BALANCE
            least = 0.0
            if holds and margin:
                least = min(_margin(rays, weights, down, k) for k in range(PUSHES))
            worst = Balance(max(worst.residual, residual), min(worst.margin, least))
    return worst if margin else Balance(worst.residual, np.nan)


def program(part: Structure, cone: bool) -> tuple[Any, Floats]:
    """Return the scaled matrix from sizes of rays to forces and torques (6 rows a block), and relative weights."""
    sparse = need("scipy.sparse")
    volumes, centres = part.solids()
    weights = volumes / volumes.mean()
    size = volumes.mean() ** (1.0 / 3.0)
    sides = SIDES if cone else 4
    angles = 2.0 * np.pi * np.arange(sides) / sides + (0.0 if cone else np.pi / 4.0)
    reach = part.friction * (1.0 if cone else np.sqrt(2.0))
    columns = []
    for touch in part.touches:
        normal, along, across = touch.frame
        tangents = np.cos(angles)[:, None] * along + np.sin(angles)[:, None] * across
        rays = normal + reach * tangents
        for point in touch.points:
            block = np.zeros((len(part), 6, sides))
            for body, sign in ((touch.second, 1.0), (touch.first, -1.0)):
                if body >= 0:
                    block[body, :3] = sign * rays.T
                    block[body, 3:] = sign * np.cross(point - centres[body], rays).T / size
            columns.append(block.reshape(6 * len(part), sides))
    return sparse.csc_array(np.concatenate(columns, axis=1)), weights


def loads_of(weights: Floats, direction: Floats) -> Floats:
    """Return the weights in a direction, with torques of zero."""
    loads = np.zeros((len(weights), 6))
    loads[:, :3] = weights[:, None] * direction
    return loads.reshape(-1)


def _residual(rays: Any, weights: Floats, down: Floats) -> float:
    """Return the smallest residual, which is the largest unbalanced force or torque."""
    sparse, optimize = need("scipy.sparse"), need("scipy.optimize")
    rows, columns = rays.shape
    slack = sparse.csc_array(-np.ones((rows, 1)))
    above = sparse.vstack([sparse.hstack([rays, slack]), sparse.hstack([-rays, slack])]).tocsc()
    loads = loads_of(weights, down)
    cost = np.zeros(columns + 1)
    cost[-1] = 1.0
    solution = solved(optimize.linprog(cost, A_ub=above, b_ub=np.concatenate([-loads, loads])))
    # The solver satisfies its constraints to 1e-7 only: compute the residual of its forces.
    return float(np.abs(rays @ np.maximum(solution.x[:-1], 0.0) + loads).max())


def _margin(rays: Any, weights: Floats, down: Floats, direction: int) -> float:
    """Return the largest push in a direction across gravity."""
    sparse, optimize = need("scipy.sparse"), need("scipy.optimize")
    side = np.cross(down, (0.0, 1.0, 0.0) if abs(down[1]) < 0.9 else (1.0, 0.0, 0.0))
    side /= np.linalg.norm(side)
    angle = 2.0 * np.pi * direction / PUSHES
    push = np.cos(angle) * side + np.sin(angle) * np.cross(down, side)
    equal = sparse.hstack([rays, sparse.csc_array(loads_of(weights, push)[:, None])]).tocsc()
    cost = np.zeros(equal.shape[1])
    cost[-1] = -1.0
    solution = optimize.linprog(cost, A_eq=equal, b_eq=-loads_of(weights, down))
    return float(solution.x[-1]) if solution.status == 0 else 0.0


def solved(solution: Any) -> Any:
    """Return a solution of the solver; raise an error if there is none."""
    if solution.status != 0:
        raise FileError("program-unsolved", reason=str(solution.message))
    return solution


@dataclass(frozen=True)
class Simulation:
    """The result of the simulation.

    Attributes
    ----------
    moved : float
        The longest way of a block's centre of mass, as a share of the block's size (the cube root of its volume).
    block : int
        The number of this block.
    each : tuple of float
        The way of each block, in the worst case; the simulation ends when a block has moved by its own size.
    """

    moved: float
    block: int
    each: tuple[float, ...] = ()

    @property
    def fallen(self) -> tuple[int, ...]:
        """The numbers of the blocks that moved farther than 5 % of their size."""
        return tuple(number for number, share in enumerate(self.each) if not share <= FALLEN)

    @property
    def stands(self) -> bool:
        """Whether all blocks moved by at most 5 % of their size."""
        return self.moved <= FALLEN


def simulated(structure: Structure, seconds: float = 5.0, time_step: float = 0.0005) -> Simulation:
    """Simulate the blocks in MuJoCo as rigid bodies, with elliptic friction cones and the structure's coefficient.

    Parameters
    ----------
    structure
        The structure, which is simulated for each of its directions of gravity and steps of construction.
    seconds
        Simulated time of each simulation.
    time_step
        Time step in seconds. A contact yields by about gravity times the square of twice the step, which sets the
        hardness of blocks.

    Raises
    ------
    FileError
        MuJoCo is missing (extra `stacks`).
    """
    parts = [structure.first(count) for count in structure.prefixes]
    simulations = [_run(part, down, seconds, time_step) for part in parts for down in structure.downs]
    return max(simulations, key=lambda simulation: simulation.moved)


def _run(part: Structure, down: Floats, seconds: float, time_step: float) -> Simulation:
    mujoco: Any = need("mujoco")
    machine = mujoco.MjModel.from_xml_string(_document(part, down, time_step))
    state = mujoco.MjData(machine)
    mujoco.mj_forward(machine, state)
    start = state.xipos[1:].copy()
    volumes, _ = part.solids()
    sizes = np.cbrt(volumes)
    steps = round(seconds / time_step)
    moved = np.zeros(len(part))
    for step in range(steps):
        mujoco.mj_step(machine, state)
        if step % 50 == 49 or step == steps - 1:
            moved = np.linalg.norm(state.xipos[1:] - start, axis=1) / sizes
            if not np.isfinite(moved).all() or moved.max() > 1.0:
                break
    moved = np.nan_to_num(moved, nan=np.inf)
    return Simulation(float(moved.max()), int(moved.argmax()), tuple(moved.tolist()))


def _document(part: Structure, down: Floats, time_step: float) -> str:
    """Return the structure in MuJoCo's format."""
    gravity = " ".join(repr(float(x)) for x in 9.81 * down)
    floor = _floor(part)
    assets, bodies = [], []
    for number, corners in enumerate(part.corners):
        middle = corners.mean(axis=0)
        text = " ".join(repr(float(x)) for x in (corners - middle).reshape(-1))
        place = " ".join(repr(float(x)) for x in middle)
        assets.append(f'<mesh name="b{number}" vertex="{text}"/>')
        bodies.append(
            f'<body pos="{place}"><freejoint/>'
            f'<geom type="mesh" mesh="b{number}" density="700"/></body>'
        )  # fmt: skip
    return f"""<mujoco>
 <option timestep="{time_step!r}" gravity="{gravity}" cone="elliptic" impratio="10" integrator="implicitfast"
  iterations="50"><flag multiccd="enable"/></option>
 <size memory="64M"/>
 <default><geom friction="{part.friction!r} 0 0" condim="3" solref="{2.0 * time_step!r} 1"
  solimp="0.95 0.99 0.0005"/></default>
 <asset>{"".join(assets)}</asset>
 <worldbody><geom type="plane" size="0 0 1" pos="0 0 {floor!r}"/>{"".join(bodies)}</worldbody>
</mujoco>"""


def _floor(part: Structure) -> float:
    """Return the height of the ground."""
    heights = [touch.points[:, 2].mean() for touch in part.touches if min(touch.first, touch.second) < 0]
    return float(np.mean(heights))


def need(module: str) -> Any:
    """Import a library of the extra `stacks`, or raise an error that names the extra."""
    return optional(module, "judging a structure", "stacks")
