"""Markov kernels as values, for `niwaki.mh(kernel=...)`.

Leaves propose: `prior`, `drift`, `neighbour`, `proposal` change one choice, `block` and `regenerate` many; `hmc_step`
and `nuts_step` move the continuous ones along their gradient. Branches select the next leaf: `cycle`, `mixture`,
`repeat`; `on` restricts a kernel to some choices, `weighted` gives them selection weights, `anneal` and `tempering`
change the power of the score. One application of `cycle(a, b)` is one of `a` and then one of `b`.

>>> from niwaki import kernels
>>> kernel = kernels.cycle(kernels.on("z", kernels.prior()), kernels.repeat(3, kernels.on("mean*", kernels.drift())))

Patterns are compared with readable addresses: `*` and `?` stand for text within one component, `**` for any text; a
pattern without `/` is compared with the last component.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any

from msgspec import Struct

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.schema import fitted, inside
from niwaki.errors.settings import bad, real
from niwaki.methods.guide import Guide
from niwaki.methods.refusals import as_real, checked

__all__ = [
    "Kernel",
    "anneal",
    "block",
    "cycle",
    "drift",
    "guided",
    "hmc_step",
    "mixture",
    "neighbour",
    "nuts_step",
    "on",
    "original",
    "parse",
    "prior",
    "proposal",
    "regenerate",
    "regrow",
    "repeat",
    "tempering",
    "weighted",
]

#: Depths at which a function of the depth is evaluated; the last value holds for all deeper ones.
_DEEPEST = 256


class _KernelData(Struct):
    """A kernel as data; its parts are checked when they are read."""

    name: str
    settings: dict[str, Any] = {}
    parts: list[dict[str, Any]] = []
    function: dict[str, Any] | None = None


@dataclass(frozen=True)
class Kernel:
    """A Markov kernel: a name, its settings by name, and the kernels in it."""

    name: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    parts: tuple[Kernel, ...] = ()
    function: Any = field(default=None, compare=False)

    def __post_init__(self) -> None:
        """Check the settings; the parts have checked theirs."""
        checked(_engine.check_kernel, {"name": self.name, "settings": self.settings}, self.settings, {})

    def data(self, function: Callable[[Any], Any]) -> dict[str, Any]:
        """The kernel as plain data; `function` writes a user's proposal or a guide."""
        found: dict[str, Any] = {"name": self.name}
        if self.settings:
            found["settings"] = dict(self.settings)
        if self.parts:
            found["parts"] = [part.data(function) for part in self.parts]
        if self.function is not None:
            found["function"] = function(self.function)
        return found

    @classmethod
    def of_data(cls, data: Mapping[str, Any], function: Callable[[Any], Any]) -> Kernel:
        """The kernel of its data; `function` reads a user's proposal or a guide.

        Raises
        ------
        Unfit
            It is not a kernel's data.
        """
        fitted(data, _KernelData)
        parts = []
        for number, part in enumerate(data.get("parts", ())):
            with inside(f".parts[{number}]"):
                parts.append(cls.of_data(part, function))
        with inside(".function"):
            own = function(data["function"]) if "function" in data else None
        return cls(data["name"], dict(data.get("settings", {})), tuple(parts), own)

    def leaves(self) -> list[Kernel]:
        """The kernels that propose, in order, each with the restrictions that hold for it."""
        if not self.parts:
            return [self]
        inner = [leaf for part in self.parts for leaf in part.leaves()]
        return [Kernel("on", self.settings, (leaf,)) for leaf in inner] if self.name == "on" else inner

    def first(self, *names: str) -> Kernel | None:
        """The first kernel with one of these names: this one or one of its parts."""
        if self.name in names:
            return self
        return next((found for part in self.parts if (found := part.first(*names)) is not None), None)

    @property
    def follows(self) -> bool:
        """Whether a leaf of it follows the gradient."""
        return self.first("hmc_step", "nuts_step") is not None

    def __repr__(self) -> str:
        own = self.settings
        if self.name in ("hmc_step", "nuts_step"):
            shown = [f"{key}={value}" for key, value in own.items() if key not in ("steps", "max_depth")]
            length = str(own["steps" if self.name == "hmc_step" else "max_depth"])
            return f"{self.name}({', '.join([length, *(one for one in shown if one != 'jitter=0.0')])})"
        if self.name == "on":
            (inner,) = self.parts
            if own["sites"]:
                return f"on({own['sites'][0]!r}, {inner!r})"
            depth = ", depth=..." if own["depth"] else ""
            sites = f", sites={dict(own['weights'])!r}" if own["weights"] else ""
            return f"weighted({inner!r}{depth}{sites})"
        if self.name == "mixture":
            weights = ", ".join(map(repr, own["weights"]))
            return f"mixture({weights}, {', '.join(map(repr, self.parts))})"
        if self.name == "regrow":
            named = own["pick"] if isinstance(own["pick"], str) else None
            which = f"pick={named!r}" if named else f"parts={own['pick']['parts']!r}"
            guide = "" if self.function is None else f", guide={self.function!r}"
            return f"regrow({own['particles']}, turn={own['turn']}, {which}{guide})"
        parts = [repr(one) for one in (*own.values(), *self.parts)]
        if isinstance(self.function, Guide):
            parts.append(repr(self.function))
        elif self.function is not None:
            parts.append(getattr(self.function, "name", getattr(self.function, "__name__", "function")))
        return f"{self.name}({', '.join(parts)})"


