"""What is held, and going on from a result that is there: `--from out/run.json` with `--hold` or `--reroll`.

--hold count=3      results in which this choice has this value
--hold 'wing*'      other results with the same wings: their choices are held, all else is searched
--reroll 'gun*'     the same result with other guns: all else stays as it is, to the bit
"""

from __future__ import annotations

from ast import literal_eval
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import search, shell
from niwaki.errors import InputError
from niwaki.errors.memory import check_room
from niwaki.errors.settings import bad
from niwaki.inputs.modules import modules
from niwaki.lang.compiled import translated
from niwaki.methods.room import RUN
from niwaki.result import parts
from niwaki.shell import picking

From = Annotated[
    Path | None,
    typer.Option("--from", metavar="RUN.JSON", help="A result to go on from, with --hold or --reroll."),
]
Hold = Annotated[
    list[str] | None,
    typer.Option(
        "--hold",
        metavar="PATTERN|ADDRESS=VALUE",
        help="Keep what this matches in the result of --from, or this value; search the rest; repeatable.",
    ),
]
Reroll = Annotated[
    list[str] | None,
    typer.Option(
        "--reroll",
        metavar="PATTERN",
        help="Grow the parts that this matches again, keep the rest; repeatable.",
    ),
]
OfRun = Annotated[
    int | None,
    typer.Option("--run", metavar="N", help="Which result, #N, with --from. Default: the best."),
]


@dataclass(frozen=True)
class Flags:
    """The flags, as they are typed."""

    origin: From = None
    number: OfRun = None
    hold: Hold = None
    reroll: Reroll = None


#: Particles of each part that is grown again.
PARTICLES = 200


def read(flags: Flags) -> tuple[list[str], dict[str, Any]]:
    """What `--hold` says: patterns, and values by address.

    Raises
    ------
    InputError
        `flags-exclude`: `--reroll` is there, too; `bad-setting`: a value is none.
    """
    hold = flags.hold or ()
    if hold and flags.reroll:
        raise InputError(
            "flags-exclude",
            flag="--hold",
            other="--reroll",
            reason="`--reroll` keeps everything but its parts, `--hold` keeps its parts and nothing else",
            cure="give one of them",
        )
    values = {}
    for text in (text for text in hold if "=" in text):
        address, _, value = text.rpartition("=")
        try:
            values[address] = literal_eval(value)
        except (ValueError, SyntaxError, RecursionError, MemoryError):
            raise bad(
                f"--hold {address}", value, "a number, a truth value or a list", "such a value: 2.5, True"
            ) from None
    return [text for text in hold if "=" not in text], values


@dataclass(frozen=True)
class Origin:
    """What a search goes on from, checked.

    Attributes
    ----------
    sample
        The result, as it was.
    hold, reroll
        Patterns of what is held, and of the parts that are grown again.
    """

    path: Path
    number: int
    sample: nw.Sample
    hold: tuple[str, ...]
    reroll: tuple[str, ...]

    @classmethod
    def of_flags(cls, flags: Flags, hold: list[str]) -> Origin | None:
        """The origin that the flags name; None without one. What is held is patterns here."""
        path, number, reroll = flags.origin, flags.number, flags.reroll
        for flag, given in (("--hold", hold), ("--reroll", reroll), ("--run", number is not None)):
            if given and path is None:
                cure = "`--from out/run.json`, the file of that result; `--run 3` takes its #3"
                raise InputError("hold-without-run", flag=flag, other="`--from`", cure=cure)
        if path is None:
            return None
        if not hold and not reroll:
            reason = "it is the result of which something is kept"
            raise InputError("flag-alone", flag="--from", other="`--hold` or `--reroll`", reason=reason)
        data = shell.run_files.load(path)
        place = picking.place(number, len(data["runs"]), data["best"])
        # The model's own file has been run for this command; no other module is imported here.
        known = {module for module, _, _ in shell.trust.hosts(data["search"]) if modules(module)}
        sample = shell.run_files.replayed(data, place, tuple(sorted(known)), path)
        return cls(path, place + 1, sample, tuple(hold or ()), tuple(reroll or ()))

    @property
    def held(self) -> dict[str, Any]:
        """The choices of the held parts, by address."""
        return self.sample.held(*self.hold) if self.hold else {}

    def data(self) -> dict[str, Any]:
        """The origin, for run.json."""
        return {
            "file": str(self.path.resolve()),
            "hash": self.sample.search.hash,
            "run": self.number,
            "lock": list(self.hold),
            "reroll": list(self.reroll),
        }

    def rerolled(self, asked: nw.Search, particles: int | None, threads: int | None) -> nw.Result:
        """The result with other parts, once for each run of the search that was asked for."""
        check_room("--runs", asked.runs, RUN, "run")
        with translated(asked.model.name):
            trace = asked.task.replay(self.sample.choices, asked.seed)
        start = nw.Sample.of_trace(trace, asked, asked.seed)
        usual = 1.0 if asked.score.window is not None else search.POWER
        power = getattr(asked.method, "power", usual)
        found = []
        for number in range(asked.runs):
            one, seed = start, (asked.seed + number) % 2**64
            for pattern in self.reroll:
                scene = [part.address for part in one.parts]
                for part in parts.matching_parts(pattern, one.choices, scene, asked.model.name):
                    grown = one.regrow(part, particles or PARTICLES, power=power, seed=seed, threads=threads)
                    one = grown.best
            found.append(one)
        return nw.Result(replace(asked, polish=None), found, asked.seed)
