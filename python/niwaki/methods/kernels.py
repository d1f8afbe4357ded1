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
from niwaki.methods.refusals import as_real, check_settings

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

#: The number of depths at which a function of the depth is evaluated; the last value holds for all deeper ones.
_DEEPEST = 256


class _KernelData(Struct):
    """Kernel as data; its parts are checked when they are read."""

    name: str
    settings: dict[str, Any] = {}
    parts: list[dict[str, Any]] = []
    function: dict[str, Any] | None = None


@dataclass(frozen=True)
class Kernel:
    """Markov kernel: a name, its settings by name, and the kernels in it."""

    name: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    parts: tuple[Kernel, ...] = ()
    function: Any = field(default=None, compare=False)

    def __post_init__(self) -> None:
        """Check the settings; each part has checked its own."""
        check_settings(
            _engine.check_kernel, {"name": self.name, "settings": self.settings}, self.settings, {}
        )

    def data(self, function: Callable[[Any], Any]) -> dict[str, Any]:
        """The kernel as plain data; `function` writes a user's proposal or a guide."""
        data: dict[str, Any] = {"name": self.name}
        if self.settings:
            data["settings"] = dict(self.settings)
        if self.parts:
            data["parts"] = [part.data(function) for part in self.parts]
        if self.function is not None:
            data["function"] = function(self.function)
        return data

    @classmethod
    def of_data(cls, data: Mapping[str, Any], function: Callable[[Any], Any]) -> Kernel:
        """Read a kernel from its data; `function` reads a user's proposal or a guide.

        Raises
        ------
        Unfit
            The data are not those of a kernel.
        """
        fitted(data, _KernelData)
        parts = []
        for number, part in enumerate(data.get("parts", ())):
            with inside(f".parts[{number}]"):
                parts.append(cls.of_data(part, function))
        with inside(".function"):
            attached = function(data["function"]) if "function" in data else None
        return cls(data["name"], dict(data.get("settings", {})), tuple(parts), attached)

    def leaves(self) -> list[Kernel]:
        """The kernels that propose, in order, each with its restrictions."""
        if not self.parts:
            return [self]
        inner = [leaf for part in self.parts for leaf in part.leaves()]
        return [Kernel("on", self.settings, (leaf,)) for leaf in inner] if self.name == "on" else inner

    def first(self, *names: str) -> Kernel | None:
        """Find the first kernel with one of these names: this kernel or one of its parts."""
        if self.name in names:
            return self
        return next((kernel for part in self.parts if (kernel := part.first(*names)) is not None), None)

    @property
    def follows(self) -> bool:
        """Whether one of its leaves follows the gradient."""
        return self.first("hmc_step", "nuts_step") is not None

    def __repr__(self) -> str:
        settings = self.settings
        if self.name in ("hmc_step", "nuts_step"):
            shown = [f"{key}={value}" for key, value in settings.items() if key not in ("steps", "max_depth")]
            length = str(settings["steps" if self.name == "hmc_step" else "max_depth"])
            return f"{self.name}({', '.join([length, *(setting for setting in shown if setting != 'jitter=0.0')])})"
        if self.name == "on":
            (inner,) = self.parts
            if settings["sites"]:
                return f"on({settings['sites'][0]!r}, {inner!r})"
            depth = ", depth=..." if settings["depth"] else ""
            sites = f", sites={dict(settings['weights'])!r}" if settings["weights"] else ""
            return f"weighted({inner!r}{depth}{sites})"
        if self.name == "mixture":
            weights = ", ".join(map(repr, settings["weights"]))
            return f"mixture({weights}, {', '.join(map(repr, self.parts))})"
        if self.name == "regrow":
            named = settings["pick"] if isinstance(settings["pick"], str) else None
            selection = f"pick={named!r}" if named else f"parts={settings['pick']['parts']!r}"
            guide = "" if self.function is None else f", guide={self.function!r}"
            return f"regrow({settings['particles']}, turn={settings['turn']}, {selection}{guide})"
        parts = [repr(value) for value in (*settings.values(), *self.parts)]
        if isinstance(self.function, Guide):
            parts.append(repr(self.function))
        elif self.function is not None:
            parts.append(getattr(self.function, "name", getattr(self.function, "__name__", "function")))
        return f"{self.name}({', '.join(parts)})"