def prior() -> Kernel:
    """One choice, drawn from its own distribution (dissertation 3.2)."""
    return Kernel("prior")


def drift(step: float = 0.5, target: float = 0.44) -> Kernel:
    """One continuous choice moves a little; discrete ones are drawn from their own distribution.

    Positive numbers move by a factor, those of an interval by a factor of x / (1 - x), entries of a simplex by factors;
    angles go around.

    Parameters
    ----------
    step
        First step, in standard deviations of the choice's distribution (where it is bell-shaped) or as the logarithm
        of the factor.
    target
        The acceptance to which the step of each site is adapted during the warm-up; it is frozen afterwards.
    """
    return Kernel("drift", {"step": as_real(step), "target": as_real(target)})


def neighbour(reach: int = 1) -> Kernel:
    """One discrete choice moves to a value near by; continuous ones are drawn from their own distribution.

    A truth value turns, a whole number goes up or down by at most `reach`, a category becomes another.
    """
    return Kernel("neighbour", {"reach": reach})


def block(step: float = 0.2, share: float = 1.0, target: float = 0.234) -> Kernel:
    """Many choices move a little at once.

    A discrete choice that takes part moves to a value near by or stays, each with probability 1/2. Lists of counts or
    of truth values stay: a search with this kernel alone then warns.

    Parameters
    ----------
    step
        First step, in spreads of each site's distribution in the first state.
    share
        Probability with which each choice takes part.
    target
        The acceptance to which the step is adapted during the warm-up.
    """
    settings = {
        "step": as_real(step),
        "share": as_real(share),
        "target": as_real(target),
    }
    return Kernel("block", settings)


def regenerate(levels: int = 0) -> Kernel:
    """A call and all below it are drawn again: the call that is `levels` calls or iterations above a choice."""
    return Kernel("regenerate", {"levels": levels})


