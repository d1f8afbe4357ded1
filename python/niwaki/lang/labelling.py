"""Labels of a program's sites, made from its source.

A site has the first of these that there is:

    label="port wing"                   what the source gives it
    width = uniform(1, 2)               the variable
    leg(uniform(1, 2))                  the parameter, here `height`; `size x` for a number in a vector of a shape
    if flip(0.3): tower()               what it decides: "tower?", "no tower?", "stop?", "another wing?" (`while`)
    for i in range(poisson(3)): ...     "number of storeys", from what the loop makes
    return uniform(1, 2)                the function
    flip(0.5)                           the word

A call has the name of its function, a part the name that `emit` gives it, else its first shape. Equal labels within an
activation are numbered from 1 where a run can have them together; loops are "first leg 1" and "second leg 1".
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Sequence
from types import FunctionType

from niwaki.lang.deep import deep
from niwaki.lang.labels import Labels, Site, Table, is_anonymous
from niwaki.lang.lower import lowered
from niwaki.lang.nouns import ordinal, plural, singular
from niwaki.lang.nouns import words as spoken
from niwaki.lang.purposes import Activations, Arms, Entry, Purpose, Reader, is_stored


@deep
def labels_of(function: FunctionType) -> Labels:
    """Return the labels of a model."""
    return _Maker(Activations(lowered(function), function)).labels()


class _Maker:
    """Maker of the labels of a program's sites."""

    def __init__(self, sites: Activations) -> None:
        self.sites = sites
        self.seen = self._reached()

    def labels(self) -> Labels:
        for entries in self.sites.entries:
            for entry in entries:
                self.text(entry)
        for entries in self.sites.entries:
            _number([entry for entry in entries if self.is_visible(entry)])
        tables: list[Table] = [
            {
                ("end" if entry.kind == "part" else entry.kind, entry.component): Site(
                    entry.text,
                    -1 if entry.inside is None else entry.inside,
                    entry.joins,
                    entry.kind == "part",
                )
                for entry in entries
            }
            for entries in self.sites.entries
        ]
        return Labels(tables, self.sites.functions)

    def _reached(self) -> set[int]:
        """Return the activations that make a choice or a part, themselves or by a call."""
        seen: set[int] = set()
        while True:
            more = {
                number
                for number, entries in enumerate(self.sites.entries)
                if number not in seen
                and any(e.kind in ("end", "part") or e.inside is None or e.inside in seen for e in entries)
            }
            if not more:
                return seen
            seen |= more

    def is_visible(self, entry: Entry) -> bool:
        """Return whether addresses can have the site."""
        return entry.kind in ("end", "part") or entry.inside is None or entry.inside in self.seen

    def text(self, entry: Entry) -> str:
        """Return the label of a site, made when it is first needed."""
        if not entry.text:
            entry.text = "…"
            entry.text = self._loop(entry) if entry.kind == "loop" else self._choice(entry)
        return entry.text

    def _loop(self, loop: Entry) -> str:
        assert loop.inside is not None
        name = loop.component.partition("[")[0] if not loop.purpose.name else loop.purpose.name
        entries = [entry for entry in self.sites.entries[loop.inside] if self.is_visible(entry)]
        products = [entry for entry in entries if entry.kind in ("part", "call")]
        if not is_anonymous(name):
            text = spoken(name)
            if len(products) == 1 and singular(self.text(products[0])) == singular(text):
                loop.joins[products[0].component] = text
            return text
        single = entries if len(entries) == 1 else products if len(products) == 1 else []
        if single and single[0].kind != "loop" and not any(entry.kind == "loop" for entry in entries):
            text = singular(self.text(single[0]))
            if not text.endswith("?") and not self._clash(single[0], entries):
                loop.joins[single[0].component] = text
                return text
        names = Counter(singular(self.text(entry)) for entry in products)
        for entry in products:
            if entry.kind == "call" and names[singular(self.text(entry))] == 1:
                loop.joins[entry.component] = singular(self.text(entry))
        return "section" if any(entry.kind == "part" for entry in products) else "step"

    def _clash(self, call: Entry, entries: Sequence[Entry]) -> bool:
        """Return whether an iteration and the call in it have a label in common, or could have."""
        own_labels = {self.text(entry) for entry in entries if entry is not call}
        if call.kind != "call" or not own_labels:
            return False
        inner = None if call.inside is None else self.sites.entries[call.inside]
        return inner is None or any(self.text(entry) in own_labels for entry in inner)

    def _choice(self, entry: Entry) -> str:
        assert entry.reader is not None
        purpose = entry.purpose
        if purpose.name:
            return purpose.name
        match purpose.form:
            case "if":
                return self._decided(entry.reader, purpose)
            case "while":
                products = self.products(entry.reader, purpose, purpose.nodes)
                return f"another {singular(products[0])}?" if products else "go on?"
            case "count":
                products = [
                    plural(singular(text)) for text in self.products(entry.reader, purpose, purpose.nodes)
                ]
                if not products and purpose.loop is not None:
                    products = [plural(self.text(purpose.loop))]
                return f"number of {_both(products)}"
        assert isinstance(entry.node, ast.Call)
        return entry.reader.word(entry.node)

    def _decided(self, reader: Reader, purpose: Purpose) -> str:
        """Return the question that a choice in a condition answers."""
        several = self.products(reader, purpose, purpose.nodes)
        function = "" if purpose.scope is None else spoken(purpose.scope.function.name)
        if len(several) > 1 and purpose.is_whole:
            several = [function]
        if several:
            return f"{'no ' if purpose.is_negated else ''}{_both(several)}?"
        products = _both(self.products(reader, purpose, purpose.alternative))
        if products:
            return f"{'' if purpose.is_negated else 'no '}{products}?"
        last = purpose.nodes[-1] if purpose.nodes else None
        if isinstance(last, (ast.Return, ast.Break)):
            is_model = purpose.scope is None or self.sites.scopes[purpose.scope.function] == 0
            if isinstance(last, ast.Return) and last.value is not None and not is_model:
                return f"{function}?"
            return "go on?" if purpose.is_negated else "stop?"
        if isinstance(last, ast.Continue):
            return "keep?" if purpose.is_negated else "skip?"
        changed = [part.id for node in purpose.nodes for part in ast.walk(node) if is_stored(part)]
        return f"{spoken(changed[0])}?" if changed else "yes?"

    def products(self, reader: Reader, purpose: Purpose, nodes: Sequence[ast.AST]) -> list[str]:
        """Return labels of what statements make, without repeats: parts and calls, else shapes and helpers."""
        first: list[str] = []
        second: list[str] = []
        waiting = [*reversed(nodes)]
        while waiting:
            node = waiting.pop()
            if isinstance(node, (ast.FunctionDef, ast.Lambda)):
                continue
            entry = self.sites.calls.get(node)
            if entry is not None and entry.kind in ("part", "call"):
                (first if self.is_visible(entry) else second).append(entry.text)
                continue
            if isinstance(node, ast.Call) and (shape := reader.shape(node, purpose.scope)):
                second.append(shape)
                continue
            waiting.extend(reversed([*ast.iter_child_nodes(node)]))
        return list(dict.fromkeys(first or second))


