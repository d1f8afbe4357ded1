"""Labels: names for people of choices, parts, calls and iterations, beside the addresses of files and commands.

    while[0]/wings/while[1]/width        Wing 1 › section 2 › width
    bernoulli                            Tower?
    i[2]/storey/uniform                  Storey 3 › height

`labelling` makes the labels of sites when they are first asked for. This file puts them together for an
address. A program has a table of sites for each activation, a function or the body of a loop. Iterations count from 1.

An iteration of a loop without a name of its own takes the name of what it makes: where a loop only calls `wing`, the
iteration and the call are both "wing 1". Where it makes several things, it is a "section", and the label of a call
starts with the call: `while[0]/wings` is "wing 1", `while[0]/fins` is "fin 1".

An address of a function that only the run knows, or of a program without a source, has the words of its components.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from niwaki.lang.nouns import singular, words

#: What stands between the steps of a label.
SEPARATOR = " › "
#: The activation of a function that only the run knows.
UNKNOWN = -1
#: Labels of components that say nothing to a reader.
PLAIN = {
    "apply": "call",
    "bernoulli": "flip",
    "categorical": "choice",
    "discrete_uniform": "choice",
    "emit": "part",
    "infer": "inner search",
}

_LOOP = re.compile(r"([^\[\]()]*)\[(\d+)\](#\d+)?")
_MEMO = re.compile(r"([^()]*?)(?:#\d+)?(\(.*\))")
_NUMBERED = re.compile(r"(.*)#(\d+)")


@dataclass(frozen=True)
class Site:
    """The label of a site.

    Attributes
    ----------
    text : str
        The label; for a loop, the label of an iteration without its number.
    inside : int
        The number of the callee's activation, or of the loop's.
    joins : mapping
        For a loop: labels, without the number, of an iteration together with the component after it.
    is_part : bool
        Whether the site is an `emit`.
    """

    text: str
    inside: int = UNKNOWN
    joins: Mapping[str, str] = field(default_factory=dict)
    is_part: bool = False


@dataclass(frozen=True)
class _Place:
    """A place in an address: the activation, and the loop with the number of the iteration right before it."""

    inside: int
    loop: Site | None = None
    number: int = 0


@dataclass(frozen=True)
class _Step:
    """The label of a component, with the number of its iteration; the place after it."""

    text: str
    number: int | None
    place: _Place
    is_joined: bool = False


#: The sites of an activation by kind ("end", "call", "loop") and component; a loop's has empty brackets.
Table = Mapping[tuple[str, str], Site]


@dataclass(frozen=True)
class Labels:
    """The labels of a program.

    Attributes
    ----------
    tables : sequence
        The sites of each activation; the model's is the first.
    functions : mapping
        The activations of functions by name, where it is the name of one function.
    """

    tables: Sequence[Table] = ()
    functions: Mapping[str, int] = field(default_factory=dict)

    def label(self, address: str) -> str:
        """Return the label of a choice, a part, a call or an iteration."""
        return _path(self.steps(address))

    def short(self, address: str) -> str:
        """Return the last step of the label, as it is read below the label of the call around it."""
        return self.steps(address)[-1]

    def steps(self, address: str) -> list[str]:
        """Return the steps of a label, outermost first."""
        return [_text(step) for step in self._steps(address)]

    def kind(self, address: str) -> str:
        """Return the last step without the number of an iteration: the same for all parts of a loop."""
        return self._steps(address)[-1].text

    def place(self, place: str) -> str:
        """Return the label of a place, an address without numbers of iterations; with "/" at its end, of calls."""
        address = place.removesuffix("/").replace("[]", "[0]")
        label = _path([step.text for step in self._steps(address)])
        return f"{label}, number" if place.endswith("/") else label

    def tree(self, addresses: Iterable[str]) -> list[tuple[int, str, str, bool]]:
        """Return the steps of addresses and of the calls around them, each once, those around before those inside.

        A row has the number of the row around it (-1 for the outermost), the component of addresses, and the step. The
        last entry is true if the step takes the place of the step around it in a whole label.
        """
        rows: list[tuple[int, str, str, bool]] = []
        numbers, places = {"": -1}, {-1: self._start()}
        for whole in addresses:
            address, waiting = whole, []
            while address not in numbers:
                waiting.append(address)
                address = address.rpartition("/")[0]
            for address in reversed(waiting):
                head, _, component = address.rpartition("/")
                step = self._step(places[numbers[head]], component, address is whole)
                rows.append((numbers[head], component, _text(step), step.is_joined))
                numbers[address] = len(rows) - 1
                places[numbers[address]] = step.place
        return rows

    def is_possible(self, address: str) -> bool:
        """Return whether a run may have a choice at this address, as far as the source tells."""
        place = self._start()
        *calls, last = address.split("/")
        for component in calls:
            loop, table = (
                _LOOP.fullmatch(component),
                self.tables[place.inside] if place.inside != UNKNOWN else None,
            )
            key = ("call", component) if loop is None else ("loop", _loop_key(loop))
            if table is None or _MEMO.fullmatch(component) is not None:
                return True
            if key not in table:
                return False
            place = self._step(place, component, False).place
        if place.inside == UNKNOWN:
            return True
        site = self.tables[place.inside].get(("end", last))
        return site is not None and not site.is_part

    def walk(
        self, iterations: Iterable[int], enters: Callable[[Sequence[str], int], bool], limit: int
    ) -> tuple[list[tuple[str, list[str]]], bool]:
        """List addresses that choices can have, short ones first, with the steps of their labels.

        Parameters
        ----------
        iterations
            The numbers of iterations, from 0, for every loop.
        enters
            Whether to enter a call or an iteration: of the steps of its label, and of the times that the path was in
            its function before.
        limit
            The most addresses, and the most calls that wait.

        Returns
        -------
        The addresses with their steps, and whether they are all.
        """
        numbers, rows = sorted(set(iterations)), list[tuple[str, list[str]]]()
        waiting = deque([("", self._start(), list[str](), list[int]())])
        while waiting:
            prefix, place, above, entered = waiting.popleft()
            if place.inside == UNKNOWN:
                continue
            for (kind, component), site in self.tables[place.inside].items():
                if site.is_part:
                    continue
                names = (
                    [component.replace("[]", f"[{n}]") for n in numbers] if kind == "loop" else [component]
                )
                for name in names:
                    step = self._step(place, name, kind == "end")
                    steps = [*(above[:-1] if step.is_joined else above), _text(step)]
                    if kind == "end":
                        rows.append((prefix + name, steps))
                    elif enters(steps, entered.count(site.inside)):
                        waiting.append((f"{prefix}{name}/", step.place, steps, [*entered, site.inside]))
            if len(rows) > limit or len(waiting) > limit:
                return rows[:limit], False
        return rows, True

    def site(self, function: str, component: str) -> str:
        """Return the label of a choice by its function, with the loops around it (`wings/while#0`), in all its runs."""
        name, *loops = function.split("/")
        inside = self.functions.get(name.rpartition(".")[2], UNKNOWN)
        steps = [] if inside == 0 else [words(name.rpartition(".")[2])]
        for loop in loops:
            of, _, number = loop.partition("#")
            key = "loop", f"{of}[]" if number in ("", "0") else f"{of}[]#{number}"
            known = self.tables[inside].get(key) if inside != UNKNOWN else None
            inside = known.inside if known is not None else UNKNOWN
            if known is not None and component in known.joins:
                return _path([*steps, known.text])
            steps.append(known.text if known is not None else "step" if is_anonymous(of) else words(of))
        site_here = self._site_of(inside, component, True)
        return _path([*steps, site_here.text if site_here is not None else _plain(component)])

    def _start(self) -> _Place:
        return _Place(0 if self.tables else UNKNOWN)

    def _steps(self, address: str) -> list[_Step]:
        """Return the steps, of which one that is joined replaces the one before it."""
        steps: list[_Step] = []
        place = self._start()
        components = address.split("/")
        for number, component in enumerate(components, 1):
            step = self._step(place, component, number == len(components))
            place = step.place
            if step.is_joined:
                steps.pop()
            steps.append(step)
        return steps

    def _step(self, place: _Place, component: str, is_last: bool) -> _Step:
        """Return the step of a component that comes after a place."""
        inside = place.inside
        if (loop := _LOOP.fullmatch(component)) is not None:
            site, number = self._loop(inside, loop), int(loop[2]) + 1
            return _Step(site.text, number, _Place(site.inside, site, number))
        if (memo := _MEMO.fullmatch(component)) is not None:
            text = f"{words(memo[1].rpartition('.')[2])} {_argument(memo[2])}"
            return _Step(text, None, _Place(self._function(memo[1])))
        after = self._site_of(inside, component, False)
        next_place = _Place(after.inside if after is not None else self._function(component))
        if place.loop is not None:
            joined = self._joined(place.loop, inside, component, is_last)
            if joined is not None:
                return _Step(joined, place.number, next_place, True)
        site_here = self._site_of(inside, component, is_last)
        return _Step(site_here.text if site_here is not None else _plain(component), None, next_place)

    def _site_of(self, inside: int, component: str, is_last: bool) -> Site | None:
        if inside == UNKNOWN:
            return None
        table = self.tables[inside]
        kinds = ("end", "call") if is_last else ("call",)
        return next((table[kind, component] for kind in kinds if (kind, component) in table), None)

    def _loop(self, inside: int, loop: re.Match[str]) -> Site:
        key = "loop", _loop_key(loop)
        if inside != UNKNOWN and key in self.tables[inside]:
            return self.tables[inside][key]
        return Site("step" if is_anonymous(loop[1]) else words(loop[1]))

    def _joined(self, loop: Site, inside: int, component: str, is_last: bool) -> str | None:
        """Return the label of an iteration together with the component after it, or None if each has its own."""
        if inside != UNKNOWN:
            return loop.joins.get(component)
        return singular(_plain(component)) if not is_last and loop.text == "step" else None

    def _function(self, component: str) -> int:
        return self.functions.get(component.partition("#")[0].rpartition(".")[2], UNKNOWN)


def _text(step: _Step) -> str:
    return step.text if step.number is None else f"{step.text} {step.number}"


def _loop_key(loop: re.Match[str]) -> str:
    """Return the component of a loop in tables, without the number of the iteration."""
    return f"{loop[1]}[]{loop[3] or ''}"


def _path(steps: Sequence[str]) -> str:
    text = SEPARATOR.join(steps)
    return text[:1].upper() + text[1:]


#: Loops of words and built-ins that call a function for each item.
_CALLERS = ("while", "map", "filter", "sorted", "min", "max", "mirrored", "arrayed")


def is_anonymous(name: str) -> bool:
    """Return whether the name of a loop says nothing to a reader: `i`, `_`, `while`, `map`."""
    return len(name) < 2 or name.startswith("_") or name in _CALLERS


def _plain(component: str) -> str:
    """Return the words of a component, with its number."""
    numbered = _NUMBERED.fullmatch(component)
    name, number = (numbered[1], f" {int(numbered[2]) + 1}") if numbered is not None else (component, "")
    return PLAIN.get(name, words(name)) + number


def _argument(text: str) -> str:
    """Return the arguments of a memoised call; a single one without brackets."""
    inner = text[1:-1]
    return inner if re.fullmatch(r"[\w.+-]+", inner) else text.replace("\\x2f", "/")