def regrow(
    particles: int = 60,
    *,
    turn: float = 0.5,
    pick: str = "size",
    parts: str | Sequence[str] | None = None,
    guide: Guide | None = None,
) -> Kernel:
    """A part of the run is grown again in place by particles, and everything else is held.

    The part is a call with all below it, an iteration of a loop, or the iterations from one on. Particles grow it in
    the scene that has everything else. One of them holds the present values, and one is drawn by weight (particle Gibbs
    of a block). A particle search that lost a part early gets it back this way. Under `on` only the choices that match
    change.

    Parameters
    ----------
    particles
        How many, the one with the present values among them; at least 2.
    turn
        How often a discrete choice of the part's own call is given another value and the part grown with it: a branch
        where there was none, a segment more, [0, 1].
    pick
        Which part: `"size"` draws the logarithm of its size evenly, so small and large parts have their turn, and
        `"choice"` takes the call of a choice that is drawn evenly. With `"choice"` alone a chain keeps which calls make
        choices where that depends on other calls; a search then warns.
    parts
        Patterns over the addresses of calls and iterations, such as `"wing[1]"`: one of those that match is grown
        again, drawn evenly, instead of `pick`.
    guide
        Draws the new values in place of their priors; weights make up for it.
    """
    if pick not in ("size", "choice"):
        raise bad("pick", pick, 'one of "size", "choice"', '"size"')
    named = [parts] if isinstance(parts, str) else parts
    if named is not None and not (named and all(isinstance(one, str) and one for one in named)):
        raise bad("parts", parts, "a pattern over addresses of calls, or several", '"wing[1]"')
    return Kernel(
        "regrow",
        {
            "particles": particles,
            "turn": as_real(turn),
            "pick": pick if named is None else {"parts": list(named)},
        },
        function=None if guide is None else _guide(guide),
    )


def hmc_step(steps: int = 10, step: float = 0.1, jitter: float = 0.0, target: float = 0.8) -> Kernel:
    """All continuous choices move together along their gradient, for a fixed number of steps (dissertation 4.3, 7.1).

    Discrete choices keep their values, and with them the structure of the run: other kernels of the same chain move
    those. A trajectory that reaches another structure is rejected, so put a kernel beside that moves continuous choices
    too, such as `prior()`, where they decide the structure. Under `on` only the choices that match move.

    Parameters
    ----------
    steps
        Leapfrog steps of a trajectory; each costs one gradient.
    step
        First step for one coordinate, in standard deviations of bell-shaped choices and in logarithms of bounded ones;
        `d` coordinates take `d ** -0.25` of it. Step and scales are adapted in the warm-up, and frozen afterwards.
    jitter
        The number of steps varies by this share of itself, [0, 1].
    target
        The acceptance to which the step is adapted.
    """
    settings = {
        "steps": steps,
        "step": as_real(step),
        "jitter": as_real(jitter),
        "target": as_real(target),
    }
    return Kernel("hmc_step", settings)


def nuts_step(max_depth: int = 8, step: float = 0.1, target: float = 0.8) -> Kernel:
    """All continuous choices move together along their gradient until they turn back; else as for `hmc_step`.

    Parameters
    ----------
    max_depth
        Most doublings of a trajectory: 2^max_depth - 1 steps; up to 20.
    step, target
        As for `hmc_step`.
    """
    settings = {
        "max_depth": max_depth,
        "step": as_real(step),
        "target": as_real(target),
    }
    return Kernel("nuts_step", settings)


def proposal(function: Callable[..., Any]) -> Kernel:
    """One choice, from a distribution of your own, for chains, particles and importance sampling alike.

    Parameters
    ----------
    function
        A function of the modelling language that gives a distribution over new values, such as
        `lambda old: Gaussian(old, 0.1)` or `lambda x: Gaussian(0.9 * x, 0.3)`. It makes no choice itself. Its
        parameters are names: `old` is the value before, which only a chain has; any other one is a variable of the
        model that is in scope at the choice and holds a number or a truth value. Use it under `on`, for sites whose
        values it proposes.
    """
    return Kernel("proposal", function=function)


def guided(guide: Guide) -> Kernel:
    """Choices drawn by a guide (dissertation chapter 6), for chains, particles and importance sampling alike.

    In a chain it changes one choice. It sees the scene without the parts at and below the call of that choice, and with
    what the call itself emitted before it; iterations of a loop after that of the choice are below it. A particle that
    still runs is left unchanged by it, as a kernel of `rejuvenate`.

    Parameters
    ----------
    guide
        From `niwaki.train_guide`, or a file (`Guide.load`). Choices that it does not know are drawn from their priors.
    """
    return Kernel("guided", function=_guide(guide))


