"""The compiled engine: what the door between Python and Rust offers."""

__version__: str
