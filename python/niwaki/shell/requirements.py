"""Requirements beside a model: `requirements.toml`, which a person owns and which results have to keep.

    covered = 0.9          # the least share of the target that a result fills
    outside = 0.1          # the largest share of a result outside of the target
    height = [2.0, 3.0]    # the least and the largest height
    thinnest = 0.002       # the least thickness of a part
    stands = true          # whether a result has to stand on its lowest points
    collisions = false     # whether parts may intersect

Lengths are in units of the scene. A search asks for a target and forbids intersections as always
(`niwaki.targets.asks`). Its results are held against the file, and those that do not keep all of it are left out. If no
result keeps the file, further searches look for many different results, among which one may keep it.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Annotated

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from niwaki import _engine, stacks
from niwaki.draw.scene import Scene
from niwaki.errors import InputError, NiwakiError
from niwaki.errors.schema import Unfit, fitted
from niwaki.inputs.files import text_of
from niwaki.inputs.texts import toml_of
from niwaki.result import Result, Sample
from niwaki.search.collisions import breaking
from niwaki.search.kinds import TOO_FEW, narrow
from niwaki.search.warnings import SearchWarning
from niwaki.shares import percent
from niwaki.shell.references import ModelReference
from niwaki.shell.reports import RequirementRow
from niwaki.targets.sketches import no_self_intersection

NAME = "requirements.toml"
#: The most searches, with consecutive seeds, for a result that keeps the requirements.
ATTEMPTS = 3
#: How many different results a search after the first has, to choose from.
CANDIDATES = 12
#: Points this close to the lowest point, as a share of the height, touch the ground.
CONTACT = 0.01

Share = Annotated[float, Meta(ge=0.0, le=1.0)]
Length = Annotated[float, Meta(ge=0.0)]


class Requirements(Struct, frozen=True, forbid_unknown_fields=True):
    """The requirements of a file; None for those that it does not have."""

    covered: Share | None = None
    outside: Share | None = None
    height: tuple[Length, Length] | None = None
    thinnest: Length | None = None
    stands: bool | None = None
    collisions: bool | None = None

    def rows(self) -> list[RequirementRow]:
        """Return the requirements in words, without a judged run."""
        return [RequirementRow(name, text) for name, (text, _) in self._judges().items()]

    def judged(self, sample: Sample) -> list[RequirementRow]:
        """Hold a run against the requirements."""
        rows = []
        for name, (text, judge) in self._judges().items():
            holds, value = judge(sample)
            rows.append(RequirementRow(name, text, holds, value))
        return rows

    def over(self, samples: Iterable[Sample]) -> list[RequirementRow]:
        """Count the runs that keep each requirement."""
        runs = list(samples)
        each = [self.judged(sample) for sample in runs]
        has_target = any(sample.fit is not None for sample in runs)
        rows = self.rows()
        for place, row in enumerate(rows):
            count = sum(bool(judged[place].holds) for judged in each)
            needs_target = row.name in ("covered", "outside") and not has_target
            row.value = "needs a target" if needs_target else f"kept by {count} of {len(each)} runs"
        return rows

    def unmet(self, sample: Sample) -> list[str]:
        """Return the requirements that a run does not keep, in words."""
        return [f"{row.text}: {row.value}" for row in self.judged(sample) if not row.holds]

    def _judges(self) -> dict[str, tuple[str, Judge]]:
        """Return the text and the judge of each requirement that the file has."""
        judges: dict[str, tuple[str, Judge]] = {}
        if self.covered is not None:
            judges["covered"] = f"at least {percent(self.covered)} covered", self._covers
        if self.outside is not None:
            judges["outside"] = f"at most {percent(self.outside)} outside", self._stays_inside
        if self.height is not None:
            low, high = self.height
            judges["height"] = f"height {low:g} to {high:g}", self._has_height
        if self.thinnest is not None:
            judges["thinnest"] = f"no part thinner than {self.thinnest:g}", self._is_thick
        if self.stands:
            judges["stands"] = "stands", _stands
        if self.collisions is False:
            judges["collisions"] = "no parts intersect", _is_free
        return judges

    def _covers(self, sample: Sample) -> tuple[bool, str]:
        if sample.fit is None:
            return False, "there is no target"
        return sample.fit.covered >= (self.covered or 0.0), f"{percent(sample.fit.covered)} covered"

    def _stays_inside(self, sample: Sample) -> tuple[bool, str]:
        if sample.fit is None:
            return False, "there is no target"
        most = 1.0 if self.outside is None else self.outside
        return sample.fit.outside <= most, f"{percent(sample.fit.outside)} outside"

    def _has_height(self, sample: Sample) -> tuple[bool, str]:
        height = _height(sample.scene)
        low, high = self.height or (0.0, np.inf)
        return low <= height <= high, f"height {height:.4g}"

    def _is_thick(self, sample: Sample) -> tuple[bool, str]:
        widths = [(thickness(shape), part.address) for part in sample.scene.parts for shape in part.shapes]
        if not widths:
            return True, "no parts"
        width, address = min(widths)
        # A width is a difference of coordinates, which rounds.
        least = (self.thinnest or 0.0) * (1.0 - 1e-9)
        return width >= least, f"{sample.search.model.labels.label(address)} is {width:.4g} thick"


Judge = Callable[[Sample], tuple[bool, str]]


def beside(reference: ModelReference) -> Requirements | None:
    """Return the requirements beside the file of a model; None without a file of requirements.

    Raises
    ------
    InputError
        `bad-requirements`.
    """
    if reference.file_hash is None:
        return None
    place = Path(reference.name.rpartition(":")[0]).parent / NAME
    return load(place) if place.is_file() else None


def load(place: Path) -> Requirements:
    """Read a file of requirements.

    Raises
    ------
    InputError
        `bad-requirements`.
    """
    try:
        rules: Requirements = fitted(toml_of(text_of(place, "preset", "requirements"), place), Requirements)
        if rules.height is not None and rules.height[0] > rules.height[1]:
            raise Unfit("$.height", "the least height first", str(list(rules.height)))
    except Unfit as error:
        raise InputError("bad-requirements", path=place, reason=str(error)) from error
    return rules


def keeping(
    rules: Requirements | None, attempt: Callable[[int, int], Result], seed: int, count: int
) -> Result:
    """Search until there are results that keep the requirements.

    Parameters
    ----------
    rules
        The requirements; None for none.
    attempt
        A search with a seed for a number of results that differ.
    seed
        The first seed; further searches have the seeds after it.
    count
        The number of results that are wanted.

    Returns
    -------
    Result
        The results that keep all requirements. If no search has such results: those of the first search.
    """
    first = attempt(seed, count)
    if rules is None:
        return first
    result = first
    for number in range(1, ATTEMPTS + 1):
        good = [place for place, sample in enumerate(result.samples) if not rules.unmet(sample)]
        if good:
            narrow(result, good[:count])
            return result
        if number < ATTEMPTS and not result.interrupted:
            # What is wanted is results that keep the requirements, not as many as there are candidates.
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", TOO_FEW, SearchWarning)
                result = attempt((seed + number) % 2**53, max(count, CANDIDATES))
    return first


def thickness(shape: _engine.Shape) -> float:
    """Return the least width of a solid along the normals of its faces: of a hollow one, not that of its wall."""
    ((vertices, faces, *_),) = _engine.meshes([[shape]], fine=True)
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals = np.unique(np.round(normals[lengths > 0] / lengths[lengths > 0, None], 9), axis=0)
    if not len(normals):
        return 0.0
    along = vertices @ normals.T
    return float((along.max(axis=0) - along.min(axis=0)).min())


def _height(scene: Scene) -> float:
    return float(scene.size[1]) if len(scene) else 0.0


def _is_free(sample: Sample) -> tuple[bool, str]:
    """Whether no parts of a run intersect."""
    addresses = breaking(sample.scene, no_self_intersection().specs)
    names = [sample.search.model.labels.label(address) for address in addresses[:3]]
    return not addresses, f"{', '.join(names)} intersect" if addresses else "no parts intersect"


def _stands(sample: Sample) -> tuple[bool, str]:
    """Whether a run stands: blocks by the forces between them, any other scene as one solid on its lowest points."""
    value = sample.value
    if hasattr(value, "blocks") and hasattr(value, "contacts"):
        try:
            holds = stacks.balanced(stacks.Structure.of(sample), margin=False).holds
        except NiwakiError as error:
            return False, str(error).partition("\n")[0]
        return holds, "forces hold all blocks" if holds else "no forces hold all blocks"
    if not len(sample.scene):
        return False, "the scene is empty"
    vertices, faces = sample.scene.merged(fine=False)
    low, high = vertices[:, 1].min(), vertices[:, 1].max()
    feet = vertices[vertices[:, 1] <= low + CONTACT * (high - low)][:, [0, 2]]
    over = _overhang(feet, _middle(vertices, faces)[[0, 2]])
    if over <= 0.0:
        return True, "its weight is above its feet"
    return False, f"its weight is {over:.4g} beside its feet"


def _middle(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the centre of mass of closed surfaces of one density."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    if not abs(volumes.sum()) > 0.0:
        return np.asarray(vertices.mean(axis=0), dtype=np.float64)
    middle: NDArray[np.float64] = ((a + b + c) * volumes[:, None]).sum(axis=0) / (4.0 * volumes.sum())
    return middle


def _overhang(points: NDArray[np.float64], at: NDArray[np.float64]) -> float:
    """Return how far a point of the plane lies outside of the convex hull of points; 0 or less inside."""
    hull = _hull(points)
    if len(hull) < 3:
        start, along = hull[0], hull[-1] - hull[0]
        share = np.clip((at - start) @ along / max(along @ along, 1e-300), 0.0, 1.0)
        return float(np.linalg.norm(at - start - share * along))
    edges = np.roll(hull, -1, axis=0) - hull
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1) / np.linalg.norm(edges, axis=1)[:, None]
    return float(((at - hull) * normals).sum(axis=1).max())


def _hull(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the corners of the convex hull of points of the plane, counterclockwise (Andrew's monotone chain)."""
    ordered = np.unique(points, axis=0)
    chains = []
    for row in (ordered, ordered[::-1]):
        chain: list[NDArray[np.float64]] = []
        for point in row:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-1] - chain[-2], point - chain[-2]
                if ax * by - ay * bx > 0.0:
                    break
                chain.pop()
            chain.append(point)
        chains += chain[:-1]
    return np.array(chains) if chains else ordered
