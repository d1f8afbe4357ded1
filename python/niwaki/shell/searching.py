"""How to search, as flags: `--method smc`, `particle-gibbs` or `pimh`, and the settings of each.

A setting that the chosen method does not have is refused, not forgotten.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

import typer

from niwaki.errors import InputError

if TYPE_CHECKING:
    from niwaki.methods import Method, Mh

METHODS = ("smc", "particle-gibbs", "pimh")

MethodName = Annotated[
    str, typer.Option("--method", metavar="NAME", help="smc, particle-gibbs or pimh.", show_default=True)
]
Particles = Annotated[
    int | None,
    typer.Option("-n", "--particles", help="Size of a population; default: what suits the model, or 300."),
]
Order = Annotated[str, typer.Option("--order", help="stochastic or depth-first.")]
Weights = Annotated[str | None, typer.Option("--weights", help="smc: ratio (the default) or absolute.")]
Temper = Annotated[
    float | None,
    typer.Option("--temper", help="Sharpening of the search; default: 16, with absolute weights 1."),
]
Anneal = Annotated[
    str | None,
    typer.Option(
        "--anneal",
        metavar="WAY",
        help="Sharpening on the way: a share of the particles to keep, or one number for each barrier, with commas.",
    ),
]
Resampling = Annotated[
    str | None,
    typer.Option("--resampling", help="systematic (the default), residual, stratified or multinomial."),
]
Ess = Annotated[
    float | None,
    typer.Option("--ess", help="Resample below this share of effective particles; default: always."),
]
Populations = Annotated[
    int | None, typer.Option("--populations", metavar="M", help="smc: so many populations side by side.")
]
Diverse = Annotated[
    int | None, typer.Option("--diverse", metavar="K", help="smc: so many results that differ, for each run.")
]
Seconds = Annotated[
    float | None, typer.Option("--seconds", metavar="S", help="smc: a time to spend instead of -n.")
]
Sweeps = Annotated[
    int | None, typer.Option("--sweeps", help="particle-gibbs, pimh: length of the chain; default: 100.")
]
Rejuvenate = Annotated[
    str | None,
    typer.Option(
        "--rejuvenate",
        metavar="KERNEL",
        help='smc: how particles are moved, as in Python: "mh()", "cycle(mh(), drift(0.1))".',
    ),
]
Moves = Annotated[
    int | None, typer.Option("--moves", help="With --rejuvenate: proposals for each particle; default: 1.")
]
At = Annotated[
    str | None,
    typer.Option(
        "--at",
        metavar="WHEN",
        help="With --rejuvenate: end, resampled, or at every so-many-th barrier; default: 1, each.",
    ),
]
Draws = Annotated[
    int | None,
    typer.Option(
        "--draws", help="With --rejuvenate: so many states of a chain from the final set, instead of it."
    ),
]
Chains = Annotated[
    int | None, typer.Option("--chains", help="With --draws: from so many of the final set; default: 1.")
]
Ancestors = Annotated[
    bool | None,
    typer.Option(
        "--ancestors/--no-ancestors", help="particle-gibbs: draw the past of the held run anew; default: so."
    ),
]

Polish = Annotated[
    int | None,
    typer.Option("--polish", metavar="STEPS", help="Go on from the best: so many proposals of a chain."),
]
PolishKernel = Annotated[
    str | None,
    typer.Option("--polish-kernel", metavar="KERNEL", help='With --polish: how it moves; default: "mh()".'),
]

#: Which methods have a setting that not all have.
OWNERS = {
    "weights": ("smc",),
    "populations": ("smc",),
    "diverse": ("smc",),
    "seconds": ("smc",),
    "sweeps": ("particle-gibbs", "pimh"),
    "resampling": ("smc", "pimh"),
    "rejuvenate": ("smc",),
    "ancestors": ("particle-gibbs",),
}
#: Settings that need another: which, and why.
NEEDS = {
    "moves": ("rejuvenate", "it says how particles are moved"),
    "at": ("rejuvenate", "it says how particles are moved"),
    "draws": ("rejuvenate", "it says how chains move"),
    "chains": ("draws", "it says how many states of each chain are kept"),
}


@dataclass(frozen=True)
class Search:
    """The search as it was typed; None where nothing was said."""

    method: str = "smc"
    particles: int | None = None
    order: str = "stochastic"
    weights: str | None = None
    temper: float | None = None
    anneal: str | None = None
    resampling: str | None = None
    ess: float | None = None
    populations: int | None = None
    diverse: int | None = None
    seconds: float | None = None
    sweeps: int | None = None
    rejuvenate: str | None = None
    moves: int | None = None
    at: str | None = None
    draws: int | None = None
    chains: int | None = None
    ancestors: bool | None = None

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            listed = ", ".join(METHODS[:-1]) + " or " + METHODS[-1]
            raise InputError(
                "bad-setting",
                name="--method",
                found=repr(self.method),
                expected=f"one of {listed}",
                suggestion="smc",
            )
        for name, owners in OWNERS.items():
            if getattr(self, name) is not None and self.method not in owners:
                other = " or ".join(f"`--method {owner}`" for owner in owners)
                reason = f"`--method {self.method}` has no such setting"
                raise InputError("flag-alone", flag=f"--{name}", other=other, reason=reason)
        for name, (other, reason) in NEEDS.items():
            if getattr(self, name) is not None and getattr(self, other) is None:
                raise InputError("flag-alone", flag=f"--{name}", other=f"`--{other}`", reason=reason)
        if self.seconds is not None:
            for flag, given in (("-n", self.particles), ("--populations", self.populations)):
                if given is not None:
                    raise InputError(
                        "flags-exclude",
                        flag="--seconds",
                        other=flag,
                        reason="a time to spend decides how many particles there are, in how many populations",
                        cure=f"give the one or the other; run.json keeps what {self.seconds:g} s came to",
                    )

    def settings(self, usual: int) -> dict[str, Any]:
        """The search as plain data, every default filled in; `usual` is the number of particles that suits."""
        from niwaki.search import default_temper

        weights = self.weights or "ratio"
        found: dict[str, Any] = {
            "method": self.method,
            "particles": usual if self.particles is None else self.particles,
            "order": self.order,
            "temper": default_temper(weights) if self.temper is None else self.temper,
            "anneal": _way(self.anneal),
            "ess": self.ess,
        }
        if self.method == "smc":
            found |= {"weights": weights, "populations": self.populations, "diverse": self.diverse}
            found["seconds"] = self.seconds
            if self.rejuvenate is not None:
                found |= {"rejuvenate": self.rejuvenate, "moves": 1 if self.moves is None else self.moves}
                found |= {"at": _moment(self.at), "draws": self.draws}
                found["chains"] = 1 if self.chains is None else self.chains
        else:
            found["sweeps"] = 100 if self.sweeps is None else self.sweeps
        if self.method == "particle-gibbs":
            found["ancestors"] = self.ancestors is not False
        if self.method != "particle-gibbs":
            found["resampling"] = self.resampling or "systematic"
        return found


def method(settings: dict[str, Any]) -> Method:
    """The method that such settings name, checked."""
    from niwaki import kernels
    from niwaki.methods import particle_gibbs, pimh, smc

    makers: dict[str, Callable[..., Method]] = {"smc": smc, "particle-gibbs": particle_gibbs, "pimh": pimh}
    given = {key: value for key, value in settings.items() if key != "method"}
    if "rejuvenate" in given:
        given["rejuvenate"] = kernels.parse(given["rejuvenate"])
    return makers[settings["method"]](**given)


def polish(steps: int | None, kernel: str | None) -> Mh | None:
    """The chain that goes on from the best, if there is to be one."""
    from niwaki import kernels
    from niwaki.methods import mh

    if steps is None:
        if kernel is None:
            return None
        reason = "it says how the chain moves"
        raise InputError("flag-alone", flag="--polish-kernel", other="`--polish`", reason=reason)
    return mh(steps, kernel=None if kernel is None else kernels.parse(kernel), keep=0)


def _moment(text: str | None) -> int | str:
    """A number of barriers, or the name of a moment."""
    if text is None:
        return 1
    return int(text) if text.isdecimal() else text


def _way(text: str | None) -> float | list[float] | None:
    """One number is a share, several are the way."""
    if text is None:
        return None
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        raise InputError(
            "bad-setting",
            name="--anneal",
            found=repr(text),
            expected="a share of the particles, or numbers with commas between them",
            suggestion="such numbers, for instance 1,2,4,8,16",
        ) from None
    return found[0] if len(found) == 1 else found
