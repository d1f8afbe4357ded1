"""A new search from an earlier result: `--from out/run.json` with `--hold` or `--reroll`.

--hold count=3      results in which this choice has this value
--hold 'wing*'      other results with the same wings: their choices are held, the rest is searched
--reroll 'gun*'     the same result with other guns: the rest stays, to the bit
"""

from __future__ import annotations

from ast import literal_eval
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import gallery, search, shell
from niwaki.errors import InputError
from niwaki.errors.memory import check_room
from niwaki.errors.settings import bad
from niwaki.inputs.modules import modules
from niwaki.lang import lookup
from niwaki.lang.compiled import translated
from niwaki.methods.room import RUN
from niwaki.result import parts
from niwaki.shell import request, selection, settings
from niwaki.shell.arguments import bound
from niwaki.shell.references import ModelReference

From = Annotated[
    Path | None,
    typer.Option("--from", metavar="RUN.JSON", help="A result to start from, with --hold or --reroll."),
]
Hold = Annotated[
    list[str] | None,
    typer.Option(
        "--hold",
        metavar="PATTERN|NAME=VALUE",
        help="Hold the parts of the result of --from that match PATTERN, or hold the choice with the address or label "
        "NAME at VALUE. The rest is searched. Repeatable.",
    ),
]
Reroll = Annotated[
    list[str] | None,
    typer.Option(
        "--reroll",
        metavar="PATTERN",
        help="Grow the parts again that match PATTERN, and keep the rest. Repeatable.",
    ),
]
OfRun = Annotated[
    int | None,
    typer.Option("--run", metavar="N", help="Number of the result of --from, #N. Default: the best."),
]


@dataclass(frozen=True)
class Flags:
    """The flags on the command line."""

    origin: From = None
    number: OfRun = None
    hold: Hold = None
    reroll: Reroll = None


#: Particles for each part that is grown again.
PARTICLES = 200


def read(flags: Flags) -> tuple[list[str], dict[str, Any]]:
    """Read `--hold`: patterns, and values by address.

    Raises
    ------
    InputError
        `flags-exclude`: `--reroll` is there, too; `bad-setting`: a value cannot be read; `held-twice`: two values
        for one choice.
    """
    hold = flags.hold or ()
    if hold and flags.reroll:
        raise InputError(
            "flags-exclude",
            flag="--hold",
            other="--reroll",
            reason="`--reroll` grows its parts again, `--hold` keeps its parts and searches the rest",
            cure="use only one of the two",
        )
    values: dict[str, Any] = {}
    for text in (text for text in hold if "=" in text):
        address, _, written = text.rpartition("=")
        value: Any = written
        try:
            value = literal_eval(written)
        except (ValueError, SyntaxError, RecursionError, MemoryError):
            if not written[:1].isalpha():
                expected = "a word, a number, a truth value or a list"
                raise bad(f"--hold {address}", written, expected, "such a value: hip, 2.5, True") from None
        if values.get(address, value) != value:
            raise lookup.held_twice(address, (address, values[address]), (address, value))
        values[address] = value
    return [text for text in hold if "=" not in text], values


@dataclass(frozen=True)
class Origin:
    """An earlier result from which a search starts.

    Attributes
    ----------
    path
        The run.json.
    number
        The number of the result, from 1.
    sample
        The result.
    hold, reroll
        Patterns of the parts that are held, and of those that are grown again.
    """

    path: Path
    number: int
    sample: nw.Sample
    hold: tuple[str, ...]
    reroll: tuple[str, ...]

    @classmethod
    def of_flags(cls, flags: Flags, hold: list[str], values: Mapping[str, Any]) -> Origin | None:
        """Return the origin that the flags name, or None; `hold` has the patterns of `--hold`, `values` its values."""
        path, number, reroll = flags.origin, flags.number, flags.reroll
        for flag, is_set in (("--hold", hold), ("--reroll", reroll), ("--run", number is not None)):
            if is_set and path is None:
                cure = "`--from out/run.json`, the file of that result; `--run 3` takes its #3"
                raise InputError("hold-without-run", flag=flag, other="`--from`", cure=cure)
        if path is None:
            return None
        if not hold and not reroll and not values:
            reason = "a result alone does not tell which parts to keep"
            raise InputError("flag-alone", flag="--from", other="`--hold` or `--reroll`", reason=reason)
        data = shell.run_files.load(path)
        place = selection.place(number, len(data["runs"]), data["best"])
        # The model's own file has been run for this command; no other module is imported here.
        loaded = {module for module, _, _ in shell.trust.hosts(data["search"]) if modules(module)}
        sample = shell.run_files.replayed(data, place, tuple(sorted(loaded)), path)
        return cls(path, place + 1, sample, tuple(hold or ()), tuple(reroll or ()))

    @property
    def held(self) -> dict[str, Any]:
        """The choices of the held parts by address."""
        return self.sample.held(*self.hold) if self.hold else {}

    def data(self) -> dict[str, Any]:
        """Return the origin as data for run.json."""
        return {
            "file": str(self.path.resolve()),
            "hash": self.sample.search.hash,
            "run": self.number,
            "lock": list(self.hold),
            "reroll": list(self.reroll),
        }

    @property
    def reference(self) -> ModelReference:
        """The model of the result as it was; its file is not run."""
        data = shell.run_files.load(self.path)
        name = str(data["model"])
        return ModelReference(name, self.sample.search.model, gallery.entry(name), data.get("file_hash"))

    def search_again(
        self,
        reference: ModelReference,
        flags: request.SearchFlags,
        method_settings: Mapping[str, Any],
        arguments: Mapping[str, Any],
        hold: Mapping[str, Any] | None,
    ) -> nw.Search:
        """Return the search of the result, with its target; flags and arguments replace some of its settings."""
        before = self.sample.search
        assert isinstance(before, nw.Search)
        method = before.method
        if flags.method is not None or any(value is not None for value in method_settings.values()):
            defaults = {"particles": gallery.PARTICLES} if reference.entry is None else reference.entry.usual
            method = settings.method(flags.method, dict(method_settings), dict(defaults))
        return replace(
            before,
            model=reference.model,
            args=tuple(bound(reference.model, dict(arguments))) if arguments else before.args,
            method=method,
            polish=settings.polish(flags.polish, flags.polish_kernel) or before.polish,
            seed=search.fresh(flags.seed),
            runs=flags.runs,
            choices=None,
            hold=hold,
            max_steps=flags.max_steps,
            max_memory=flags.max_memory << 20,
        )

    def reroll_parts(self, goal: nw.Search, particles: int | None, threads: int | None) -> nw.Result:
        """Return the result with its parts grown again, once for each run of the requested search."""
        check_room("--runs", goal.runs, RUN, "run")
        with translated(goal.model.name):
            trace = goal.task.replay(self.sample.choices, goal.seed)
        start = nw.Sample.of_trace(trace, goal, goal.seed)
        default_power = 1.0 if goal.score.window is not None else search.POWER
        power = getattr(goal.method, "power", default_power)
        samples = []
        for number in range(goal.runs):
            sample, seed = start, (goal.seed + number) % 2**64
            for pattern in self.reroll:
                scene = [part.address for part in sample.parts]
                for part in parts.matching_parts(pattern, sample.choices, scene, goal.model):
                    grown = sample.regrow(
                        part, particles or PARTICLES, power=power, seed=seed, threads=threads
                    )
                    sample = grown.best
            samples.append(sample)
        return nw.Result(replace(goal, polish=None), samples, goal.seed)