def prior() -> Kernel:
    """Draw one choice from its own distribution (dissertation 3.2)."""
    return Kernel("prior")


def drift(step: float = 0.5, target: float = 0.44) -> Kernel:
    """Move one continuous choice a little; a discrete choice is drawn from its own distribution.

    Positive numbers move by a factor, those of an interval by a factor of x / (1 - x), entries of a simplex by factors;
    angles go around.

    Parameters
    ----------
    step
        The first step, in standard deviations of a bell-shaped distribution, or as the logarithm of the factor.
    target
        The acceptance to which the step of each site is adapted in the warm-up; afterwards the step is fixed.
    """
    return Kernel("drift", {"step": as_real(step), "target": as_real(target)})


def neighbour(reach: int = 1) -> Kernel:
    """Move one discrete choice to a neighbouring value; a continuous choice is drawn from its own distribution.

    A truth value flips, a whole number goes up or down by at most `reach`, a category becomes another.
    """
    return Kernel("neighbour", {"reach": reach})


def block(step: float = 0.2, share: float = 1.0, target: float = 0.234) -> Kernel:
    """Move many choices a little at once.

    A discrete choice that takes part moves to a neighbouring value or stays, each with probability 1/2. Lists of counts
    or of truth values stay: a search with this kernel alone then warns.

    Parameters
    ----------
    step
        The first step, in spreads of each site's distribution in the first state.
    share
        The probability with which each choice takes part.
    target
        The acceptance to which the step is adapted in the warm-up.
    """
    settings = {
        "step": as_real(step),
        "share": as_real(share),
        "target": as_real(target),
    }
    return Kernel("block", settings)


def regenerate(levels: int = 0) -> Kernel:
    """Draw a call and all below it again: the call that is `levels` calls or iterations above a choice."""
    return Kernel("regenerate", {"levels": levels})


def regrow(
    particles: int = 60,
    *,
    turn: float = 0.5,
    pick: str = "size",
    parts: str | Sequence[str] | None = None,
    guide: Guide | None = None,
) -> Kernel:
    """Grow a part of the run again by particles, and hold everything else.

    The part is a call with all below it, an iteration of a loop, or the iterations from one on. Particles grow the part
    in the scene of everything else. One particle holds the present values, and one is drawn by weight (particle Gibbs
    of a block). So a part that a particle search lost early comes back. Under `on` only the choices that match change.

    Parameters
    ----------
    particles
        The number of particles, with the one that has the present values; at least 2.
    turn
        The probability, [0, 1], with which a discrete choice of the part's own call gets another value before the part
        is grown: for a new branch, or one more segment.
    pick
        The rule for the part: `"size"` draws the logarithm of its size evenly, so that small and large parts are
        grown, and `"choice"` takes the call of an evenly drawn choice. With `"choice"` alone a chain does not change
        which calls make choices if that depends on other calls; a search then warns.
    parts
        Patterns over the addresses of calls and iterations, such as `"wing[1]"`, in place of `pick`: one of the
        matches is drawn evenly.
    guide
        The guide that draws the new values in place of their priors; weights correct for it.
    """
    if pick not in ("size", "choice"):
        raise bad("pick", pick, 'one of "size", "choice"', '"size"')
    named = [parts] if isinstance(parts, str) else parts
    if named is not None and not (named and all(isinstance(pattern, str) and pattern for pattern in named)):
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
    """Move all continuous choices together along their gradient, for a fixed number of steps (dissertation 4.3, 7.1).

    Discrete choices keep their values, and with them the structure of the run; other kernels of the chain move them. A
    trajectory that reaches another structure is rejected. If continuous choices decide the structure, add a kernel that
    moves them, too, such as `prior()`. Under `on` only the choices that match move.

    Parameters
    ----------
    steps
        The number of leapfrog steps of a trajectory; each takes one gradient.
    step
        The first step for one coordinate, in standard deviations of bell-shaped choices and in logarithms of bounded
        ones; `d` coordinates take `d ** -0.25` of it. Step and scales are adapted in the warm-up, and fixed afterwards.
    jitter
        The share by which the number of steps varies, [0, 1].
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
    """Move all continuous choices together along their gradient until they turn back; else as for `hmc_step`.

    Parameters
    ----------
    max_depth
        The most doublings of a trajectory, up to 20: 2^max_depth - 1 steps.
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
    """Draw one choice from a distribution of your own, in chains, particles and importance sampling.

    Parameters
    ----------
    function
        A function of the modelling language that returns a distribution of new values, such as
        `lambda old: Gaussian(old, 0.1)` or `lambda x: Gaussian(0.9 * x, 0.3)`, and makes no choice. Its parameters are
        names: `old` is the value before, which only a chain has; any other parameter is a variable of the model in
        scope at the choice, with a number or a truth value. Use the kernel under `on`, for the sites of the function.
    """
    return Kernel("proposal", function=function)


