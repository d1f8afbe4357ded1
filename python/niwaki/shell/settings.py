"""The settings of methods as flags, read from the methods' classes: their fields and docstrings.

A setting that the chosen method does not have is an error.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache, wraps
from typing import Annotated, Any, get_type_hints

import typer

from niwaki import guides, kernels, search
from niwaki.errors import InputError
from niwaki.methods import Ais, Guide, Improve, Method, Mh, ParticleGibbs, Pimh, Smc
from niwaki.shell.references import ModelReference

#: The methods of `niwaki grow`, by the name that is typed.
METHODS: dict[str, type[Method]] = {
    "improve": Improve,
    "smc": Smc,
    "ais": Ais,
    "particle-gibbs": ParticleGibbs,
    "pimh": Pimh,
}

MethodName = Annotated[
    str | None,
    typer.Option(
        "--method",
        metavar="NAME",
        help=f"{', '.join(METHODS)}. Default: improve, or smc with --particles or a setting that improve lacks.",
    ),
]
Polish = Annotated[
    int | None,
    typer.Option(
        "--polish", metavar="STEPS", help="Continue from the best result: STEPS proposals of a chain."
    ),
]
PolishKernel = Annotated[
    str | None,
    typer.Option(
        "--polish-kernel",
        metavar="KERNEL",
        help='With --polish: the kernel of the chain; default: "prior()".',
    ),
]
GuideFile = Annotated[
    str | None,
    typer.Option(
        "--guide",
        metavar="FILE|shipped|none",
        help="A guide, which draws choices in place of the prior; default: the one that comes with the model, for "
        "one population into a drawing.",
    ),
]

#: Settings that hold a function, which cannot be typed.
_FUNCTIONS = ("proposal",)
#: What stands for a value in the help, where its type does not say it.
_METAVARS = {
    **dict.fromkeys(("particles", "powers", "anneal"), "LIST"),
    **dict.fromkeys(("kernel", "rejuvenate"), "KERNEL"),
    "seconds": "SECONDS",
}
#: Kinds of values that are typed as they are; everything else is typed as text and read by `_read`.
_PLAIN = (int, float, str, bool)


@dataclass(frozen=True)
class Flags:
    """Flags that a parameter of a command gathers, by name: `given: Annotated[dict[str, Any], Flags(...)]`."""

    parameters: tuple[inspect.Parameter, ...]


def of_methods(*methods: type[Method], **usual: str) -> Flags:
    """A flag for each setting of these methods; one that was not given is None.

    `usual` has the command's own defaults, where they differ from the method's.
    """
    return Flags(tuple(_option(name, methods, usual.get(name)) for name in _names(methods)))


def with_settings(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command the flags of its parameters that are groups: `Flags`, or dataclasses whose fields are flags.

    A flag of `Flags` that an earlier parameter has is left out.
    """
    hints = get_type_hints(command, include_extras=True)
    flat: dict[str, inspect.Parameter] = {}
    groups: dict[str, tuple[Any, list[str]]] = {}
    for own in inspect.signature(command).parameters.values():
        hint = hints[own.name]
        gathered = next((one for one in getattr(hint, "__metadata__", ()) if isinstance(one, Flags)), None)
        if gathered is not None:
            more = [one for one in gathered.parameters if one.name not in flat]
            groups[own.name] = dict, [one.name for one in more]
        elif is_dataclass(hint):
            kinds = get_type_hints(hint, include_extras=True)
            more = [
                own.replace(name=one.name, default=one.default, annotation=kinds[one.name])
                for one in fields(hint)
            ]
            groups[own.name] = hint, [one.name for one in more]
        else:
            more = [own.replace(annotation=hint)]
        flat |= {one.name: one.replace(kind=one.KEYWORD_ONLY) for one in more}

    @wraps(command)
    def gathering(**given: Any) -> None:
        for name, (make, names) in groups.items():
            given[name] = make(**{one: given.pop(one) for one in names})
        command(**given)

    gathering.__signature__ = inspect.Signature([*flat.values()])  # type: ignore[attr-defined]
    gathering.__annotations__ = {one.name: one.annotation for one in flat.values()}
    return gathering