def _both(texts: Sequence[str]) -> str:
    """Return texts together; of more than two, the first two."""
    return " and ".join(texts) if len(texts) < 3 else f"{texts[0]}, {texts[1]} and more"


def _exclude(one_arm: Arms, other: Arms) -> bool:
    """Return whether no run has both of two sites."""
    sides = dict(one_arm)
    return any(sides.get(node, side) != side for node, side in other)


def _places(entries: Sequence[Entry]) -> list[int]:
    """Return the place of each site among those that a run can have together with it."""
    places: list[int] = []
    for entry in entries:
        before = [
            n for other, n in zip(entries, places, strict=False) if not _exclude(entry.arms, other.arms)
        ]
        places.append(1 + max(before, default=0))
    return places


def _number(entries: Sequence[Entry]) -> None:
    """Number the equal labels of an activation."""
    labels = {entry.text for entry in entries}
    numbered: set[str] = set()
    for text in dict.fromkeys(entry.text for entry in entries if entry.kind != "loop"):
        equal = [entry for entry in entries if entry.kind != "loop" and entry.text == text]
        places = _places(equal)
        if max(places) == 1:
            continue
        numbered.add(text)
        for entry, place in zip(equal, places, strict=True):
            while (name := _with_number(text, place)) in labels:
                place += len(equal)
            entry.text = name
    loops = [entry for entry in entries if entry.kind == "loop"]
    for text in dict.fromkeys(name for loop in loops for name in (loop.text, *loop.joins.values())):
        equal = [loop for loop in loops if text in (loop.text, *loop.joins.values())]
        places = _places(equal)
        if max(places) == 1 and text not in numbered:
            continue
        for loop, place in zip(equal, places, strict=True):
            name = f"{ordinal(place)} {text}"
            loop.joins = {key: name if old == text else old for key, old in loop.joins.items()}
            loop.text = name if loop.text == text else loop.text


def _with_number(text: str, number: int) -> str:
    return f"{text[:-1]} {number}?" if text.endswith("?") else f"{text} {number}"
