"""Flags for the settings of methods, made from the fields and docstrings of the methods' classes.

A setting that the selected method does not have is an error.
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
from niwaki.methods import Ais, Emulate, Guide, Improve, Method, Mh, ParticleGibbs, Pimh, Smc
from niwaki.shell.references import ModelReference

#: The methods of `niwaki grow`, by their names on the command line.
METHODS: dict[str, type[Method]] = {
    "improve": Improve,
    "smc": Smc,
    "ais": Ais,
    "particle-gibbs": ParticleGibbs,
    "pimh": Pimh,
    "emulate": Emulate,
}

MethodName = Annotated[
    str | None,
    typer.Option(
        "--method",
        metavar="NAME",
        help=f"Search method: {', '.join(METHODS)}. Default: improve; smc with --particles or a setting that improve "
        "lacks; emulate where all choices come before the scene, or a host function before every part.",
    ),
]
Polish = Annotated[
    int | None,
    typer.Option(
        "--polish", metavar="STEPS", help="Continue from the best result with a chain of STEPS proposals."
    ),
]
PolishKernel = Annotated[
    str | None,
    typer.Option(
        "--polish-kernel",
        metavar="KERNEL",
        help='Kernel of the chain of --polish. Default: "prior()".',
    ),
]
GuideFile = Annotated[
    str | None,
    typer.Option(
        "--guide",
        metavar="FILE|shipped|none",
        help="A guide, which draws choices in place of the prior. Default: the model's shipped guide, for one "
        "population into a drawing.",
    ),
]

#: Settings whose value is a function, which has no form on the command line.
_FUNCTIONS = ("proposal",)
#: Placeholders for values in the help, where the type alone does not tell enough.
_METAVARS = {
    **dict.fromkeys(("particles", "powers", "anneal"), "LIST"),
    **dict.fromkeys(("kernel", "rejuvenate"), "KERNEL"),
    "seconds": "SECONDS",
    "by": "kind|look|CHOICES|QUERY",
}
#: Types that the command line reads itself; any other setting is a text, which `_read` reads.
_PLAIN = (int, float, str, bool)


@dataclass(frozen=True)
class Flags:
    """Flags that a parameter of a command gathers by name: `settings: Annotated[dict[str, Any], Flags(...)]`."""

    parameters: tuple[inspect.Parameter, ...]


def of_methods(*methods: type[Method], **defaults: str) -> Flags:
    """Return a flag for each setting of these methods; a flag that is left out is None.

    `defaults` has the command's own defaults, where they differ from the method's.
    """
    return Flags(tuple(_option(name, methods, defaults.get(name)) for name in _names(methods)))


def with_settings(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command a flag for each member of its grouped parameters: `Flags`, or dataclasses whose fields are flags.

    A member of `Flags` that an earlier parameter has already is left out.
    """
    hints = get_type_hints(command, include_extras=True)
    flat: dict[str, inspect.Parameter] = {}
    groups: dict[str, tuple[Any, list[str]]] = {}
    for parameter in inspect.signature(command).parameters.values():
        hint = hints[parameter.name]
        group = next((extra for extra in getattr(hint, "__metadata__", ()) if isinstance(extra, Flags)), None)
        if group is not None:
            members = [member for member in group.parameters if member.name not in flat]
            groups[parameter.name] = dict, [member.name for member in members]
        elif is_dataclass(hint):
            kinds = get_type_hints(hint, include_extras=True)
            members = [
                parameter.replace(name=field.name, default=field.default, annotation=kinds[field.name])
                for field in fields(hint)
            ]
            groups[parameter.name] = hint, [member.name for member in members]
        else:
            members = [parameter.replace(annotation=hint)]
        flat |= {member.name: member.replace(kind=member.KEYWORD_ONLY) for member in members}

    @wraps(command)
    def with_groups(**values: Any) -> None:
        for name, (make, names) in groups.items():
            values[name] = make(**{member: values.pop(member) for member in names})
        command(**values)

    with_groups.__signature__ = inspect.Signature([*flat.values()])  # type: ignore[attr-defined]
    with_groups.__annotations__ = {member.name: member.annotation for member in flat.values()}
    return with_groups


def _names(methods: tuple[type[Method], ...]) -> list[str]:
    names = (field.name for method in methods for field in fields(method))
    return [name for name in dict.fromkeys(names) if name not in _FUNCTIONS]


