"""Errors while a model runs: reported by the engine, and by the plain run where Python would raise.

The part that reports a fault usually gives the title, with the values; the titles here are the defaults.
"""

from __future__ import annotations

from niwaki.errors.texts.message import Message

#: What an invalid run is in a search.
INVALID = "in a search such a run has probability zero; it is an error in a single run, and if every run of a search has it"

FAULTS = (
    Message(
        "list-index",
        "an index is outside of the list",
        "no such item",
        help="indices run from 0 to `len(xs) - 1`; negative ones count from the end",
        example="[1, 2, 3][3]",
        cure="[1, 2, 3][2]",
    ),
    Message(
        "future-not-forced",
        "a future was looked at that is not forced",
        "looks at a future",
        why="a future may still have to run; only `force` waits for its value",
        help="write `force(f)`",
        example="f = future(part)\nif f:\n    ...",
        cure="f = future(part)\nif force(f):\n    ...",
    ),
    Message(
        "memo-argument",
        "a value cannot be an argument of a memoised function",
        "called with it here",
        why="calls with equal arguments are one call, so it must be known whether two arguments are equal",
        help="give it numbers, truths, strings, `None`, or tuples and lists of them; of a record, its fields",
        example="height = mem(tree)\nheight(lambda: 3)",
        cure="height = mem(tree)\nheight(3)",
    ),
    Message(
        "memo-argument-varies",
        "an argument of a memoised function depends on a choice that a method moves along its gradient",
        "called with it here",
        why="calls with different arguments have different choices: a small step of the argument would exchange all of them, so there "
        "is no gradient",
        help="use a method without gradients (`mh`, `smc`), or compute the argument from other choices",
        example="x = gaussian(0, 1)\nnoise(x)",
        cure="x = gaussian(0, 1)\nnoise(round(3.7))",
    ),
    Message(
        "memo-cycle",
        "a memoised call needs its own value",
        "asks for the value that is being computed",
        help="let it call itself only with other arguments, which end",
        example="@mem\ndef f(n):\n    return f(n) + 1",
        cure="@mem\ndef f(n):\n    return f(n - 1) + 1 if n > 0 else 0",
    ),
    Message(
        "memo-outside",
        "a memoised function is given to an `infer`",
        "given away here",
        why="its calls belong to the run around; the inner search has runs of its own, which would draw other values",
        help="call it before, and give its value; a function of a module that is marked with `@mem` can be called in the inner model, and "
        "has other values in each of its runs",
        example="color = mem(paint)\ninfer(inner, method, color)",
        cure="color = mem(paint)\ninfer(inner, method, color(3))",
    ),
    Message(
        "memo-regrow",
        "the parts of a model with memoised functions cannot be grown again",
        why="a part is grown again apart from the rest, but calls of memoised functions are shared by all parts",
        help="use other kernels: `prior`, `drift`, `regenerate`, `block`; or functions that are not memoised",
        example="mh(100, kernel=kernels.regrow(particles=8))",
        cure="mh(100, kernel=kernels.regenerate())",
    ),
    Message(
        "missing-key",
        "a dict has no such key",
        "no such key",
        help="use `d.get(key, default)`, or add the key where the dict is written",
        example='{"a": 1}["b"]',
        cure='{"a": 1}.get("b", 0)',
    ),
    Message(
        "missing-field",
        "a value has no such field",
        "no such field",
        help="records have the fields of their class; vectors have x, y, z and w",
        example="vec(1, 2).z",
        cure="vec(1, 2, 0).z",
    ),
    Message(
        "division-by-zero",
        "division by zero",
        "divides here",
        help="keep the divisor away from zero, for instance with `max(x, 1e-9)`",
        example="1 / (len(xs) - 1)",
        cure="1 / max(len(xs) - 1, 1)",
    ),
    Message(
        "integer-overflow",
        "an integer needs more than 64 bits",
        "too large",
        why="integers have 64 bits; a silent wrap-around would be a wrong answer",
        help="compute with real numbers: `float(n)` or `2.0 ** n`",
        example="2 ** 64",
        cure="2.0 ** 64",
    ),
    Message(
        "float-overflow",
        "a number is too large for a real number",
        "too large",
        help="compute with logarithms, or keep the argument in range with `clip`",
        example="math.exp(1000)",
        cure="math.exp(clip(x, -700, 700))",
    ),
    Message(
        "math-domain",
        "a function is called with a number outside of its domain",
        "no such value",
        help="keep the argument in the function's domain, for instance `math.sqrt(max(x, 0))`",
        example="math.sqrt(-1)",
        cure="math.sqrt(max(x, 0))",
    ),
    Message(
        "type-mismatch",
        "an operation does not fit its values",
        "cannot do this with these values",
        why="values are never converted or stretched silently",
        help="convert with `int`, `float`, `str`, `list`, or check where the value comes from",
        example='1 + "a"',
        cure='str(1) + "a"',
    ),
    Message(
        "bad-argument",
        "a value that cannot be used here",
        "cannot use this value",
        help="check where the value comes from",
        example="max([])",
        cure="max([], default=0)",
    ),
    Message(
        "unpack-length",
        "a list has another length than the names on the left",
        "unpacked here",
        help="write as many names as there are values, or take the rest with `*rest`",
        example="a, b = [1, 2, 3]",
        cure="a, b, c = [1, 2, 3]",
    ),
    Message(
        "wrong-arity",
        "a function value is called with the wrong number of arguments",
        "called here",
        help="call it with as many values as it has parameters",
        example="(lambda x: x)(1, 2)",
        cure="(lambda x, y: x)(1, 2)",
    ),
    Message(
        "not-callable",
        "a value is called that is not a function",
        "not a function",
        help="check where the value comes from",
        example="f = 3\nf(1)",
        cure="f = lambda x: 3 * x\nf(1)",
    ),
    Message(
        "unassigned-variable",
        "a variable has no value yet",
        "no value here",
        why="it is assigned in a branch or a loop that did not run",
        help="give it a value before the branch",
        example="if flip():\n    x = 1\nreturn x",
        cure="x = 0\nif flip():\n    x = 1\nreturn x",
    ),
    Message(
        "assertion",
        "an assertion of the model does not hold",
        "is false",
        help="the model assumes something that is false in this run; replay the run and check the values",
        example='assert radius > 0, "radius"',
        cure="radius = max(radius, 0.1)",
    ),
    Message(
        "argument-count",
        "a built-in is called with the wrong number of arguments",
        "called here",
        help="give it as many arguments as it takes",
        example="list(map(math.atan2, xs))",
        cure="list(map(math.atan2, ys, xs))",
    ),
    Message(
        "bad-text",
        "a text cannot be converted to a number",
        "converted here",
        help="check where the text comes from",
        example='int("many")',
        cure='int("12")',
    ),
    Message(
        "bad-format",
        "a format does not fit its value",
        "formatted here",
        help="`d` is for integers, `f`, `e` and `g` for reals, none for anything",
        example='f"{1.5:d}"',
        cure='f"{1.5:.2f}"',
    ),
    Message(
        "missing-element",
        "a list or a string does not contain the value",
        "not there",
        help="test with `in` first",
        example="[1, 2].index(3)",
        cure="xs.index(3) if 3 in xs else -1",
    ),
    Message(
        "missing-method",
        "a value has no such method",
        "no such method",
        help="check where the value comes from",
        example="n.upper()",
        cure="str(n).upper()",
    ),
    Message(
        "not-runnable",
        "a future that cannot run now was resumed",
        "waits here",
        why="it waits for another future, or has returned",
        help="resume one of the futures that can run",
        example="resuming a future that waits",
        cure="resuming a future that can run",
    ),
    Message(
        "bad-parameter",
        "a distribution's parameter is out of range",
        "no such distribution",
        why=INVALID,
        help="keep the parameter in its range for all values of the choices that it depends on, for instance with `max`, `min` or `clip`",
        example="gaussian(0, -1)",
        cure="gaussian(0, max(s, 1e-6))",
        about=(
            "In a search such a run has probability zero; it is an error in a single run, and if every run of a search has "
            "it. These are the ranges; every number is finite.\n\n"
            "| distribution | parameters |\n| --- | --- |\n"
            "| `bernoulli` (`flip`) | p from 0 to 1 |\n"
            "| `categorical` | weights 0 or more, at least one above 0 |\n"
            "| `discrete_uniform` | integers, lo not above hi |\n"
            "| `poisson` | rate from 0 to 1e15 |\n"
            "| `exponential` | rate above 0 |\n"
            "| `binomial` | n an integer, 0 or more; p from 0 to 1 |\n"
            "| `geometric` | p above 0, not above 1 |\n"
            "| `uniform` | lo below hi |\n"
            "| `gaussian` | sd above 0 |\n"
            "| `log_normal` | sd above 1e-147, mean at most 1e150 times sd away from 0 |\n"
            "| `gamma`, `inverse_gamma` | shape and scale above 0 |\n"
            "| `beta` | a and b above 0 |\n"
            "| `laplace`, `cauchy` | scale above 0 |\n"
            "| `student_t` | df and scale above 0 |\n"
            "| `von_mises` | concentration 0 or more |\n"
            "| `truncated_gaussian` | sd above 0, lo below hi |\n"
            "| `dirichlet` | all concentrations above 0, at most 1e300 together |\n"
            "| `multivariate_gaussian` | covariance symmetric and positive definite, of the size of the mean |\n"
            "| `diagonal_gaussian` | every sd above 0, as many as means |\n"
            "| `multinomial` | n an integer, 0 or more; weights as of `categorical` |\n"
            "| `multivariate_bernoulli` | every p from 0 to 1 |\n"
            "| `mixture` | weights as of `categorical`, one for each component |\n"
            "| `delta` | any value |"
        ),
    ),
    Message(
        "not-a-distribution",
        "a draw or an observation needs a distribution",
        "not a distribution",
        help="write a distribution with a capital: `sample(Gaussian(0, 1))`; `gaussian(0, 1)` is already a draw",
        example="observe(gaussian(0, 1), x)",
        cure="observe(Gaussian(0, 1), x)",
    ),
    Message(
        "not-a-shape",
        "a value that is not a shape is added to the scene",
        "not a shape",
        help="emit what `box`, `cylinder` and the other words for shapes give, or lists of it",
        example="emit((0, 0, 0))",
        cure="emit(box((0, 0, 0), (1, 1, 1)))",
    ),
    Message(
        "bad-shape",
        "a shape has impossible measures",
        "created here",
        why=INVALID,
        help="sizes, radii and lengths are finite and greater than 0",
        example="box((0, 0, 0), (1, 0, 1))",
        cure="box((0, 0, 0), (1, 0.1, 1))",
    ),
    Message(
        "non-finite-score",
        "a score is not a number, or is plus infinity",
        "scored here",
        why="runs are compared by their scores; such a score cannot be compared",
        help="keep scores finite; `-inf`, or `condition(False)`, forbids a run",
        example="factor(math.inf)",
        cure="factor(-distance)",
    ),
    Message(
        "query-twice",
        "a query key is written twice in one run",
        "written again",
        why="a query has one value in a run",
        help='give each value its own key, for instance with a number: `query(f"size {{i}}", x)`',
        example='query("a", 1)\nquery("a", 2)',
        cure='query("a 1", 1)\nquery("a 2", 2)',
    ),
    Message(
        "waiting-cycle",
        "futures wait for one another",
        "waits here",
        why="none of them can continue",
        help="force a future outside of the calls that it waits for",
        example="a future that forces the future that forces it",
        cure="force both in the function that created them",
    ),
    Message(
        "step-budget",
        "the model ran longer than its budget of steps",
        "still running here",
        why="a program that never ends would stop the whole search; calls, iterations and every eight elements of an "
        "operation on many are steps, a primitive takes 256, and those of an `infer` count in the run around it",
        help="bound the recursion or the loop (give it a depth), search with fewer runs inside, or raise `max_steps`",
        example="def grow():\n    grow()",
        cure="def grow(depth):\n    if depth > 0:\n        grow(depth - 1)",
    ),
    Message(
        "memory-budget",
        "the model uses more memory than its budget",
        "growing here",
        why="calls, values and choices count; particles have the budget together, several chains or populations an equal "
        "share each, and an `infer` a quarter",
        help="bound the recursion or the list, use fewer particles or chains, or raise `max_memory`",
        example="xs = [0]\nwhile True:\n    xs = xs + xs",
        cure="xs = [0] * 1000",
    ),
    Message(
        "too-deep",
        "calls are nested too deep for plain Python",
        "called again",
        why="plain Python stops at about a thousand nested calls; the engine does not",
        help="bound the recursion, run the model in the engine, or raise `sys.setrecursionlimit`",
        example="def grow(n):\n    return grow(n + 1)",
        cure="def grow(n):\n    return n if n > 100 else grow(n + 1)",
    ),
    Message(
        "host-function",
        "a host function failed",
        "called here",
        why=INVALID,
        help="run it alone with these arguments; in a search, an exception may stand for what is impossible",
        example="@nw.host\ndef look_up(name):\n    return TABLE[name]",
        cure="@nw.host\ndef look_up(name):\n    return TABLE.get(name, 0)",
    ),
    Message(
        "infer-failed",
        "an `infer` inside of the model has no result",
        "searched here",
        help="loosen the inner model's conditions, or search it longer; run it alone with the same arguments",
        example="infer(never, rejection(1, max_tries=10))",
        cure="infer(never, rejection(1, max_tries=100_000))",
    ),
    Message(
        "no-derivative",
        "this has no derivative",
        "the score depends on it",
        why="a gradient method follows the slope of the score, and here there is none",
        help="compute the score without it, search by `enumerate_all()` where it is an `infer`, or use particles, which "
        "need no gradient",
        example="factor(-len(f'{gaussian(0, 1)}'))",
        cure="factor(-abs(gaussian(0, 1)))",
    ),
    Message(
        "non-finite-gradient",
        "the gradient is not finite here",
        "its slope is infinite or not a number",
        why="a chain follows the slope of every term of the score, and cannot follow a slope that is not finite",
        help="look for a root, a power or a quotient at zero, and keep its argument away from zero",
        example="factor(-math.sqrt(abs(x))) at x = 0",
        cure="factor(-math.sqrt(x * x + 1e-6))",
    ),
    Message(
        "extreme-scale",
        "the scale of this choice is too far from 1 to follow a gradient",
        "its square is out of range",
        why="a chain learns the square of each scale, which is out of range above about 1e150 and below its inverse",
        help="draw from a scale of 1, and multiply",
        example="gaussian(0, 1e300 * gamma(2, 1))",
        cure="1e300 * gamma(2, 1) * gaussian(0, 1)",
    ),
    Message(
        "impossible-trace",
        "this run is impossible",
        "the score is minus infinity here",
        why="where the density is zero there is no gradient to follow",
        help="start from a possible run, for example the result of particles or of `rejection`",
        example="condition(gaussian(0, 1) > 3)",
        cure="factor(-(max(0, 3 - gaussian(0, 1)) ** 2))",
    ),
    Message(
        "bad-choice",
        "a given choice cannot have this value",
        "chosen here",
        why="its distribution never gives that value",
        help="give a value of the kind that the distribution draws",
        example='run_python(ship, choices={"wings": 0.5})',
        cure='run_python(ship, choices={"wings": 2})',
    ),
    Message(
        "model-failed",
        "the model failed",
        "here",
        help="replay the run in plain Python with the same seed to see where it fails",
        example="",
        cure="",
    ),
)
