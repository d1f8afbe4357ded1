"""NumPyro's automatic guides and BlackJAX's Pathfinder, over the densities of `hmc/densities.py`."""

import time
from functools import cache
from typing import Any

import numpy as np
from hmc import densities

#: Learning rates that are tried; the best counts.
RATES = (0.003, 0.01, 0.03, 0.1)
#: Draws of each step, as ours.
SAMPLES = 16
#: No learning rate runs longer than this, seconds.
LONGEST = 60.0


@cache
def log_density(name: str) -> Any:
    """A density over JAX arrays."""
    import jax.numpy as jnp

    return densities.density(jnp, name)


@cache
def _of_each(name: str) -> Any:
    """The log densities of many points, compiled."""
    import jax

    log = log_density(name)
    return jax.jit(lambda draws: jax.lax.map(log, draws))


def bound_of(name: str, draws: Any, log_q: Any) -> float:
    """The bound of a normal, by draws from it."""
    return float(np.mean(np.asarray(_of_each(name)(draws)) - np.asarray(log_q)))


def autoguide(
    name: str, family: str, start: np.ndarray, looks: list[int], goal: float, near: float, draws: int
) -> dict[str, Any]:
    """The quickest of several learning rates to come near the goal; where none does, the one of the best bound."""
    fits = [guide_at(name, family, start, looks, goal, near, draws, rate) for rate in RATES]
    reached = [fit for fit in fits if fit["bound"] >= goal - near]
    if reached:
        return min(reached, key=lambda fit: fit["seconds"])
    return max(fits, key=lambda fit: fit["bound"])


def guide_at(
    name: str,
    family: str,
    start: np.ndarray,
    looks: list[int],
    goal: float,
    near: float,
    draws: int,
    rate: float,
) -> dict[str, Any]:
    """Steps of one learning rate until the bound is near the goal."""
    import jax
    import jax.numpy as jnp
    import numpyro
    import numpyro.distributions as dist
    from numpyro.infer import SVI, Trace_ELBO, init_to_value
    from numpyro.infer.autoguide import AutoMultivariateNormal, AutoNormal
    from numpyro.optim import Adam

    log = log_density(name)

    def model() -> None:
        support = dist.constraints.independent(dist.constraints.real, 1)
        x = numpyro.sample("x", dist.ImproperUniform(support, (), (start.size,)))
        numpyro.factor("log", log(x))

    kind = AutoNormal if family == "mean-field" else AutoMultivariateNormal
    guide = kind(model, init_loc_fn=init_to_value(values={"x": jnp.asarray(start)}))
    svi = SVI(model, guide, Adam(rate), Trace_ELBO(num_particles=SAMPLES))
    state = svi.init(jax.random.key(0))
    steps = jax.jit(lambda state, count: jax.lax.fori_loop(0, count, lambda _, s: svi.update(s)[0], state))
    clock = time.perf_counter()
    jax.block_until_ready(steps(state, 1))
    compiled = time.perf_counter() - clock
    steps_taken, seconds, bound = 0, 0.0, -np.inf
    for look in looks:
        clock = time.perf_counter()
        state = jax.block_until_ready(steps(state, look - steps_taken))
        seconds += time.perf_counter() - clock
        steps_taken = look
        now = guide_bound(name, family, svi.get_params(state), draws)
        bound = max(bound, now) if np.isfinite(now) else bound
        if bound >= goal - near or seconds > LONGEST:
            break
    return {
        "rate": rate,
        "bound": bound,
        "steps": steps_taken,
        "seconds": seconds,
        "compile_seconds": compiled,
    }


def guide_bound(name: str, family: str, params: dict[str, Any], draws: int) -> float:
    """The bound of a guide's normal, by draws from it."""
    z = np.random.default_rng(7).normal(size=(draws, densities.DIMS[name]))
    if family == "mean-field":
        mean, deviation = np.asarray(params["x_auto_loc"]), np.asarray(params["x_auto_scale"])
        x, log_det = mean + z * deviation, np.log(deviation).sum()
    else:
        mean, factor = np.asarray(params["auto_loc"]), np.asarray(params["auto_scale_tril"])
        x, log_det = mean + z @ factor.T, np.log(np.abs(np.diag(factor))).sum()
    if not np.isfinite(x).all():
        return -np.inf
    log_q = -0.5 * (z**2).sum(axis=1) - 0.5 * z.shape[1] * np.log(2 * np.pi) - log_det
    return bound_of(name, x, log_q)


def pathfinder(name: str, start: np.ndarray, draws: int) -> dict[str, Any]:
    """BlackJAX's Pathfinder of one path, compiled; timed again after its compilation."""
    import jax
    import jax.numpy as jnp
    from blackjax.vi import pathfinder as peer

    log = log_density(name)
    run = jax.jit(lambda key, x: peer.approximate(key, log, x, num_samples=SAMPLES))
    times = []
    for seed in (0, 1):
        clock = time.perf_counter()
        state, _ = jax.block_until_ready(run(jax.random.key(seed), jnp.asarray(start)))
        times.append(time.perf_counter() - clock)
    x, log_q = peer.sample(jax.random.key(2), state, draws)
    return {
        "bound": bound_of(name, x, log_q),
        "steps": 1,
        "seconds": times[1],
        "compile_seconds": times[0] - times[1],
    }
