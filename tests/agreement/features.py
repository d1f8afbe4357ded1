"""Programs that use one part of the language each, to compare executors."""

# ruff: noqa: E501

from __future__ import annotations

from niwaki import _engine

HEADER = """import math
from dataclasses import dataclass
from typing import NamedTuple
import numpy as np
from niwaki import host, model; from niwaki.words import *
from niwaki import enumerate_all, forward, importance, rejection, smc
@dataclass(frozen=True)
class Leaf:
    size: float
    name: str = "leaf"
class Point(NamedTuple):
    x: float
    y: float = 0.0
ARR = np.array([[1.0, 2.0], [3.0, 4.5]])
INTS = np.arange(5)
V = np.array([[0.,0,0],[1,0,0],[0,1,0],[0,0,1]])
F = np.array([[0,2,1],[0,1,3],[1,2,3],[0,3,2]])
RUNS = 10
D = {'a': 1, 2: 'b', 'c': [1, 2]}
NEST = [1, (2, 'x'), {'k': 3.5}]
G = Gaussian(1.0, 2.0)
LEAF = Leaf(2.5)
@host
def twice(x):
    return 2 * x
@host
def pairs(xs):
    return [(x, str(x)) for x in xs]
"""
FEATURES = {
    "records": """
def m():
    l = Leaf(gaussian(), name="a")
    p = Point(uniform(0, 1))
    x, y = p
    return l, p, p[0] + x + y, l.name, l == Leaf(l.size, "a"), LEAF.size, p == (x, y), str(l), f"{p}"
""",
    "arrays": """
def m():
    s = 0.0
    for row in ARR:
        for v in row:
            s += v * flip(0.5)
    return s, ARR[1][0], INTS[2] + 1, len(ARR), [r[0] for r in ARR], NEST, D['c'], D.get('z', 3)
""",
    "soft": """
def m():
    x, y, w = gaussian(), uniform(-2, 2), uniform(0.01, 3)
    factor(softeq(x, y, w) + soft_at_least(x, b=y, width=w) + soft_at_most(x, 0.5, w))
    edge = [soft_at_least(1, 1, 0.5), smooth_max(2, 2.0, 0.5), smooth_min(True, 1, 1e-9), smooth_abs(0, 3)]
    return edge, smooth_max(x, y, w), smooth_min(x, y, w), smooth_abs(x, w), list(map(softeq, [x], [y], [w]))
""",
    "vectors": """
def m():
    a = vec(1, 2, gaussian())
    b = rotate(a, (0, 1, 0), uniform(0, 3))
    r = rotation((1, 0, 0), 0.3)
    c = cross(a, b) * 2 + a / 3 - b
    emit(box(a, (1, 1, 1), rotation=r), cylinder(b, 0.5, 2, axis="x"), [limb((0,0,0),(0,1,0),0.2,0.1)])
    return a, b, c.x, dot(a, b), norm(c), normalize(c), distance(a, b), a == vec(1, 2, a.z), a.y, str(vec(1, 2)), r
""",
    "holes": """
def m():
    x, hole = uniform(-1, 1), box((gaussian(0, 0.3), 0, 0), (0.5, 0.5, 1))
    wall = box((0, 0, 0), (3, 2, 0.2)) - hole
    wall -= cylinder((x, 0.5, 0), 0.2, 1, axis="z")
    emit(wall & box((0, 0, 0), (2.5, 3, 3)), [sphere((0, 3, 0), 1) | wedge((0, 4, 0), (1, 1, 1))])
    return wall == wall - cylinder((x, 0.9, 0), 0.2, 1, axis="z"), hole == hole, 6 & 3, True | False
""",
    "look": """
def m():
    x, a = gaussian(), uniform(0, 3)
    look((x, 1), (math.cos(a), math.sin(a)))
    u = flip(0.5)
    look(position=vec(x, 1.0, 2), up=(0, 0, a + 1), forward=[2, x, -1])
    f = look((0, 0, x), (0, 2.0 + a, 0.1)) if u else look((x, 0), vec(1, a))
    return f, f.up, f[0].x, [look((n, n), (n + 1, x)).forward for n in range(2)]
""",
    "place": """
def leg(h, r):
    lean = gaussian(0, 0.1)
    emit(box((lean, h / 2, 0), (r, h, r)), name="leg")
    rings = [((0, y, 0), (0, 1, 0), (0, 0, -1), 1 - y / 9) for y in (0, 0.2, 4)]
    emit(limb((0, h, 0), (0, h + 1, lean), r, 0.1), [segment(rings[0], rings[1], rings[2])])
    return lean
def pair(h):
    frame = look((h, 0, 0), (gaussian(), 0, 1))
    return place(frame, leg, h, 0.2), mirrored("z", leg, h, 0.1)
def blot(r):
    emit(disc((1, 0, 0), r), stroke((0, 0, 1), (2, r, 1), 0.5))
    return [future(blot, r / 2)] if r > 0.5 else None
def skew(x):
    return place(((0, 0, 1), (x, 0, 0), (x, 1, 0), 1.0), leg, 1.0, 0.5)
@mem
def shared(k):
    emit(box((k, -5, 0), (1, 1, 1)))
    return gaussian(k, 1)
def m():
    h = uniform(1, 2)
    out = place((0, h, 0), pair, h)
    spots = [(x, 0, h) for x in linspace(-h, h, 3)]
    out = out, arrayed(spots, leg, h, 0.3), mirrored((1, h, 0), lambda a, b=2.0: leg(a, b) + shared(1), h)
    place((2, 1), blot, h), place(((0, h), rotation((0, 0, 1), h)), blot, 1)
    kept = leg if flip() else lambda a, b: place((0, 0, a), leg, a, b) * 2
    turned = [place(rotation((0, h, 1), k), kept, 1.0, 0.2) for k in range(2)]
    return out, turned, place((1, 0, 0), shared, 1), shared(1), smoothstep(h, 1, 3), smoothstep(h - 1), linspace(h, 3, 1), skew(1.0 if h < 3 else h)
""",
    "a frame that is none": """
def leg(h):
    emit(box((0, h / 2, 0), (h, h, h)), name="leg")
def m():
    x = uniform(0, 1)
    return place((1, 0, 0), lambda: mirrored(x if x < 2 else "x", leg, 1.0))
""",
    "segment": """
def m():
    up, back = vec(0, 1, 0), vec(0, 0, -1)
    frames = [(vec(0, y, 0), up, back, r + 0.1 * uniform(0, 1)) for y, r in ((0, 1.0), (0.2, 0.9), (4, 0.7))]
    emit(segment(frames[0], frames[1], frames[2]))
    x = vec(1, 0, 0)
    side = [Frame(vec(at, 2, 0), x, up, r) for at, r in ((1.1, 0.4), (1.3, 0.4), (3, 0.3))]
    emit(segment(side[0], side[1], side[2], Bark(vec(0, 1.6, 0), 0.95, (0, 2.4, 0), 0.85), color=(0.4, 0.3, 0.2)))
    return side[0].radius, frames[0][3]
""",
    "mesh": """
def m():
    emit(mesh(V, F, center=(gaussian(), 0, 0)))
    emit(cylinder((0, 3, 0), 1, 2, top_radius=0.5, color=(1, 0, 0), bevel=0.1), box((3,0,0),(1,2,3),taper=0.5,taper_axis="x"))
    return None
""",
    "dists": """
def m():
    a = sample(Mixture([1, 2], [G, Uniform(0, 1)]))
    b = dirichlet([1.0, 2.0, 3.0])
    c = multivariate_gaussian([0.0, 1.0], [[1.0, 0.5], [0.5, 2.0]])
    d = [poisson(3), binomial(4, 0.3), geometric(0.4), beta(1, 2), gamma(2, 1), exponential(2), laplace(0, 1), cauchy(0, 1), student_t(3), von_mises(0, 1), truncated_gaussian(0, 1, -1, 2), log_normal(0, 1), inverse_gamma(3, 1), categorical([0.2, 0.8])]
    c2 = diagonal_gaussian([0.0, 1.0], [1.0, 0.5])
    c3 = multinomial(4, [1.0, 2.0, 0.5])
    c4 = multivariate_bernoulli([0.2, 0.7])
    observe(Multinomial(sum(c3), [1, 1, 1]), c3)
    observe(DiagonalGaussian([0, 0], [1, 2]), c2)
    observe(MultivariateBernoulli([0.5, 0.5]), c4)
    e = sample(Delta(3))
    f = choose(["x", "y", (1, 2)])
    g = choose([10, 20], [1, 3])
    observe(G, a)
    observe(Dirichlet([1, 1, 1]), b)
    k = Gaussian(a, 1)
    dd = [Gaussian(0, 1), Gaussian(5, 1)]
    h = sample(dd[flip(0.5)])
    return a, b, c, d, e, f, g, b[0] + c[1], sum(b), k, h, c2[0], c3, c4, sum(range(c3[0]))
""",
    "strings": """
def m():
    x = gaussian()
    s = f"{x:.3f}|{int(x * 10):>5d}|{'a'!r}|{[1, 2.0]}|{x!r}"
    return s, s.split("|"), s.upper(), "a" in s, s[2:5], "-".join(["a", "b"]), s.replace("|", "/"), len(s), str(1.0), repr("q'"), s.startswith("0"), (1.5, None, True), str([1, (2,), {}]), "x" * 3, int("12"), float("1e3")
""",
    "loops": """
def m():
    out = []
    for i in range(3):
        k = 0
        while True:
            k = k + 1
            if flip(0.5):
                continue
            if k > 4 or flip(0.3):
                break
            out = out + [(i, k)]
        for j in range(i):
            if flip(0.2):
                return out, "early", i, j
    return out, [i * j for i in range(3) for j in range(i) if flip(0.5)], {"a": k}, i
""",
    "names": """
def part(x, n=2):
    x = gaussian(x, n)
    for n, x in [(1, x), (n, x + 1)]:
        x = x + uniform(0, n)
    return [x * n for n in range(n)], x
def m():
    x, n = gaussian(), 3
    if flip(0.5):
        x = [x, n]
        y = 1
    elif n > x:
        n, x = x, (n,)
        y = (lambda x: x + gaussian(x, 1))(n)
    else:
        x, y = {"x": x}, None
    for x, n in enumerate([x, n]):
        n = [n, x]
        while x < 2:
            x = x + 1
            n = (n, [n for n in range(x)], [x for x in (x, 1) if flip(0.5)])
        if flip(0.3):
            x = str(x)
            continue
        y = (y, x) if flip(0.8) else n
    def near(n, x=2):
        y = gaussian(n, x)
        def x(y):
            return part(y)[1] + n
        return x(y)
    z = near(1)
    if z > 1:
        z = near
    else:
        z = lambda n: near(n, 1)
    return x, n, y, z(2), (lambda x, z=z: z(x))(1), [n for n in [near] for n in (n(1), 2)], part(1)
""",
    "closures": """
def m():
    a = gaussian()
    def f(n, step=1):
        def g(y):
            return y + a + n
        return g(gaussian(0, 1)) if n <= 0 else f(n - step) + g(1)
    fs = [lambda x, i=i: x * i + a for i in range(3)]
    return f(2), [g(2) for g in fs], list(map(lambda v: v + flip(), [1, 2])), sorted([3, 1, 2], key=lambda v: gaussian(v, 1)), max([1, 2, 3], key=lambda v: -v)
""",
    "hosts": """
def m():
    return twice(gaussian()), twice("ab"), pairs([1, 2]), twice((1, 2))
""",
    "futures": """
def w(x, n):
    y = gaussian(x, 1)
    emit(box((y, n, 0), (1, 1, 1)))
    if n > 0:
        f = future(w, y, n - 1)
        g = future(w, -y, n - 1)
        return force(f) + force(g)
    return y
def m():
    a = future(w, 0, 2)
    b = [future(w, i, 0) for i in range(3)]
    query("sum", [force(z) for z in b])
    query("fut", a)
    return (force(a), b)
""",
    "ints": """
def m():
    n = discrete_uniform(-5, 5)
    k = n if n != 0 else 1
    return n // 3, n % 3, -7 // k, -7 % k, 2 ** abs(n), 2 ** -2, n / k, n & 3, n | 8, n ^ 5, ~n, n << 2, n >> 1, divmod(7, 2), round(2.5), round(-1.255, 2), int(-2.7), 7.5 // 2, -7.5 % 2, abs(n), True + 1, min(1, 2.0), max([n, 3]), sum([1, 2.5]), math.floor(2.7), math.hypot(3, 4), math.gcd(12, 18), n == float(n), 0.1 + 0.2, 1e300 * 10, math.comb(5, 2), math.factorial(5)
""",
    "unpack": """
def m():
    (a, b), c = (1, 2), [3]
    d, *e = [1, 2, 3]
    *f, g = (4, 5)
    xs = [1, 2, 3, 4]
    for i, (p, q) in enumerate(zip(xs, "abcd")):
        a += i
    x = y = gaussian()
    return a, b, c, d, e, f, g, xs[-1], xs[1:], xs[::-1], xs[::2], x == y, xs + [5], xs * 2, (1,) + (2,), 3 in xs, xs.index(3), xs.count(1), any(v > 3 for v in xs), all([]), list(range(5, 0, -2)), tuple(xs), list("ab")
""",
    "impossible": """
def m():
    x = flip(0.5)
    condition(x)
    y = gaussian()
    factor(-y * y)
    return x, y
""",
    "asserts": """
def m():
    x = gaussian()
    assert x > -100, "too small"
    "a docstring"
    z: float = x
    pass
    return z if x > 0 else None
""",
    "colours": """
def m():
    c = hsv(uniform(-1, 2), uniform(0, 1), uniform(0, 1))
    d = vec(uniform(0, 1), uniform(0, 1), uniform(0, 1))
    e = lab(uniform(0, 100), uniform(-60, 60), uniform(-60, 60))
    return c, to_hsv(c), to_lab(c), lab(to_lab(d).x, to_lab(d).y, to_lab(d).z), e, to_lab(e), color_difference(c, d), color_difference(d, (0.5, 0.5, 0.5)), color_difference((0, 0, 0), c), lerp(c, d, 0.5), to_hsv([0.2, 0.2, 0.2])
""",
    "polygons": """
def m():
    room = [(0, 0), (4, 0), (4, 2), vec(2, 2), [2, 4], (0, 4)]
    p = vec(uniform(-1, 5), uniform(-1, 5))
    r = uniform(0.1, 3)
    return polygon_area(room), polygon_contains(room, p), polygon_distance(room, p), polygon_disc_area(room, p, r), polygon_disc_area(room[::-1], p, r), polygon_inset(room, 0.3), polygon_inset(room[::-1], -r), polygon_distance(room, (2, 2)), polygon_disc_area(room, p, 0)
""",
    "rotations": """
def m():
    r = rotation((1, 2, 3), uniform(-3, 3))
    s = rotation((0, 1, 0), gaussian())
    v = vec(gaussian(), gaussian(), gaussian())
    return r * v, r * s, r * s * v, r[0], len(r), list(r)[2], r == r, [row for row in s][1]
""",
    "emits": """
def part(x):
    emit(box((x, 9, 0), (1, 1, 1)), name="roof", color=hsv(0.1, 0.5, x))
def m():
    skin = (uniform(0, 1), 0.5, 0.25)
    emit([box((2 * i, 1, 3), (0.5, 0.1, 2)) for i in range(3)], disc((0, 0, 9), 1, color=(1, 0, 0)), color=skin, name="wing")
    emit(box((0, 1, 6), (2, 1, 2)) if flip() else (limb((0, 1, 6), (2, 1, 1), 0.3, 0.2),), color=skin, name="wing")
    emit(cylinder((0, 20, 0), uniform(1, 2), 1), color=None, name="a-mast_2")
    emit([box((0, 30, k), (1, 1, 0.5), metalness=0.25) for k in range(2)], disc((0, 40, 0), 1), metalness=1, roughness=0.5 * skin[0])
    part(skin[0])
    emit(box((0, 30, 0), (1, 1, 1)))
""",
    "inference": """
def inner(p, k=1):
    a, b = flip(p), flip(0.5)
    condition(a or b)
    return a + b + k
def search(p):
    return infer(inner, importance(20), p, 0)
def m():
    p = uniform(0, 1)
    def near(n):
        x = gaussian(0, 1)
        factor(-abs(x - p) * n)
        emit(box((x, 0, 0), (1, 1, 1)))
        query("inner", x)
        return x
    one = infer(inner, rejection(3), p)
    best = infer(near, smc(particles=30, ess=0.5), 3.0, keep="best")
    deep = infer(search, forward(), p)
    xs = [infer(lambda: gaussian(p, 1.0), importance(RUNS)) for i in range(3)]
    return one, best, deep, xs, infer(inner, enumerate_all(), 0.25)
""",
    "inference in what an inferred function defines": """
def m():
    n = categorical([1, 2, 3])
    def near(x, n=n + 1):
        return gaussian(x, 1) + n
    def outer(x):
        return infer(lambda y: near(y) + gaussian(0, 1), importance(3), x)
    return infer(outer, importance(3), 0.5)
""",
}

