"""The compiled engine: what the door between Python and Rust offers."""

__all__ = ["__version__"]

__version__: str
