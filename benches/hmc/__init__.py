"""Chains that follow the gradient, beside other systems; `benches/gradients.py` runs them. A file for each part:

densities  three log densities over NumPy-like libraries, and where chains start
ours       our chains, from `crates/search/examples/trajectories.rs`, and the limit by hand
peers      JAX, NumPyro, nutpie
rates      gradients per second, one chain and 64, taking turns
starts     the time until chains start
effective  effective samples per second
"""