def _names(methods: tuple[type[Method], ...]) -> list[str]:
    names = (field.name for method in methods for field in fields(method))
    return [name for name in dict.fromkeys(names) if name not in _FUNCTIONS]


def _option(name: str, methods: tuple[type[Method], ...], shown: str | None) -> inspect.Parameter:
    """The option of one setting; `shown` is the default in its help text."""
    owners: list[Any] = [method for method in methods if name in {field.name for field in fields(method)}]
    typed = _typed(name, methods)
    whose = (
        ""
        if len(owners) == len(methods)
        else f"{', '.join(method.NAME.replace('_', '-') for method in owners)}: "
    )
    default = {field.name: field.default for field in fields(owners[0])}[name]
    shown = shown or ("" if default is None or typed is bool else str(default))
    usual = f" Default: {shown}." if shown else ""
    flag = f"--{name.replace('_', '-')}"
    if typed is bool:
        flag += f"/--no-{name.replace('_', '-')}"
    metavar = _METAVARS.get(name, {int: "N", float: "NUMBER", str: "NAME"}.get(typed))
    text = f"{whose}{described(owners[0]).get(name, '')}{usual}"
    option = typer.Option(flag, metavar=metavar, help=text)
    annotation = Annotated[typed | None, option]  # type: ignore[valid-type]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)


@cache
def kinds() -> dict[str, Any]:
    """The type of each setting of the methods of `niwaki grow`, as it is typed."""
    methods = tuple(METHODS.values())
    return {name: _typed(name, methods) | None for name in _names(methods)}


def _typed(name: str, methods: tuple[Any, ...]) -> Any:
    """The type of a setting, as it is typed."""
    hints = [_hints(method)[name] for method in methods if name in {field.name for field in fields(method)}]
    plain = [one for one in _PLAIN if all(kind in (one, one | None) for kind in hints)]
    return plain[0] if plain else str


@cache
def _hints(method: Any) -> dict[str, Any]:
    return get_type_hints(method)


@cache
def described(method: type[Method]) -> dict[str, str]:
    """The first sentence of each setting in a method's docstring."""
    found: dict[str, str] = {}
    body = inspect.cleandoc(method.__doc__ or "").partition("Parameters\n----------\n")[2]
    for names, text in re.findall(r"^(\w[\w, ]*)\n((?:    .*\n?|\n)+)", body + "\n", re.MULTILINE):
        sentence = re.split(r"(?<=[.]) ", " ".join(text.split()).replace("`", ""), maxsplit=1)[0]
        found |= {name.strip(): sentence.rstrip(".;:") + "." for name in names.split(",")}
    if method is not Smc:
        found |= {
            name: text
            for name, text in described(Smc).items()
            if found.get(name, "As for").startswith("As for")
        }
    return found