def _option(name: str, methods: tuple[type[Method], ...], default_text: str | None) -> inspect.Parameter:
    """Return the option of a setting; `default_text` is the default in its help text."""
    owner_methods: list[Any] = [
        method for method in methods if name in {field.name for field in fields(method)}
    ]
    kind = _typed(name, methods)
    prefix = (
        ""
        if len(owner_methods) == len(methods)
        else f"{', '.join(method.NAME.replace('_', '-') for method in owner_methods)}: "
    )
    default = {field.name: field.default for field in fields(owner_methods[0])}[name]
    default_text = default_text or ("" if default is None or kind is bool else str(default))
    suffix = f" Default: {default_text}." if default_text else ""
    flag = f"--{name.replace('_', '-')}"
    if kind is bool:
        flag += f"/--no-{name.replace('_', '-')}"
    metavar = _METAVARS.get(name, {int: "N", float: "NUMBER", str: "NAME"}.get(kind))
    help_text = f"{prefix}{described(owner_methods[0]).get(name, '')}{suffix}"
    option = typer.Option(flag, metavar=metavar, help=help_text)
    annotation = Annotated[kind | None, option]  # type: ignore[valid-type]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)


@cache
def kinds() -> dict[str, Any]:
    """Return the type of each setting of the methods of `niwaki grow` on the command line."""
    methods = tuple(METHODS.values())
    return {name: _typed(name, methods) | None for name in _names(methods)}


def _typed(name: str, methods: tuple[Any, ...]) -> Any:
    """Return the type of a setting on the command line."""
    hints = [_hints(method)[name] for method in methods if name in {field.name for field in fields(method)}]
    plain = [
        candidate for candidate in _PLAIN if all(kind in (candidate, candidate | None) for kind in hints)
    ]
    return plain[0] if plain else str


@cache
def _hints(method: Any) -> dict[str, Any]:
    return get_type_hints(method)


@cache
def described(method: type[Method]) -> dict[str, str]:
    """Return the first sentence about each setting in a method's docstring."""
    sentences: dict[str, str] = {}
    body = inspect.cleandoc(method.__doc__ or "").partition("Parameters\n----------\n")[2]
    for names, text in re.findall(r"^(\w[\w, ]*)\n((?:    .*\n?|\n)+)", body + "\n", re.MULTILINE):
        sentence = re.split(r"(?<=[.]) ", " ".join(text.split()).replace("`", ""), maxsplit=1)[0]
        sentences |= {name.strip(): sentence.rstrip(".;:") + "." for name in names.split(",")}
    if method is not Smc:
        sentences |= {
            name: text
            for name, text in described(Smc).items()
            if sentences.get(name, "As for").startswith("As for")
        }
    return sentences


