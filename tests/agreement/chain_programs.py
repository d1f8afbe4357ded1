"""Random model programs for chains: those of `programs`, with features that make re-running hard.

Lists of choices whose elements are read by indices that change later, captures that are read in loops, lists that only
grow, in recursions by one and by halves and in loops; counts, branches and closures that depend on choices; primitives
that come and go; soft factors over all of it; memoised functions, whose arguments and captures are choices. Every
program ends.
"""

from __future__ import annotations

from programs import Maker, Program


class ChainMaker(Maker):
    """Makes fragments that depend on each other through choices."""

    #: Whether some of them are memoised functions.
    memo = False
    #: Whether some of them are placed in frames.
    place = False

    def remembered(self, loop: bool) -> list[str]:
        """Calls of memoised functions: of the module, and closures that capture choices."""
        v, w, r, i = self.fresh("v"), self.fresh("w"), self.fresh("r"), self.fresh("i")
        statements = [
            f"{v} = {self.sampled()}",
            f"def {w}(i):",
            f"    y = gaussian({self.pick(v, '0')}, 1)",
            *(["    factor(-0.1 * y * y)"] if self.random.random() < 0.5 else []),
            f"    return y + {self.pick(v, 'noise(i % 2)', 'noise(0)', '0.5 * i')}",
            f"{r} = mem({w})",
        ]
        kinds = [
            lambda: [f"f = f + noise({self.integer(1)} % 3)"],
            lambda: [f"x = clip(x, -9, 9) * 0.5 + noise(n % 2) + climb({self.pick('poisson(1)', 'n')} % 4)"],
            lambda: [
                f"for {i} in range({self.pick('poisson(2)', '3', 'n % 4')}):",
                f"    f = f + {self.pick('noise', 'climb')}({i} % {self.pick('2', '3')})",
                f"    observe(Gaussian(noise({self.pick('0', i + ' % 2')}), 1), {i} * 0.5)",
            ],
            lambda: [f"xs = [noise({i}) for {i} in range({self.pick('2', '1 + poisson(1) % 3')})]"],
            lambda: ["f = f + (noise(1) if flip(0.5) else climb(2)) + force(future(noise, n % 3))"],
            *(
                [lambda: [*statements, f"f = f + {r}({self.integer(1)} % 2) + {r}(1)"]] * 2
                if not loop
                else []
            ),
            *(
                [
                    lambda: [
                        *statements,
                        f"for {i} in range(1 + poisson(1)):",
                        f"    f = f + {r}(n % 2) * {r}({i} % 2)",
                    ]
                ]
                if not loop
                else []
            ),
        ]
        return self.random.choice(kinds)()

    def placed(self, loop: bool) -> list[str]:
        """Calls in frames: of the module and of closures, that depend on choices, in loops, recursions and futures."""
        v, w, i = self.fresh("v"), self.fresh("w"), self.fresh("i")
        frame = self.pick(
            f"({self.real(1)}, n, 0)",
            f"vec(0, {self.sampled()}, 1)",
            f"rotation((0, 1, 0), {self.sampled()})",
            f"((x, 0, {self.pick('n', '1')}), rotation((1, 0, {self.integer(0)}), {self.sampled()}))",
            f"look((x, 0, 0), (math.cos({self.sampled()}), 0.0, 1.0))",
        )
        kinds = [
            lambda: [f"f = f + place({frame}, knot, clip(x, -3, 3))"],
            lambda: [f"f = f + place({frame}, twig, {self.pick('2', 'n % 3', 'poisson(1) % 3')}, 0.5)"],
            lambda: [f"f = f + sum(mirrored({self.pick(repr('x'), '(1, x, 0)')}, knot, 0.5))"],
            lambda: [
                f"xs = [0.5] + arrayed([({i}, x, 0) for {i} in range({self.pick('2', 'n % 3')})], knot, x)[:3]"
            ],
            lambda: [
                f"{v} = {self.sampled()}",
                f"f = f + place({frame}, knot if flip(0.5) else bare, {v})",
            ],
            lambda: [f"f = f + force(place({frame}, later, {self.sampled()}))"],
            *(
                [
                    lambda: [
                        f"{v} = {self.sampled()}",
                        f"def {w}(u):",
                        f"    emit(box((u, {v}, 0), (1, 2, 1)))",
                        "    return u + knot(u)",
                        f"f = f + place({frame}, {w}, x)",
                        f"f = f + place((0, 0, {v}), {self.pick(w, f'lambda u: {w}(u)')}, 1.0)",
                    ]
                ]
                * 2
                if not loop
                else []
            ),
        ]
        return self.random.choice(kinds)()

    def sampled(self) -> str:
        """A random choice of a real number, its parameters perhaps choices too."""
        return self.pick(
            f"gaussian({self.real(1)}, 1)",
            f"uniform(0, 1 + abs({self.real(0)}))",
            "gamma(2, 1)",
            "beta(2, 3)",
            f"gaussian(clip({self.real(1)}, -5, 5), 0.1 + uniform(0, 1))",
        )

    def statement(self, depth: int, loop: bool = False) -> list[str]:
        """One of the fragments here, or one of those that every program may have."""
        if self.memo and self.random.random() < 0.4:
            return self.remembered(loop)
        if self.place and self.random.random() < 0.4:
            return self.placed(loop)
        if self.random.random() < 0.5:
            return super().statement(depth, loop)
        v, w, i = self.fresh("v"), self.fresh("w"), self.fresh("i")
        kinds = [
            # A list of choices, and readers that switch between its elements.
            lambda: [
                f"{v} = [{self.sampled()} for _ in range({self.random.randint(2, 4)})]",
                f"for {i} in range({self.random.randint(1, 4)}):",
                f"    {w} = discrete_uniform(0, len({v}) - 1)",
                f"    observe(Gaussian({v}[{w}], 1), {i} * 0.5)",
                f"    f = f + {v}[{w}]" if self.random.random() < 0.5 else f"    f = f + {w}",
            ],
            # A list that only grows, read by the last element or as a whole.
            lambda: [
                f"{v} = []",
                f"for {i} in range({self.random.choice(['3', 'poisson(2)', 'n % 4'])}):",
                f"    {v} = {v} + [{self.sampled()}]",
                f"    if {self.boolean(1)}:",
                f"        {v} = {v} + [{v}[-1] + gaussian(0, 1)]",
                f"f = f + sum({v}) + len({v})",
                *([f"xs = ({v} + [1.0])[:5]"] if self.random.random() < 0.5 else []),
            ],
            # A count of activations that is a choice.
            lambda: [
                f"for {i} in range({self.pick('poisson(2)', 'geometric(0.5) % 5', 'discrete_uniform(0, 3)')}):",
                f"    {w} = {self.sampled()}",
                f"    factor(-0.3 * abs({w} - x))",
                f"    emit(box(({i}, {w}, 0), (1, 1, {self.random.choice(['1', w + ' * ' + w + ' + 1'])})))",
                *([f"    if {w} > 0.5:", "        break"] if self.random.random() < 0.5 else []),
            ],
            # Which function runs is a choice; what it captures is one too.
            lambda: (
                [
                    f"{v} = {self.sampled()}",
                    f"def {w}(u):",
                    f"    return u + gaussian({v}, 1)",
                    f"def {i}(u, k=2):",
                    f"    return u - uniform(0, 1) if k == 0 else {i}({w}(u), k - 1)",
                    f"f = f + (({w} if flip(0.5) else {i})(x) if {self.boolean(1)} else {v})",
                ]
                if not loop
                else [f"f = f + {self.sampled()}"]
            ),
            # Captures that have a value on one path only, which is a choice.
            lambda: (
                [
                    f"{i} = flip(0.5)",
                    f"if {i}:",
                    f"    {v} = {self.sampled()}",
                    f"def {w}(u, k):",
                    f"    u = u + ({v} if {i} else gaussian(0, 1))",
                    f"    return {w}(u, k - 1) if k > 0 else {self.pick('u', f'(lambda u: u + {v} if {i} else u)(u)')}",
                    f"f = f + {w}(x, {self.pick('0', '2', 'poisson(1)')})",
                ]
                if not loop
                else [f"f = f + {self.sampled()}"]
            ),
            # Branches that hold different choices at the same places.
            lambda: [
                f"if flip({self.random.choice(['0.3', '0.5', 'clip(abs(x) / 4, 0.1, 0.9)'])}):",
                f"    {v} = {self.sampled()}",
                f"    x = x * 0.5 + {v}",
                "else:",
                f"    {v} = {self.pick('categorical(WEIGHTS) * 1.0', self.sampled())}",
                f"    {w} = {self.sampled()}",
                f"    f = f - {v} + {w}",
                f"observe(Gaussian(clip(x, -20, 20), 1 + abs({v}) % 3), 0.5)",
            ],
            # One family with another dimension, and vectors.
            lambda: [
                f"{v} = sample(Dirichlet([1.0] * (2 + n % 2)))",
                f"{w} = categorical({v})",
                f"x = clip(x, -9, 9) + {v}[{w}] + gaussian({w}, 1)",
            ],
            lambda: [f"factor(-abs(clip(f, -50, 50)) * 0.1 + {self.random.choice(['0.0', '0.2 * n'])})"],
            lambda: [f"f = f + tree({self.random.randint(1, 4)}, clip(x, -3, 3))"],
            lambda: [f"xs = grown({self.random.randint(1, 4)}, [1.0])", "f = f + xs[0] + xs[-1]"],
        ]
        return self.random.choice(kinds)()  # type: ignore[no-any-return]


