"""Other optimisers on the same problem, with their defaults. Each asks `problem.evaluate` until all is spent.

`random` draws uniformly. `cma` is CMA-ES with integer variables, restarted with larger populations; `cma01` works on
the unit cube and rounds. `tpe` is Optuna's tree-structured Parzen estimator, defined by run. `ngopt` is Nevergrad's
meta-optimiser. `ga` is pymoo's genetic algorithm of mixed variables with populations of 30.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .parameters import Parameter, Values, drawn
from .problems import Problem, Spent


def random(problem: Problem, seed: int) -> None:
    stream = np.random.default_rng(seed)
    while True:
        problem.evaluate(drawn(problem.parameters, stream))


def cma(problem: Problem, seed: int) -> None:
    import cma

    count, whole = len(problem.parameters), []
    low, high, spread = np.zeros(count), np.ones(count), np.full(count, 0.25)
    for number, parameter in enumerate(problem.parameters):
        if parameter.kind != "real":
            most = len(parameter.levels) - 1
            low[number], high[number] = -0.49, most + 0.49
            spread[number] = max((most + 1) / 4, 0.4)
            whole.append(number)

    def decoded(x: Any) -> Values:
        values = {}
        for parameter, place in zip(problem.parameters, x, strict=True):
            if parameter.kind == "real":
                values[parameter.name] = _between(parameter, place)
            else:
                levels = parameter.levels
                values[parameter.name] = levels[int(min(max(round(place), 0), len(levels) - 1))]
        return values

    options = dict(bounds=[list(low), list(high)], CMA_stds=spread, integer_variables=whole)
    _restarted(cma, problem, seed, 1.0, (low + high) / 2, lambda r: low + r * (high - low), options, decoded)


def cma01(problem: Problem, seed: int) -> None:
    import cma

    middle = np.full(len(problem.parameters), 0.5)
    options = dict(bounds=[0, 1])
    _restarted(cma, problem, seed, 0.25, middle, lambda r: r, options, lambda x: _decoded(problem, x))


def _restarted(
    cma: Any,
    problem: Problem,
    seed: int,
    step: float,
    middle: Any,
    start: Callable[[Any], Any],
    options: dict[str, Any],
    decoded: Callable[[Any], Values],
) -> None:
    count, restarts = len(problem.parameters), 0
    stream = np.random.default_rng(seed)
    population = 4 + int(3 * math.log(count))
    while True:
        more = dict(seed=1000 * seed + restarts + 1, popsize=population * 2 ** min(restarts, 3), verbose=-9)
        begin = middle if restarts == 0 else start(stream.random(count))
        search = cma.CMAEvolutionStrategy(begin, step, options | more)
        while not search.stop():
            points = search.ask()
            search.tell(points, [-problem.evaluate(decoded(x)) for x in points])
        restarts += 1


def tpe(problem: Problem, seed: int) -> None:
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(direction="maximize", sampler=optuna.samplers.TPESampler(seed=seed))

    def objective(trial: Any) -> float:
        values: Values = {}
        for parameter in problem.parameters:
            name = parameter.name
            if not parameter.used(values):
                values[name] = parameter.unused
            elif parameter.kind == "real":
                values[name] = trial.suggest_float(name, *parameter.domain)
            elif parameter.kind == "whole":
                values[name] = trial.suggest_int(name, *parameter.domain)
            else:
                values[name] = trial.suggest_categorical(name, list(parameter.domain))
        return problem.evaluate(values)

    while True:
        study.optimize(objective, n_trials=50)


def ngopt(problem: Problem, seed: int) -> None:
    import nevergrad

    fields = {}
    for parameter in problem.parameters:
        if parameter.kind in ("real", "whole"):
            low, high = parameter.domain
            scalar = nevergrad.p.Scalar(lower=low, upper=high)
            fields[parameter.name] = scalar.set_integer_casting() if parameter.kind == "whole" else scalar
        else:
            fields[parameter.name] = nevergrad.p.Choice(list(parameter.domain))
    space = nevergrad.p.Dict(**fields)
    space.random_state.seed(seed)
    search = nevergrad.optimizers.NGOpt(parametrization=space, budget=problem.budget)
    while True:
        point = search.ask()
        search.tell(point, -problem.evaluate(point.value))


def ga(problem: Problem, seed: int) -> None:
    from pymoo.core.mixed import MixedVariableGA
    from pymoo.core.problem import ElementwiseProblem
    from pymoo.core.variable import Binary, Choice, Integer, Real
    from pymoo.optimize import minimize

    make = {
        "real": lambda row: Real(bounds=row.domain),
        "whole": lambda row: Integer(bounds=row.domain),
        "switch": lambda row: Binary(),
        "choice": lambda row: Choice(options=list(row.domain)),
    }
    variables = {row.name: make[row.kind](row) for row in problem.parameters}
    plain = {"real": float, "whole": int, "switch": bool, "choice": str}
    kinds = {row.name: plain[row.kind] for row in problem.parameters}

    class Black(ElementwiseProblem):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__(vars=variables, n_obj=1)

        def _evaluate(self, x: Any, out: Any, *rest: Any, **more: Any) -> None:
            out["F"] = -problem.evaluate({name: kinds[name](value) for name, value in x.items()})

    minimize(Black(), MixedVariableGA(pop_size=30), ("n_gen", 10**6), seed=seed, verbose=False)


def _between(parameter: Parameter, share: float) -> float:
    low, high = parameter.domain
    return float(low + min(max(share, 0.0), 1.0) * (high - low))


def _decoded(problem: Problem, x: Any) -> Values:
    values = {}
    for parameter, place in zip(problem.parameters, x, strict=True):
        if parameter.kind == "real":
            values[parameter.name] = _between(parameter, place)
        else:
            levels = parameter.levels
            values[parameter.name] = levels[min(max(int(place * len(levels)), 0), len(levels) - 1)]
    return values


PEERS: dict[str, Callable[[Problem, int], None]] = {
    function.__name__: function for function in (random, cma, cma01, tpe, ngopt, ga)
}

#: The library of each peer.
LIBRARIES = {"cma": "cma", "cma01": "cma", "tpe": "optuna", "ngopt": "nevergrad", "ga": "pymoo"}


def search(problem: Problem, peer: str, seed: int) -> None:
    """Search until all evaluations are spent."""
    try:
        PEERS[peer](problem, seed)
    except Spent:
        pass
    problem.finish()