def method(name: str | None, settings: dict[str, Any], defaults: Mapping[str, Any]) -> Method:
    """Return the method with the given settings; `guided` adds its guide.

    Parameters
    ----------
    name
        A key of `METHODS`. None selects the method that `niwaki.grow` uses with these settings, or one population if
        the model has a rule of resampling and there are no settings.
    settings
        The settings of the method; None for a flag that was left out.
    defaults
        The model's settings for one population; those that the method does not have are ignored.
    """
    options = typed(settings)
    if name is None:
        one_population = "resampling" in defaults and not options
        name = "improve" if set(options) <= {*search.OF_IMPROVE, "regrow"} and not one_population else "smc"
    kind = METHODS.get(name)
    if kind is None:
        raise InputError(
            "bad-setting",
            name="--method",
            found=repr(name),
            expected=f"one of {', '.join(METHODS)}",
            suggestion="smc",
        )
    for key in options:
        if key not in {field.name for field in fields(kind)}:
            owners = [
                known for known, other in METHODS.items() if key in {field.name for field in fields(other)}
            ]
            alternatives = " or ".join(f"`--method {owner}`" for owner in owners)
            reason = f"`--method {name}` has no such setting"
            flag = f"--{key.replace('_', '-')}"
            raise InputError("flag-alone", flag=flag, other=alternatives, reason=reason)
    if "seconds" in options and kind is Smc:
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
    field_names = {field.name for field in fields(kind)}
    of_model = {key: value for key, value in defaults.items() if key in field_names}
    if kind is Improve:
        return Improve(**{**of_model, "particles": max(defaults["particles"] // 3, 1), **options})
    options = {**of_model, **options}
    if kind is Smc:
        return search.default_method(options)
    return kind(**{**({"power": search.POWER} if "power" in field_names else {}), **options})


def guide(
    file: str | None,
    reference: ModelReference,
    sketches: Sequence[str],
    name: str | None,
    settings: dict[str, Any],
) -> Guide | None:
    """Return the guide of a search: the guide in `file`, else that of the usual search, else None.

    Parameters
    ----------
    file
        A file, "none", or "shipped" for the model's shipped guide.
    reference
        The model.
    sketches
        Names of the sketches of the score.
    name
        The method on the command line.
    settings
        Settings of the method; None for a flag that was left out.
    """
    if file == "none":
        return None
    if file == "shipped" and (shipped := guides.shipped(reference.model)) is not None:
        return shipped
    if file is not None:
        return Guide.load(file)
    options = typed(settings)
    usual = guides.usual(reference.model, sketches)
    if usual is None or name not in (None, Smc.NAME, Improve.NAME) or options.get("weights") == "absolute":
        return None
    # In space a guide is for the usual search: a single population with it is not as safe as with the prior.
    if "match_volume" in sketches and (name or guided_method(settings)) != Improve.NAME:
        return None
    typer.echo(
        f"the guide shipped with `{usual.model}` draws the choices (--guide none turns it off)", err=True
    )
    return usual


def guided_method(settings: dict[str, Any]) -> str:
    """Return the name of the method that `niwaki.grow` uses with a guide and these settings."""
    of_search = set(typed(settings)) <= {*search.OF_IMPROVE, "regrow"}
    return Improve.NAME if of_search else Smc.NAME


def guided(method: Method, guide: Guide | None, settings: Mapping[str, Any]) -> Method:
    """Return the method with a guide and its setting of `--look-ahead`."""
    ahead = settings.get("look_ahead")
    if guide is None and ahead is None:
        return method
    if isinstance(method, Improve) and ahead is None:
        return replace(method, guide=guide)
    if isinstance(method, Improve):
        reason = f"`--method {method.NAME}` has no weights that could look ahead"
        raise InputError("flag-alone", flag="--look-ahead", other="`--method smc`", reason=reason)
    if not isinstance(method, Smc | ParticleGibbs | Pimh):
        reason = f"`--method {method.NAME}` draws no choices by a guide"
        raise InputError(
            "flag-alone", flag="--guide", other="`--method improve` or `--method smc`", reason=reason
        )
    return replace(method, guide=guide, look_ahead=ahead)


def typed(settings: dict[str, Any]) -> dict[str, Any]:
    """Return the values of the settings that are on the command line."""
    return {name: _read(name, value) for name, value in settings.items() if value is not None}


def polish(steps: int | None, kernel: str | None) -> Mh | None:
    """Return the chain that continues from the best result, or None."""
    if steps is None:
        if kernel is None:
            return None
        reason = "it is the kernel of the chain"
        raise InputError("flag-alone", flag="--polish-kernel", other="`--polish`", reason=reason)
    return Mh(steps, kernel=None if kernel is None else kernels.parse(kernel), keep=0)


def _read(name: str, value: Any) -> Any:
    """Return the value of a setting whose text needs a reader of its own."""
    if name in ("rejuvenate", "kernel"):
        return kernels.parse(value)
    if name == "at":
        return int(value) if value.isdecimal() else value
    if name == "particles":
        sizes = numbers(name, value, int)
        return sizes[0] if len(sizes) == 1 else sizes
    if name == "by":
        names = tuple(part.strip() for part in value.split(","))
        return names if len(names) > 1 else names[0]
    if name == "powers":
        rungs = numbers(name, value, float)
        return rungs if len(rungs) > 1 else numbers(name, value, int)[0]
    if name == "anneal":
        powers = numbers(name, value, float)
        return powers[0] if len(powers) == 1 else powers
    return value


def numbers(name: str, text: str, kind: Callable[[str], Any]) -> list[Any]:
    """Read numbers with commas between them."""
    try:
        return [kind(part) for part in text.split(",")]
    except ValueError:
        noun = "whole numbers" if kind is int else "numbers"
        raise InputError(
            "bad-setting",
            name=f"--{name}",
            found=repr(text),
            expected=f"one number, or {noun} with commas between them",
            suggestion="such numbers, for instance 1,2,4,8,16",
        ) from None
