"""The experiments of dissertation chapter 5 on our own targets: each model, its target, and its number of particles.

Table 5.1 with the cameras, lights and widths of figures 5.1 to 5.8. All of them also forbid self-intersection. Targets
are ours throughout, and so is the camera in front of the ship, which is not on record.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from niwaki import kernels
from niwaki.gallery import entry, named_target
from niwaki.methods import Mh, mh
from niwaki.targets import examples as targets

if TYPE_CHECKING:
    from niwaki.result import Result
    from niwaki.targets.sketches import Score

Triple = tuple[float, float, float]

#: How we would search instead of by whole scores: with correct weights, judging more sharply barrier by barrier.
RECOMMENDED: dict[str, Any] = {"power": 8.0, "anneal": [min(8.0, 2.0 + 0.2 * k) for k in range(1, 32)]}


@dataclass(frozen=True)
class Experiment:
    """The data of a figure's model.

    Attributes
    ----------
    name : str
        Of the experiment.
    figure : str
        In the dissertation.
    model : str
        Entry of the gallery.
    particles : int
        How many the original took.
    sigma : float
        Standard deviation of the score.
    fill, avoid : str or None
        Targets: what to fill, what to stay away from.
    voxel : float or None
        Cell size of both, scene units.
    image, weights : str or None
        What the silhouette or the shadow should be, and where it matters most.
    camera : dict
        From where the image is seen, as in a camera's JSON file.
    light : triple of float or None
        Direction in which light travels, where the image is that of a shadow.
    floor : float
        Half the side of the square floor that the shadow falls on, scene units.
    ours : dict
        Settings of `smc` that we would take instead, where they differ from `RECOMMENDED`.
    polish : Mh or None
        How we would go on from the best of them.
    """

    name: str
    figure: str
    model: str
    particles: int
    sigma: float
    fill: str | None = None
    avoid: str | None = None
    voxel: float | None = None
    image: str | None = None
    weights: str | None = None
    camera: dict[str, Any] = field(default_factory=dict)
    light: Triple | None = None
    floor: float = 13.65
    ours: dict[str, Any] = field(default_factory=dict)
    polish: Mh | None = None

    def score(self, rule: str = "solid") -> Score:
        """Create its score, on our own targets; `rule` is that of `no_self_intersection`."""
        from niwaki.targets import sketches

        score = sketches.no_self_intersection(rule)
        if self.avoid is not None:
            score = score * sketches.floor() * sketches.avoid(named_target(self.avoid), self.voxel)
        if self.fill is not None:
            score = score * sketches.match_volume(named_target(self.fill), self.voxel, self.sigma)
        return score if self.image is None else score * self._view(self.image)

    def _view(self, name: str) -> Score:
        from niwaki.targets import sketches
        from niwaki.targets.target import Receiver

        image = targets.image(name)
        heavy = None if self.weights is None else targets.image(self.weights)
        if self.light is None:
            return sketches.match_image(image, self.camera, weight_image=heavy, sigma=self.sigma)
        ground = Receiver.floor(0.0, (-self.floor, -self.floor), (self.floor, self.floor))
        return sketches.match_shadow(
            image, self.light, ground, self.camera, weight_image=heavy, sigma=self.sigma
        )

    def settings(self, preset: str = "original") -> dict[str, Any]:
        """Settings of `smc`: "original" for whole scores and the original's particles, or "ours"."""
        if preset == "original":
            return {"particles": self.particles, "weights": "absolute"}
        return {"particles": self.particles} | RECOMMENDED | self.ours

    def run(
        self,
        preset: str = "original",
        *,
        seed: int = 1,
        threads: int | None = None,
        steps: int | None = None,
        **settings: Any,
    ) -> Result:
        """Search, in a stochastic order, and with "ours" go on from the best.

        Parameters
        ----------
        preset
            As for `settings`.
        seed, threads
            As for `niwaki.run`.
        steps
            Proposals of the chain that goes on, instead of its own number.
        settings
            Of `smc`, instead of those of the preset.
        """
        from niwaki.methods import smc
        from niwaki.search import run

        gallery_entry = entry(self.model)
        assert gallery_entry is not None
        method = smc(**(self.settings(preset) | settings))
        result = run(gallery_entry.model, method=method, score=self.score(), seed=seed, threads=threads)
        if preset == "original" or self.polish is None:
            return result
        onward = self.polish if steps is None else replace(self.polish, steps=steps)
        return result.polish(onward, threads=threads)


