"""The peers: Hamiltonian Monte Carlo in JAX itself, NumPyro's, and nutpie's no-U-turn sampler over a JAX density.

All in double precision, the whole sampler compiled, the log density never evaluated inside a trajectory.
"""

import importlib.metadata
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hmc import densities

NAMES = ("jax", "numpyro", "nutpie")


def versions() -> dict[str, str]:
    """Return the peers that are installed."""
    table = {}
    for name in NAMES:
        try:
            table[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            continue
    return table


@dataclass
class Run:
    """The result of a run: gradients of all chains, clocks, and draws of the first chain, (draws, dim)."""

    gradients: int
    seconds: float
    cpu_seconds: float
    accept: float
    draws: np.ndarray

    @property
    def rate(self) -> float:
        """Gradients per second of wall."""
        return self.gradients / self.seconds

    @property
    def cpu_rate(self) -> float:
        """Gradients per second of CPU time."""
        return self.gradients / self.cpu_seconds


def timed(f: Callable[[], Any]) -> tuple[Any, float, float]:
    """Return the compiled value, wall seconds and CPU seconds."""
    import jax

    wall, cpu = time.perf_counter(), time.process_time()
    value = jax.block_until_ready(f())
    return value, time.perf_counter() - wall, time.process_time() - cpu


class Chains:
    """A sampler of one density, compiled for a number of draws and chains."""

    def __init__(self, name: str, draws: int, chains: int, make: Callable[[str, int, int], Any]) -> None:
        self.name, self.draws, self.chains = name, draws, chains
        self._run = make(name, draws, chains)

    def __call__(self, point: np.ndarray, seed: int) -> Run:
        (x, accept), seconds, cpu = timed(lambda: self._run(point, seed))
        gradients = self.draws * self.chains * densities.STEPS[self.name]
        draws = np.asarray(x).reshape((-1, self.draws, point.size))[0]
        return Run(gradients, seconds, cpu, float(np.mean(accept)), draws)


def log_density(name: str) -> Callable[[Any], Any]:
    """A density over JAX arrays."""
    import jax.numpy as jnp

    return densities.density(jnp, name)


def raw(name: str, draws: int, chains: int) -> Any:
    """JAX itself: one loop over draws, one over leapfrog steps; `vmap` for several chains."""
    import jax
    import jax.numpy as jnp

    log = log_density(name)
    slope, length, step = jax.grad(log), densities.STEPS[name], densities.STEP_SIZES[name]

    def draw(state: Any, key: Any) -> Any:
        x, value, g = state
        for_momentum, for_acceptance = jax.random.split(key)
        p = jax.random.normal(for_momentum, x.shape)
        energy = 0.5 * p @ p - value

        def leap(_: Any, moving: Any) -> Any:
            q, p, g = moving
            p = p + 0.5 * step * g
            q = q + step * p
            g = slope(q)
            return q, p + 0.5 * step * g, g

        q, p, there = jax.lax.fori_loop(0, length, leap, (x, p, g))
        new = log(q)
        accept = jnp.nan_to_num(jnp.minimum(1.0, jnp.exp(energy - 0.5 * p @ p + new)), nan=0.0)
        kept = jax.random.uniform(for_acceptance) < accept
        state = tuple(jnp.where(kept, a, b) for a, b in zip((q, new, there), state, strict=True))
        return state, (state[0], accept)

    def chain(x: Any, key: Any) -> Any:
        return jax.lax.scan(draw, (x, log(x), slope(x)), jax.random.split(key, draws))[1]

    if chains == 1:
        compiled_chain = jax.jit(chain)
        return lambda point, seed: compiled_chain(jnp.asarray(point), jax.random.key(seed))
    many = jax.jit(jax.vmap(chain))
    return lambda point, seed: many(
        jnp.tile(jnp.asarray(point), (chains, 1)), jax.random.split(jax.random.key(seed), chains)
    )


def numpyro(name: str, draws: int, chains: int) -> Any:
    """NumPyro's HMC with the same fixed trajectory."""
    import jax
    import jax.numpy as jnp
    from numpyro.infer import HMC

    log = log_density(name)
    kernel = HMC(
        potential_fn=lambda x: -log(x),
        step_size=densities.STEP_SIZES[name],
        num_steps=densities.STEPS[name],
        trajectory_length=None,
        adapt_step_size=False,
        adapt_mass_matrix=False,
    )

    def draw(state: Any, _: Any) -> Any:
        state = kernel.sample(state, (), {})
        return state, (state.z, state.accept_prob)

    chain = jax.jit(lambda state: jax.lax.scan(draw, state, None, length=draws)[1])

    def run(point: np.ndarray, seed: int) -> Any:
        state = kernel.init(jax.random.key(seed), 0, jnp.asarray(point), model_args=(), model_kwargs={})
        return chain(state)

    return run


def numpyro_nuts(name: str, point: np.ndarray, warmup: int, draws: int, seed: int) -> tuple[Run, float]:
    """NumPyro's no-U-turn sampler with its own warm-up: (a run after compilation, seconds of the first run)."""
    import jax
    import jax.numpy as jnp
    from numpyro.infer import MCMC, NUTS

    log = log_density(name)
    kernel = NUTS(potential_fn=lambda x: -log(x), target_accept_prob=0.8, max_tree_depth=10)
    chain = MCMC(kernel, num_warmup=warmup, num_samples=draws, progress_bar=False, jit_model_args=True)

    def run(seed: int) -> Any:
        fields = ("num_steps", "accept_prob")
        chain.warmup(
            jax.random.key(seed), init_params=jnp.asarray(point), extra_fields=fields, collect_warmup=True
        )
        steps = int(chain.get_extra_fields()["num_steps"].sum())
        chain.run(jax.random.key(seed + 1000), extra_fields=fields)
        return chain.get_samples(), chain.get_extra_fields(), steps

    _, first, _ = timed(lambda: run(seed))
    (x, facts, steps), seconds, cpu = timed(lambda: run(seed))
    steps += int(facts["num_steps"].sum())
    return Run(steps, seconds, cpu, float(facts["accept_prob"].mean()), np.asarray(x)), first


def nutpie_nuts(name: str, point: np.ndarray, warmup: int, draws: int, seed: int) -> Run:
    """nutpie's no-U-turn sampler, which calls the compiled JAX density from Python for each gradient."""
    import jax
    import nutpie
    from nutpie.compiled_pyfunc import from_pyfunc

    both = jax.jit(jax.value_and_grad(log_density(name)))
    both(point)

    def log_and_slope(x: np.ndarray) -> tuple[float, np.ndarray]:
        value, slope = both(x)
        return float(value), np.array(slope, dtype=np.float64)

    model = from_pyfunc(
        point.size,
        lambda: log_and_slope,
        lambda *_: lambda x: {"x": np.array(x)},
        [np.dtype(np.float64)],
        [(point.size,)],
        ["x"],
        make_initial_point_fn=lambda _seed: point,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        wall, cpu = time.perf_counter(), time.process_time()
        trace = nutpie.sample(
            model,
            draws=draws,
            tune=warmup,
            chains=1,
            cores=1,
            seed=seed,
            progress_bar=False,
            save_warmup=True,
        )
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    facts = trace.sample_stats
    steps = int(facts["n_steps"].sum()) + int(trace.warmup_sample_stats["n_steps"].sum())
    return Run(steps, wall, cpu, float(facts["mean_tree_accept"].mean()), np.asarray(trace.posterior["x"])[0])