def _guide(guide: Guide) -> Guide:
    """The guide, where it is one."""
    if not isinstance(guide, Guide):
        raise bad("guide", guide, "a guide", '`niwaki.train_guide(...)` or `Guide.load("vines.guide")`')
    return guide


def cycle(*kernels: Kernel) -> Kernel:
    """One application of each, in order."""
    return Kernel("cycle", {}, _parts("cycle", kernels))


def mixture(*kernels: Kernel, weights: Sequence[float] | None = None) -> Kernel:
    """One application of one of them, drawn by weight; evenly when no weights are given."""
    parts = _parts("mixture", kernels)
    values = [1.0] * len(parts) if weights is None else [as_real(weight) for weight in weights]
    if len(values) != len(parts):
        raise bad("weights", weights, "one weight for each kernel", "such a list")
    return Kernel("mixture", {"weights": values}, parts)


def repeat(times: int, kernel: Kernel) -> Kernel:
    """So many applications of a kernel."""
    return Kernel("repeat", {"times": times}, _parts("repeat", (kernel,)))


def on(sites: str | Sequence[str], kernel: Kernel) -> Kernel:
    """A kernel restricted to the choices whose address matches a pattern, or one of several."""
    patterns = [sites] if isinstance(sites, str) else list(sites)
    if not patterns or not all(isinstance(one, str) and one for one in patterns):
        raise bad("sites", sites, "a pattern over addresses, or several", '"tree/width"')
    return Kernel("on", _selection(sites=[patterns]), _parts("on", (kernel,)))


def weighted(
    kernel: Kernel,
    *,
    depth: Callable[[int], float] | None = None,
    sites: Mapping[str, float] | None = None,
    calls: str = "",
) -> Kernel:
    """A kernel that picks choices by weight instead of evenly; the acceptance takes that into account.

    Parameters
    ----------
    depth
        The selection weight of a choice with that number of calls above it.
    sites
        Selection weights by pattern over addresses: the first that matches, else 1. Zero leaves a choice out.
    calls
        The name, in addresses, of the calls that count as depth; all calls when left out.
    """
    by_depth = [] if depth is None else [_weight("depth", depth(n)) for n in range(_DEEPEST)]
    by_site = [[pattern, _weight("sites", one)] for pattern, one in (sites or {}).items()]
    return Kernel(
        "on", _selection(depth=by_depth, weights=by_site, calls=calls), _parts("weighted", (kernel,))
    )


def anneal(kernel: Kernel, steps: int, start: float = 0.1, end: float = 10.0) -> Kernel:
    """A kernel under which the score counts more and more: it is raised to a power that rises.

    The power goes from `start` to `end` in so many proposals, geometrically, and then stays. A power of 1 is the
    posterior, a higher one is sharper; the prior keeps its power of 1. The samples are not those of the posterior;
    take the best.
    """
    settings = {
        "start": as_real(start),
        "end": as_real(end),
        "steps": steps,
    }
    return Kernel("anneal", settings, _parts("anneal", (kernel,)))


def tempering(kernel: Kernel, powers: Sequence[float] = (1.0, 0.5, 0.25, 0.125), every: int = 100) -> Kernel:
    """Parallel tempering: a chain at each power of the score; neighbours exchange states now and then.

    It can only be outermost. The first power must be 1: its chain gives the samples.

    Parameters
    ----------
    powers
        Falling from 1. At a small power the score counts little, and the chain moves freely.
    every
        Proposals between two exchanges.
    """
    settings = {"powers": [as_real(power) for power in powers], "every": every}
    return Kernel("tempering", settings, _parts("tempering", (kernel,)))


