"""Programs that use one part of the language each, to compare ways of running them."""

# ruff: noqa: E501

from __future__ import annotations

HEADER = """import math
from dataclasses import dataclass
from typing import NamedTuple
import numpy as np
from niwaki.words import *
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
    e = sample(Delta(3))
    f = choose(["x", "y", (1, 2)])
    g = choose([10, 20], [1, 3])
    observe(G, a)
    observe(Dirichlet([1, 1, 1]), b)
    k = Gaussian(a, 1)
    dd = [Gaussian(0, 1), Gaussian(5, 1)]
    h = sample(dd[flip(0.5)])
    return a, b, c, d, e, f, g, b[0] + c[1], sum(b), k, h
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
}


def feature(name: str) -> str:
    """The whole module of a feature; its model is `m`."""
    helpers, _, model = FEATURES[name].rpartition("def m():")
    return f"{HEADER}{helpers}@model\ndef m():{model}"