def guided(guide: Guide) -> Kernel:
    """Draw choices from a guide (dissertation chapter 6), in chains, particles and importance sampling.

    In a chain the kernel changes one choice. The guide sees the scene without the parts at and below the call of that
    choice, but with the shapes that the call emitted before the choice. Later iterations of a loop count as below. As a
    kernel of `rejuvenate` it leaves running particles unchanged.

    Parameters
    ----------
    guide
        A guide of `niwaki.train_guide`, or of a file (`Guide.load`). Unknown choices are drawn from their priors.
    """
    return Kernel("guided", function=_guide(guide))


def _guide(guide: Guide) -> Guide:
    """Check a guide."""
    if not isinstance(guide, Guide):
        raise bad("guide", guide, "a guide", '`niwaki.train_guide(...)` or `Guide.load("vines.guide")`')
    return guide


def cycle(*kernels: Kernel) -> Kernel:
    """Apply each kernel once, in order."""
    return Kernel("cycle", {}, _parts("cycle", kernels))


def mixture(*kernels: Kernel, weights: Sequence[float] | None = None) -> Kernel:
    """Apply one of the kernels, drawn by weight; evenly without weights."""
    parts = _parts("mixture", kernels)
    values = [1.0] * len(parts) if weights is None else [as_real(weight) for weight in weights]
    if len(values) != len(parts):
        raise bad("weights", weights, "one weight for each kernel", "such a list")
    return Kernel("mixture", {"weights": values}, parts)


def repeat(times: int, kernel: Kernel) -> Kernel:
    """Apply a kernel a number of times."""
    return Kernel("repeat", {"times": times}, _parts("repeat", (kernel,)))


def on(sites: str | Sequence[str], kernel: Kernel) -> Kernel:
    """Restrict a kernel to the choices whose address matches a pattern, or one of several."""
    patterns = [sites] if isinstance(sites, str) else list(sites)
    if not patterns or not all(isinstance(pattern, str) and pattern for pattern in patterns):
        raise bad("sites", sites, "a pattern over addresses, or several", '"tree/width"')
    return Kernel("on", _selection(sites=[patterns]), _parts("on", (kernel,)))


def weighted(
    kernel: Kernel,
    *,
    depth: Callable[[int], float] | None = None,
    sites: Mapping[str, float] | None = None,
    calls: str = "",
) -> Kernel:
    """Pick choices by weight instead of evenly; the acceptance takes the weights into account.

    Parameters
    ----------
    depth
        A function from the number of calls above a choice to its selection weight.
    sites
        Selection weights by pattern over addresses: the weight of the first match, else 1. Zero leaves a choice out.
    calls
        The name, in addresses, of the calls that count as depth; all calls when left out.
    """
    by_depth = [] if depth is None else [_weight("depth", depth(n)) for n in range(_DEEPEST)]
    by_site = [[pattern, _weight("sites", weight)] for pattern, weight in (sites or {}).items()]
    return Kernel(
        "on", _selection(depth=by_depth, weights=by_site, calls=calls), _parts("weighted", (kernel,))
    )


def anneal(kernel: Kernel, steps: int, start: float = 0.1, end: float = 10.0) -> Kernel:
    """Raise the score to a power that rises, so that the score counts more and more.

    The power goes from `start` to `end` in `steps` proposals, geometrically, and then stays. The power 1 is the
    posterior, a higher power is sharper; the prior keeps the power 1. The samples are not those of the posterior; take
    the best one.
    """
    settings = {
        "start": as_real(start),
        "end": as_real(end),
        "steps": steps,
    }
    return Kernel("anneal", settings, _parts("anneal", (kernel,)))