def original(power: float = 16.0, nesting: str | None = None) -> Kernel:
    """The original's Metropolis-Hastings, with its settings (the baseline of dissertation 5.6).

    One choice by its family: a coin is always turned, a Gaussian number drifts by its own standard deviation, anything
    else is drawn from its distribution. It is run on the same models as everything else; a number whose interval
    moves away from under it is rejected here, where the original kept its place in the interval.

    Parameters
    ----------
    power
        Of the score: 16 turns a sigma of 0.02 into 0.005, as the original did. Reported scores are
        those of power 1.
    nesting
        The name of a function: choices within n nested calls of it get the selection weight exp(-n), as on the
        original's tree, where n counts branches and not segments (for our gnarly tree `"side_branch"`). All alike
        when left out.
    """
    kernel = Kernel("by_family")
    if nesting is not None:
        kernel = weighted(kernel, depth=lambda n: math.exp(-n), calls=nesting)
    return kernel if real("power", power, 0, usual="16") == 1.0 else anneal(kernel, 1, power, power)


def parse(text: str) -> Kernel:
    """A kernel as it is written: `cycle(on("z", prior()), repeat(3, drift(0.2)))`.

    Calls of the functions of this module with numbers, texts, lists and kernels; nothing else is carried out.
    """
    try:
        result = _kernel_of(ast.parse(text.strip(), mode="eval").body)
    except (RecursionError, MemoryError):
        raise InputError(
            "unreadable-kernel", found=f"{text[:40]}...", reason="it is nested too deeply"
        ) from None
    except (SyntaxError, ValueError, TypeError) as error:
        raise InputError("unreadable-kernel", found=text, reason=str(error).split(" (<")[0]) from None
    if not isinstance(result, Kernel):
        raise InputError(
            "unreadable-kernel", found=text, reason="it is not a call of a kernel, such as `prior()`"
        )
    return result


def _kernel_of(part: ast.expr) -> Any:
    if isinstance(part, ast.Name) and part.id in _WRITTEN:
        return _WRITTEN[part.id]()
    if isinstance(part, ast.Call) and isinstance(part.func, ast.Name) and part.func.id in _WRITTEN:
        given = {word.arg: _kernel_of(word.value) for word in part.keywords if word.arg is not None}
        return _WRITTEN[part.func.id](*(_kernel_of(one) for one in part.args), **given)
    if isinstance(part, (ast.List, ast.Tuple)):
        return [_kernel_of(one) for one in part.elts]
    if isinstance(part, (ast.Name, ast.Call)):
        name = ast.unparse(part.func if isinstance(part, ast.Call) else part)
        near = get_close_matches(name, _WRITTEN, n=1)
        hint = f"; did you mean `{near[0]}`?" if near else f"; there are {', '.join(_WRITTEN)}"
        raise ValueError(f"there is no kernel `{name}`{hint}")
    try:
        return ast.literal_eval(part)
    except ValueError:
        raise ValueError(f"`{ast.unparse(part)}` is no call, number, text or list") from None


#: What can be written as text.
_WRITTEN: dict[str, Callable[..., Kernel]] = {
    function.__name__: function
    for function in (
        prior,
        drift,
        neighbour,
        block,
        regenerate,
        regrow,
        hmc_step,
        nuts_step,
        cycle,
        mixture,
        repeat,
        on,
        weighted,
        anneal,
        tempering,
        original,
    )
}


def _selection(**given: Any) -> dict[str, Any]:
    """Which choices a kernel may change: lists of patterns that must match; weights by depth and by pattern."""
    return {"sites": [], "depth": [], "weights": [], "calls": "", **given}


def _parts(name: str, kernels: Sequence[Any]) -> tuple[Kernel, ...]:
    if not kernels:
        raise bad(name, "nothing", "at least one kernel", "`kernels.prior()`")
    for one in kernels:
        if not isinstance(one, Kernel):
            raise bad(name, one, "kernels", "one of `niwaki.kernels`, such as `kernels.prior()`")
        if one.name == "tempering":
            raise bad(
                name,
                one,
                "kernels other than `tempering`, which can only be outermost",
                "`tempering` around it",
            )
    return tuple(kernels)


def _weight(name: str, value: Any) -> float:
    return real(name, value, 0, ends="[)", usual="1.0")