#: From a street corner, across the first tower.
STREET = {
    "kind": "perspective",
    "position": [31.0552, 1.83332, 33.0193],
    "look_at": [-3.07631, 5.13738, 0.527147],
    "up": [0.0506582, 0.997551, 0.0482248],
    "fov_degrees": 45.0,
}
#: Level with the ship, in front of its nose: about 12 units across.
BOW = {"kind": "perspective", "position": [0.0, 0.3, 14.5], "look_at": [0.0, 0.3, 0.0], "fov_degrees": 45.0}
#: Straight down on the floor.
CEILING = {
    "kind": "perspective",
    "position": [0.0, 38.0, 0.0],
    "look_at": [0.0, 0.0, 0.0],
    "up": [0.0, 0.0, -1.0],
    "fov_degrees": 45.0,
}
#: The same without perspective: the floor from edge to edge.
PLAN = {
    "kind": "orthographic",
    "position": [0.0, 38.0, 0.0],
    "look_at": [0.0, 0.0, 0.0],
    "up": [0.0, 0.0, -1.0],
    "height": 27.3,
}

#: Around obstacles many starts become impossible, and a sharp eye leaves too few others.
AROUND: dict[str, Any] = {"particles": 300, "power": 4.0, "anneal": None}
#: An image that is nearly empty is matched to nine tenths by nothing: scores are close together, so judge sharply.
FRONT: dict[str, Any] = {"power": 64.0, "anneal": None}
#: Seven storeys on each other are rare: more particles find them.
TOWERS: dict[str, Any] = {"particles": 1000, "anneal": None}
#: Blocks hardly depend on each other, so that a move of one costs microseconds: one result of many is followed far.
BLOCKS: dict[str, Any] = {
    "anneal": None,
    "rejuvenate": kernels.mixture(kernels.prior(), kernels.drift(0.1), kernels.drift(0.02)),
    "moves": 1000,
    "at": "end",
    "draws": 100,
}
#: A sigma of thirty pixels is sharp enough, too sharp at first: one pipe then outweighs all others. Nets that end early
#: are a matter of luck, so there are eight populations. In a chain ends that have stopped grow
#: on, and pipes in the wrong go.
NETS: dict[str, Any] = {"populations": 8, "power": 1.0, "anneal": 0.5}
FILLED = mh(200_000, keep=0)

EXPERIMENTS = (
    Experiment("ship", "5.1", "spaceship", 300, 0.02, fill="ship", voxel=0.25),
    Experiment("tree", "5.1", "gnarly-tree", 300, 0.02, fill="forked_tree", voxel=0.4),
    Experiment("tall-tree", "5.9c", "gnarly-tree", 300, 0.02, fill="bent_tube", voxel=0.4),
    Experiment("building", "5.3", "building", 300, 0.02, fill="crescent", voxel=0.25),
    Experiment(
        "tree-and-ledges",
        "5.4",
        "gnarly-tree",
        100,
        0.05,
        fill="funnel",
        avoid="ledges",
        voxel=0.4,
        ours=AROUND,
    ),
    Experiment(
        "tree-and-emblem", "5.4", "gnarly-tree", 100, 0.05, fill="gem", avoid="emblem", voxel=0.4, ours=AROUND
    ),
    Experiment("skyline", "5.5", "building", 300, 0.02, image="skyline", camera=STREET, ours=TOWERS),
    Experiment("ship-front", "5.6", "spaceship", 300, 0.02, image="ship_front", camera=BOW, ours=FRONT),
    Experiment(
        "face-of-blocks",
        "5.7",
        "toy-blocks",
        1500,
        0.002,
        image="face",
        weights="face_stroke",
        camera=CEILING,
        light=(-1.0, -0.3, 0.0),
        ours=BLOCKS,
    ),
    Experiment(
        "digits-of-pipes",
        "5.8",
        "pipes",
        100,
        0.0005,
        image="digits",
        camera=PLAN,
        light=(0.0, -1.0, 0.0),
        ours=NETS,
        polish=FILLED,
    ),
)


def experiment(name: str) -> Experiment:
    """Find the experiment of that name."""
    return next(candidate for candidate in EXPERIMENTS if candidate.name == name)