def tempering(kernel: Kernel, powers: Sequence[float] = (1.0, 0.5, 0.25, 0.125), every: int = 100) -> Kernel:
    """Run a chain at each of several powers of the score, which exchange states (parallel tempering).

    The kernel can only be outermost. The first power must be 1: its chain gives the samples.

    Parameters
    ----------
    powers
        The powers, falling from 1. At a small power the score counts little, and the chain moves freely.
    every
        The number of proposals between two exchanges of neighbours.
    """
    settings = {"powers": [as_real(power) for power in powers], "every": every}
    return Kernel("tempering", settings, _parts("tempering", (kernel,)))


def original(power: float = 16.0, nesting: str | None = None) -> Kernel:
    """Move one choice as the original's Metropolis-Hastings does (the baseline of dissertation 5.6).

    The family of the choice decides the move: a coin flips, a Gaussian number drifts by its own standard deviation, any
    other choice is drawn from its distribution. A number that a changed interval leaves outside is rejected; the
    original kept its relative place in the interval.

    Parameters
    ----------
    power
        The power of the score: 16 turns a sigma of 0.02 into 0.005, as in the original. Reported scores have power 1.
    nesting
        The name of a function: choices within n nested calls of it have the selection weight exp(-n), as in the
        original's tree, where n counts branches (`"side_branch"` in the gnarly tree of the gallery). Equal weights when
        left out.
    """
    kernel = Kernel("by_family")
    if nesting is not None:
        kernel = weighted(kernel, depth=lambda n: math.exp(-n), calls=nesting)
    return kernel if real("power", power, 0, usual="16") == 1.0 else anneal(kernel, 1, power, power)


def parse(text: str) -> Kernel:
    """Read a kernel from a text such as `cycle(on("z", prior()), repeat(3, drift(0.2)))`.

    The text has calls of the functions of this module with numbers, texts, lists and kernels; no other code runs.
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
    if isinstance(part, ast.Name) and part.id in _FUNCTIONS:
        return _FUNCTIONS[part.id]()
    if isinstance(part, ast.Call) and isinstance(part.func, ast.Name) and part.func.id in _FUNCTIONS:
        settings = {word.arg: _kernel_of(word.value) for word in part.keywords if word.arg is not None}
        return _FUNCTIONS[part.func.id](*(_kernel_of(argument) for argument in part.args), **settings)
    if isinstance(part, (ast.List, ast.Tuple)):
        return [_kernel_of(entry) for entry in part.elts]
    if isinstance(part, (ast.Name, ast.Call)):
        name = ast.unparse(part.func if isinstance(part, ast.Call) else part)
        near = get_close_matches(name, _FUNCTIONS, n=1)
        hint = f"; did you mean `{near[0]}`?" if near else f"; there are {', '.join(_FUNCTIONS)}"
        raise ValueError(f"there is no kernel `{name}`{hint}")
    try:
        return ast.literal_eval(part)
    except ValueError:
        raise ValueError(f"`{ast.unparse(part)}` is no call, number, text or list") from None


#: Functions that a text can call, by name.
_FUNCTIONS: dict[str, Callable[..., Kernel]] = {
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


def _selection(**settings: Any) -> dict[str, Any]:
    """The settings of a selection of choices: lists of patterns that must match; weights by depth and by pattern."""
    return {"sites": [], "depth": [], "weights": [], "calls": "", **settings}


def _parts(name: str, kernels: Sequence[Any]) -> tuple[Kernel, ...]:
    if not kernels:
        raise bad(name, "nothing", "at least one kernel", "`kernels.prior()`")
    for kernel in kernels:
        if not isinstance(kernel, Kernel):
            raise bad(name, kernel, "kernels", "one of `niwaki.kernels`, such as `kernels.prior()`")
        if kernel.name == "tempering":
            raise bad(
                name,
                kernel,
                "kernels other than `tempering`, which can only be outermost",
                "`tempering` around it",
            )
    return tuple(kernels)


def _weight(name: str, value: Any) -> float:
    return real(name, value, 0, ends="[)", usual="1.0")