def method(name: str | None, given: dict[str, Any], suits: Mapping[str, Any]) -> Method:
    """The method with the given settings, but without its guide and what that needs (`guided`).

    Parameters
    ----------
    name
        One of `METHODS`; None for what `niwaki.grow` does with these settings, or one population where the model has a
        rule of resampling and no setting is given.
    given
        Its settings; None for those that were not given.
    suits
        Settings of one population that suit the model; those that the method does not have are left out.
    """
    options = typed(given)
    if name is None:
        one_population = "resampling" in suits and not options
        name = "improve" if set(options) <= {*search.OF_IMPROVE, "regrow"} and not one_population else "smc"
    chosen = METHODS.get(name)
    if chosen is None:
        raise InputError(
            "bad-setting",
            name="--method",
            found=repr(name),
            expected=f"one of {', '.join(METHODS)}",
            suggestion="smc",
        )
    for key in options:
        if key not in {field.name for field in fields(chosen)}:
            owners = [own for own, kind in METHODS.items() if key in {field.name for field in fields(kind)}]
            other = " or ".join(f"`--method {own}`" for own in owners)
            reason = f"`--method {name}` has no such setting"
            flag = f"--{key.replace('_', '-')}"
            raise InputError("flag-alone", flag=flag, other=other, reason=reason)
    if "seconds" in options and chosen is Smc:
        for key, flag in (("particles", "--particles"), ("populations", "--populations")):
            if key in options:
                raise InputError(
                    "flags-exclude",
                    flag="--seconds",
                    other=flag,
                    reason="the given time decides the numbers of particles and populations",
                    cure=f"give only one of them; run.json contains the numbers for {options['seconds']:g} s",
                )
    options.pop("look_ahead", None)
    known = {field.name for field in fields(chosen)}
    own = {key: value for key, value in suits.items() if key in known}
    if chosen is Improve:
        return Improve(**{**own, "particles": max(suits["particles"] // 3, 1), **options})
    options = {**own, **options}
    if chosen is Smc:
        return search.default_method(options)
    return chosen(**{**({"power": search.POWER} if "power" in known else {}), **options})


def guide(
    file: str | None,
    found: ModelReference,
    sketches: Sequence[str],
    name: str | None,
    given: dict[str, Any],
) -> Guide | None:
    """The guide of a search: that of the file; else the one that comes with the model, where it suits; or None.

    Parameters
    ----------
    file
        A file, "none", or "shipped" for the one that comes with the model.
    found
        The model.
    sketches
        Names of the sketches of the score.
    name
        The method that was asked for.
    given
        Settings of the method; None for those that were not given.
    """
    if file == "none":
        return None
    own = guides.shipped(found.model)
    if file == "shipped" and own is not None:
        return own
    if file is not None:
        return Guide.load(file)
    asked = typed(given)
    one_population = name == "smc" or (name is None and not set(asked) & {*search.OF_IMPROVE, "regrow"})
    if own is None or not one_population or asked.get("weights") == "absolute":
        return None
    looks_at = {window for window, _ in own.form["windows"]}
    # In space the usual search is a good one, too: there a guide is taken by name only.
    if not looks_at <= set(sketches) or "match_volume" in looks_at:
        return None
    typer.echo(f"the guide that comes with `{own.model}` draws the choices (--guide none: without)", err=True)
    return own


def guided(method: Method, guide: Guide | None, given: Mapping[str, Any]) -> Method:
    """The method, its choices drawn by a guide, which looks ahead where the given settings say so."""
    ahead = given.get("look_ahead")
    if guide is None and ahead is None:
        return method
    if not isinstance(method, Smc | ParticleGibbs | Pimh):
        reason = f"`--method {method.NAME}` draws no choices by a guide"
        raise InputError("flag-alone", flag="--guide", other="`--method smc`", reason=reason)
    return replace(method, guide=guide, look_ahead=ahead)


def typed(given: dict[str, Any]) -> dict[str, Any]:
    """The settings that were typed, read."""
    return {name: _read(name, value) for name, value in given.items() if value is not None}


def polish(steps: int | None, kernel: str | None) -> Mh | None:
    """The chain that continues from the best, or None."""
    if steps is None:
        if kernel is None:
            return None
        reason = "it is the kernel of the chain"
        raise InputError("flag-alone", flag="--polish-kernel", other="`--polish`", reason=reason)
    return Mh(steps, kernel=None if kernel is None else kernels.parse(kernel), keep=0)


def _read(name: str, value: Any) -> Any:
    """A setting that was typed as text, where it is more than text."""
    if name in ("rejuvenate", "kernel"):
        return kernels.parse(value)
    if name == "at":
        return int(value) if value.isdecimal() else value
    if name == "particles":
        sizes = numbers(name, value, int)
        return sizes[0] if len(sizes) == 1 else sizes
    if name == "powers":
        rungs = numbers(name, value, float)
        return rungs if len(rungs) > 1 else numbers(name, value, int)[0]
    if name == "anneal":
        powers = numbers(name, value, float)
        return powers[0] if len(powers) == 1 else powers
    return value


def numbers(name: str, text: str, kind: Callable[[str], Any]) -> list[Any]:
    """Numbers with commas between them."""
    try:
        return [kind(part) for part in text.split(",")]
    except ValueError:
        what = "whole numbers" if kind is int else "numbers"
        raise InputError(
            "bad-setting",
            name=f"--{name}",
            found=repr(text),
            expected=f"one number, or {what} with commas between them",
            suggestion="such numbers, for instance 1,2,4,8,16",
        ) from None