#: An argument of each type that words for shapes take; `{k}` is the parameter's place.
_FITS = {
    "VecLike": "(x, {k} + 1.0, 2.0)",
    "float": "0.5 / (x + {k})",
    "Rotation": "rotation((1, 0, 0), x)",
    "Axis": "(0, 1, x)",
    "str": "'x'",
    "Pairs": "((x, 0), (x + {k} + 1, 0.5), vec(x, 1))",
    "Points": "[(0, 0, {k}), vec(9, x, 0), (20, 0, x), (20, 30, 1)]",
    "Color": "(1, 0.5, x - 1)",
    "Frame": "((x, {k}, 0), (0, 1, 0), (0, 0, 1), 0.5)",
    "Bark": "((1, -1, 0), 0.25, (1, 1, 0), 0.2)",
}


def _every_shape() -> str:
    """A call of every word for shapes, with all of its parameters."""
    lines = ["def m():", "    x = uniform(1, 2)"]
    for word, (_, rows) in _engine.SHAPES.items():
        data = {"vertices": "V", "faces": "F"}
        arguments = (
            f"{row[0]}={data.get(row[0]) or _FITS[row[1]].format(k=k)}" for k, row in enumerate(rows)
        )
        lines.append(f"    emit({word}({', '.join(arguments)}))")
    return "\n" + "\n".join([*lines, "    return x", ""])


FEATURES["every shape"] = _every_shape()


def feature(name: str) -> str:
    """The whole module of a feature; its model is `m`."""
    helpers, _, model = FEATURES[name].rpartition("def m():")
    return f"{HEADER}{helpers}@model\ndef m():{model}"
