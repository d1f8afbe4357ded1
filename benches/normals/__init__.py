"""Peers of variational inference."""
