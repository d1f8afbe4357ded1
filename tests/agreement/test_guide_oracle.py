"""A guide's loss, its slope and its optimiser are those of the same network in JAX and Optax, to 1e-6 of each number.

The network here is written from the documented layout of the file, and the densities from their formulas. Needs the
extra `guides-oracle`. Seeds are fixed; nothing here is statistical.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from niwaki import _engine

jax = pytest.importorskip("jax", reason="needs JAX and Optax: the extra guides-oracle")
optax = pytest.importorskip("optax", reason="needs JAX and Optax: the extra guides-oracle")

import jax.numpy as jnp  # noqa: E402
from jax.scipy.special import logsumexp  # noqa: E402
from jax.scipy.stats import norm  # noqa: E402

jax.config.update("jax_enable_x64", True)

SHARE = 0.05
FORM = {
    "windows": 6,
    "features": 4,
    "hidden": [11, 9],
    "heads": [{"Normal": {"components": 4}}, {"Finite": {"values": 3}}, {"Count": {"components": 2}}],
}
OUTPUTS = [12, 3, 6]


def up(n: int) -> int:
    """The next multiple of eight: rows are padded to it."""
    return -(-n // 8) * 8


def shapes() -> list[tuple[int, int]]:
    """Rows and padded columns of each block of weights, in the order of the file."""
    first, second = FORM["hidden"]
    blocks = [
        (6, up(first)),
        (4, up(first)),
        (3, up(first)),
        (1, up(first)),
        (first, up(second)),
        (1, up(second)),
    ]
    for outputs in OUTPUTS:
        blocks += [(second, up(outputs)), (1, up(outputs))]
    return blocks


def columns() -> list[int]:
    """Used columns of each block."""
    first, second = FORM["hidden"]
    return [first] * 4 + [second] * 2 + [n for n in OUTPUTS for _ in range(2)]


def tensors(data: bytes) -> dict[str, slice]:
    """Where the tensors of a safetensors file stand."""
    size = int.from_bytes(data[:8], "little")
    header = json.loads(data[8 : 8 + size])
    del header["__metadata__"]
    return {k: slice(*(8 + size + at for at in t["data_offsets"])) for k, t in header.items()}


def network(seed: int) -> tuple[bytes, np.ndarray, np.ndarray]:
    """The bytes of a network with random weights; its weights; means and scales of its features."""
    random = np.random.default_rng(seed)
    data = bytearray(_engine.guide_net(json.dumps(FORM), seed))
    blocks = []
    for (rows, width), used in zip(shapes(), columns(), strict=True):
        block = np.zeros((rows, width), np.float32)
        block[:, :used] = random.normal(size=(rows, used)) * 0.6
        blocks.append(block.ravel())
    weights = np.concatenate(blocks)
    features = random.uniform(0.3, 2.0, size=(4, 2)).astype(np.float32)
    where = tensors(bytes(data))
    data[where["weights"]] = weights.tobytes()
    data[where["features"]] = features.tobytes()
    return bytes(data), weights.astype(np.float64), features.astype(np.float64)


def choices(n: int, seed: int) -> list[dict[str, Any]]:
    """Random choices at all three sites; some lack features, and some are outside of their coordinate's limits."""
    random = np.random.default_rng(seed)
    number = lambda *shape: random.normal(size=shape).astype(np.float32).tolist()  # noqa: E731
    rows = []
    for k in range(n):
        site = k % 3
        if site == 0:
            lesson = {"Normal": {"z": 2 * random.normal(), "log_prior": -1.3, "limits": [-2.0, 3.5]}}
        elif site == 1:
            priors = np.log(random.dirichlet(np.ones(3))).tolist()
            lesson = {"Finite": {"value": int(random.integers(3)), "log_priors": priors}}
        else:
            low = random.normal()
            lesson = {"Count": {"between": [low, low + random.uniform(0.01, 2.0)], "log_prior": -0.9}}
        some = sorted(random.choice(4, size=int(random.integers(5)), replace=False).tolist())
        features = [[int(j), x] for j, x in zip(some, number(len(some)), strict=True)]
        rows.append({"site": site, "window": number(6), "features": features, "lesson": lesson})
    return rows


