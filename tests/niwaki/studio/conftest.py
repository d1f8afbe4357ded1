"""One studio for the tests of a file."""

from studio_fixtures import pile, served

__all__ = ["pile", "served"]