#: Recursions by halves and one by one, that every program may call.
_RECURSIONS = (
    "def tree(n, x):\n"
    "    y = gaussian(x, 1)\n"
    "    if n <= 1:\n"
    "        observe(Gaussian(y, 1), 0.5)\n"
    "        return y\n"
    "    left = tree(n // 2, y)\n"
    "    return left * 0.5 + (tree(n - n // 2, y) if flip(0.7) else 0.0)",
    "def grown(n, xs):\n"
    "    if n == 0:\n"
    "        return xs\n"
    "    y = gaussian(xs[-1], 1)\n"
    "    emit(box((n, y, 0), (1, 1, 1)))\n"
    "    return grown(n - 1, xs + [y])",
)


#: Memoised functions of the module: one that is scored, and one that calls itself and the other.
_MEMOISED = (
    "@mem\ndef noise(i):\n    y = gaussian(0, 1)\n    observe(Gaussian(y, 1), 0.3 * i)\n    return y",
    "@mem\ndef climb(n):\n    return climb(n - 1) + uniform(0, 1) + noise(n % 2) if n > 0 else 0.0",
)


#: Functions that are placed: with a shape, in themselves, with a future, and without a shape.
_PLACED = (
    "def knot(x):\n    y = gaussian(x, 1)\n    emit(box((y, 0, 0), (1, 1, 2)))\n    return y",
    "def twig(n, x):\n"
    "    y = knot(x)\n"
    "    if n == 0:\n"
    "        return y\n"
    "    turned = (0, y, 0) if flip(0.5) else ((y, 1, 0), rotation((0, 0, 1), 0.5))\n"
    "    return place(turned, twig, n - 1, 0.5 * y)",
    "def later(x):\n    return future(twig, 1, x)",
    "def bare(x):\n    return 0.5 * x",
)


def program(seed: int, size: int = 6, memo: bool = False, place: bool = False) -> Program:
    """A random program of `size` statements, perhaps with memoised functions, perhaps with calls in frames."""
    maker = ChainMaker(seed)
    maker.memo, maker.place = memo, place
    for _ in range(maker.random.randint(0, 2)):
        maker.helpers.append(maker.helper())
    helpers = (*maker.helpers, *_RECURSIONS, *(_MEMOISED if memo else ()), *(_PLACED if place else ()))
    return Program(helpers, tuple(tuple(maker.statement(2)) for _ in range(size)))