def mixture(outputs: jax.Array) -> tuple[jax.Array, jax.Array, jax.Array]:
    """Logs of weights, means and deviations."""
    logits, means, logs = jnp.split(outputs, 3)
    return logits - logsumexp(logits), means, jnp.exp(jnp.clip(logs, -7.0, 1.6))


def log_quotient(outputs: jax.Array, lesson: dict[str, Any]) -> jax.Array:
    """ln(q / p) of a lesson."""
    (kind, of), *_ = lesson.items()
    if kind == "Finite":
        net = jax.nn.log_softmax(outputs + jnp.array(of["log_priors"]))[of["value"]]
        return jnp.log((1 - SHARE) * jnp.exp(net - of["log_priors"][of["value"]]) + SHARE)
    log_weights, means, sds = mixture(outputs)
    if kind == "Count":
        a, b = of["between"]
        mass = jnp.exp(log_weights) @ (norm.cdf(b, means, sds) - norm.cdf(a, means, sds))
        return jnp.log((1 - SHARE) * mass / jnp.exp(of["log_prior"]) + SHARE)
    low, high = of["limits"]
    outside = jnp.exp(log_weights) @ (norm.cdf(low, means, sds) + norm.sf(high, means, sds))
    density = jnp.exp(logsumexp(log_weights + norm.logpdf(of["z"], means, sds)))
    inside = density / jnp.exp(of["log_prior"]) if low < of["z"] < high else 0.0
    return jnp.log((1 - SHARE) * (inside + outside) + SHARE)


def loss(weights: jax.Array, features: np.ndarray, rows: list[dict[str, Any]]) -> jax.Array:
    """The mean loss of choices."""
    ends = np.cumsum([a * b for a, b in shapes()])[:-1]
    blocks = [
        part.reshape(shape)[:, :used]
        for part, shape, used in zip(jnp.split(weights, ends), shapes(), columns(), strict=True)
    ]
    total = 0.0
    for row in rows:
        hidden = jnp.array(row["window"]) @ blocks[0] + blocks[2][row["site"]] + blocks[3][0]
        for k, x in row["features"]:
            hidden = hidden + jnp.clip((x - features[k, 0]) * features[k, 1], -10, 10) * blocks[1][k]
        hidden = jnp.tanh(jnp.tanh(hidden) @ blocks[4] + blocks[5][0])
        head = 6 + 2 * row["site"]
        total = total - log_quotient(hidden @ blocks[head] + blocks[head + 1][0], row["lesson"])
    return total / len(rows)


@pytest.mark.parametrize("seed", [1, 2])
def test_loss_and_slope_are_those_of_jax(seed: int) -> None:
    data, weights, features = network(seed)
    rows = choices(60, seed)
    got, slope = _engine.guide_slope(data, json.dumps(rows), SHARE)
    expected, gradient = jax.value_and_grad(loss)(jnp.array(weights), features, rows)
    assert got == pytest.approx(float(expected), rel=1e-9)
    np.testing.assert_allclose(slope, gradient, rtol=1e-6, atol=1e-10)
    assert np.count_nonzero(slope) > 400


def test_steps_are_those_of_optax() -> None:
    random = np.random.default_rng(3)
    start = random.normal(size=50)
    slopes = random.normal(size=(20, 50)) * 10.0 ** random.uniform(-9, 3, size=50)
    got, averaged = _engine.guide_steps(start, slopes, 2e-3, 0.998)
    adam, mean = optax.adam(2e-3), optax.ema(0.998)
    weights = jnp.array(start)
    state, mean_state = adam.init(weights), mean.init(weights)
    for slope in slopes:
        update, state = adam.update(jnp.array(slope), state)
        weights = optax.apply_updates(weights, update)
        expected, mean_state = mean.update(weights, mean_state)
    np.testing.assert_allclose(got, weights, rtol=1e-6)
    np.testing.assert_allclose(averaged, expected, rtol=1e-6)
