"""Values as plain data, and back, for the JSON of a search, which another process can read.

Numbers, texts, truth values and None are written as they are; any other value is a dict with one key that names its
kind. Reading imports no module and runs no stored program. A host function is looked up only in modules that the caller
trusts.
"""

from __future__ import annotations

import ast
import base64
import hashlib
import inspect
import math
import textwrap
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, is_dataclass, make_dataclass
from importlib import import_module
from typing import Any, NamedTuple, cast

import numpy as np

from niwaki import _engine
from niwaki.errors import InputError, NiwakiError
from niwaki.errors.schema import Unfit, fitted, inside, shown
from niwaki.inputs.modules import modules, public
from niwaki.lang.constants import NUMERIC
from niwaki.lang.marks import Host
from niwaki.lang.models import Model
from niwaki.lang.names import is_named_tuple, record_fields
from niwaki.targets.camera import Camera
from niwaki.targets.target import Receiver, Target
from niwaki.words import distributions
from niwaki.words.vectors import Rotation, Vec

#: The most bytes of an array.
LARGEST_ARRAY = 1 << 30

#: Errors that malformed data may raise in a reader.
MALFORMED = (
    KeyError,
    TypeError,
    ValueError,
    AttributeError,
    IndexError,
    ArithmeticError,
    OSError,
    RecursionError,
    MemoryError,
)


def text_hash(text: str) -> str:
    """SHA-256 of a text, in hexadecimal."""
    return hashlib.sha256(text.encode()).hexdigest()


def mesh_hash(mesh: Target | Receiver) -> str:
    """SHA-256 of a mesh's arrays, in hexadecimal."""
    return hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes()).hexdigest()


@dataclass(frozen=True)
class Writer:
    """Writer of values.

    Attributes
    ----------
    files : str
        The form of a mesh that was read from a file: "named" (the file and the hash of the mesh), "inside" (the
        arrays), or "hashed" (the hash alone, for the hash of a search).
    """

    files: str = "named"

    def __call__(self, value: Any) -> Any:
        """Write a value as plain data."""
        if value is None or isinstance(value, (bool, str)):
            return value
        if isinstance(value, np.generic):
            return self(value.item())
        if isinstance(value, int):
            return int(value)
        if isinstance(value, float):
            return float(value) if math.isfinite(value) else {"real": repr(float(value))}
        for kind, write in _WRITERS.items():
            if isinstance(value, kind):
                return write(self, value)
        if type(value).__module__ == distributions.__name__:
            return {"dist": type(value).__name__, "parameters": self.each(value.parameters)}
        if is_dataclass(value) or is_named_tuple(type(value)):
            names = record_fields(type(value))
            fields = {name: self(getattr(value, name)) for name in names}
            return {"record": record_class(type(value)), "fields": fields}
        if isinstance(value, tuple):
            return {"tuple": self.each(value)}
        if isinstance(value, list):
            return {"list": self.each(value)}
        if isinstance(value, dict):
            return {"dict": [[self(key), self(entry)] for key, entry in value.items()]}
        if isinstance(value, range):
            return {"range": [value.start, value.stop, value.step]}
        if callable(value):
            return {"host": host_reference(value)}
        raise InputError("argument-value", number="?", name="a search", found=f"a {type(value).__name__}")

    def each(self, values: Any) -> list[Any]:
        """Write several values."""
        return [self(value) for value in values]

    def array(self, value: np.ndarray[Any, Any]) -> dict[str, Any]:
        """Write an array: its type, its shape, and its bytes."""
        bytes_ = np.ascontiguousarray(value).tobytes()
        if self.files == "hashed":
            packed = hashlib.sha256(bytes_).hexdigest()
        else:
            packed = base64.b85encode(zlib.compress(bytes_)).decode()
        return {"array": value.dtype.str, "shape": list(value.shape), "bytes": packed}

    def mesh(self, kind: str, value: Target | Receiver) -> dict[str, Any]:
        """Write a mesh."""
        hashed = mesh_hash(value)
        if self.files == "hashed":
            return {kind: hashed}
        if self.files == "named" and value.source is not None:
            return {kind: hashed, "file": value.source}
        arrays = {"vertices": self.array(value.vertices), "faces": self.array(value.faces)}
        return {kind: hashed, "name": value.name, **arrays}

    def shape(self, value: _engine.Shape) -> dict[str, Any]:
        """Write a shape, as the engine describes it."""
        return {"shape": value.data()}


_WRITERS: dict[Any, Callable[[Writer, Any], Any]] = {
    np.ndarray: Writer.array,
    Target: lambda writer, value: writer.mesh("target", value),
    Receiver: lambda writer, value: writer.mesh("receiver", value),
    Camera: lambda writer, value: {"camera": value.to_dict()},
    _engine.Shape: Writer.shape,
    Vec: lambda writer, value: {"vec": list(value.parts)},
    Rotation: lambda writer, value: {"rotation": [list(part) for part in value]},
}


def record_class(kind: type) -> dict[str, Any]:
    """Write a class of records: its name, its fields, and its kind."""
    form = "namedtuple" if is_named_tuple(kind) else "dataclass"
    return {"name": kind.__name__, "fields": list(record_fields(kind)), "kind": form}


def of_record_class(data: Mapping[str, Any]) -> type:
    """Make a class of records from its data.

    Raises
    ------
    Unfit
        A name cannot be the name of a class or a field.
    """
    for name in (data["name"], *data["fields"]):
        # Both kinds of records are made from source text, so a name must be an identifier.
        if not isinstance(name, str) or not name.isidentifier() or name.startswith("__"):
            raise Unfit("$.fields", "names of a class and its fields", shown(name))
    fields = [(str(name), Any) for name in data["fields"]]
    if data["kind"] == "namedtuple":
        return cast(type, NamedTuple(data["name"], fields))
    return make_dataclass(data["name"], fields, frozen=True)


def host_reference(function: Any) -> dict[str, str]:
    """Write a host function: its module and name, and the hash of its source."""
    plain = inspect.unwrap(function.function if isinstance(function, Host) else function)
    name = getattr(plain, "__qualname__", type(plain).__qualname__)
    return {"module": public(getattr(plain, "__module__", "")), "name": name, "sha256": source_hash(plain)}


def source_hash(function: Any) -> str:
    """SHA-256 of a function: of its syntax tree without places and comments, or of its name without a source."""
    try:
        return text_hash(ast.dump(ast.parse(textwrap.dedent(inspect.getsource(function)))))
    except (OSError, TypeError, SyntaxError, RecursionError, MemoryError):
        return text_hash(getattr(function, "__qualname__", repr(type(function))))


@dataclass(frozen=True)
class Reader:
    """Reader of values.

    Malformed data raise `Unfit`, with their place.

    Attributes
    ----------
    trust : tuple of str
        Modules whose host functions may be called.
    """

    trust: tuple[str, ...] = ()

    def __call__(self, data: Any) -> Any:
        """Read a value from plain data."""
        if not isinstance(data, dict):
            if isinstance(data, (str, int, float, bool)) or data is None:
                return data
            raise Unfit("$", "a value, or a table with the name of its kind", shown(data))
        kind = next(iter(data), "")
        read = _READERS.get(kind)
        if read is None:
            raise Unfit("$", f"a kind of value among {', '.join(_READERS)}", shown(data))
        try:
            return read(self, data)
        except (NiwakiError, Unfit):
            raise
        except KeyError as error:
            raise Unfit(f"$.{error.args[0]}", "a value", "nothing") from error
        except (*MALFORMED, zlib.error, _engine.EngineFault) as error:
            raise Unfit("$", f"a value of the kind `{kind}`", f"{shown(data[kind])} ({error})") from error

    def each(self, data: Any, step: str = "") -> list[Any]:
        """Read several values; `step` is the path to their list."""
        if not isinstance(data, list):
            raise Unfit(f"${step}", "a list", shown(data))
        return [self.part(entry, f"{step}[{number}]") for number, entry in enumerate(data)]

    def part(self, data: Any, step: str) -> Any:
        """Read a value inside another; `step` is its path."""
        with inside(step):
            return self(data)

    def table(self, data: Mapping[str, Any], step: str = "") -> dict[str, Any]:
        """Read values by name; `step` is their path."""
        return {name: self.part(entry, f"{step}.{name}") for name, entry in data.items()}

    def record(self, data: Mapping[str, Any]) -> Any:
        """Read a record of a new class."""
        constructor = of_record_class(data["record"])
        return constructor(**self.table(data["fields"], ".fields"))

    def mesh(self, kind: type[Target] | type[Receiver], data: Mapping[str, Any]) -> Any:
        """Read a mesh from its file, or from its arrays.

        Raises
        ------
        InputError
            The file is missing, or its mesh has changed.
        """
        stored_hash = data[kind.__name__.lower()]
        if "file" in data:
            name = data["file"]
            mesh = kind.find(name)
            if mesh_hash(mesh) != stored_hash:
                raise InputError("changed-mesh", path=name)
            return mesh
        return kind(
            self.part(data["vertices"], ".vertices"), self.part(data["faces"], ".faces"), str(data["name"])
        )

    def host(self, data: Mapping[str, Any]) -> Any:
        """Find a host function by its reference.

        Raises
        ------
        InputError
            The module is not trusted, or the function is no host function, or has changed.
        """
        reference = data["host"]
        module, name = reference["module"], reference["name"]
        if module not in self.trust:
            reason = f"it calls the Python function `{module}.{name}`, and `{module}` is not among the trusted modules"
            raise InputError("untrusted-function", name=f"{module}.{name}", reason=reason)
        for place in modules(module) or [import_module(module)]:
            function: Any = place
            for part in name.split("."):
                function = getattr(function, part, None)
            if (
                isinstance(function, Host)
                and source_hash(inspect.unwrap(function.function)) == reference["sha256"]
            ):
                return function
        reason = "it is no host function there, or it has changed"
        raise InputError("untrusted-function", name=f"{module}.{name}", reason=reason)


def _array(reader: Reader, data: Mapping[str, Any]) -> Any:
    dtype, shape = np.dtype(data["array"]), data["shape"]
    if dtype.kind not in NUMERIC or dtype.subdtype is not None:
        raise Unfit("$.array", "a type of numbers", shown(data["array"]))
    size = dtype.itemsize * math.prod(shape)
    if not all(isinstance(length, int) and length >= 0 for length in shape) or size > LARGEST_ARRAY:
        raise Unfit("$.shape", f"a shape of at most {LARGEST_ARRAY >> 20} MiB", shown(shape))
    # At most one byte more than the shape needs is decompressed, so a short text cannot fill the memory.
    raw = zlib.decompressobj().decompress(base64.b85decode(data["bytes"]), size + 1)
    if len(raw) != size:
        raise Unfit("$.bytes", f"{size} bytes", "more" if len(raw) > size else f"{len(raw)}")
    return np.frombuffer(raw, dtype=dtype).reshape(shape)


def _distribution(reader: Reader, data: Mapping[str, Any]) -> Any:
    constructor = getattr(distributions, data["dist"], None)
    if not (isinstance(constructor, type) and issubclass(constructor, distributions.Distribution)):
        raise Unfit("$.dist", "the name of a distribution", shown(data["dist"]))
    return constructor(*reader.each(data["parameters"], ".parameters"))


def _numbers(data: Mapping[str, Any], kind: str, form: Any) -> Any:
    with inside(f".{kind}"):
        return fitted(data[kind], form)


_Three = tuple[float, float, float]

_READERS: dict[str, Callable[[Reader, Any], Any]] = {
    "real": lambda reader, data: float(data["real"]),
    "tuple": lambda reader, data: tuple(reader.each(data["tuple"], ".tuple")),
    "list": lambda reader, data: reader.each(data["list"], ".list"),
    "dict": lambda reader, data: {
        reader.part(key, f".dict[{n}][0]"): reader.part(entry, f".dict[{n}][1]")
        for n, (key, entry) in enumerate(data["dict"])
    },
    "range": lambda reader, data: range(*_numbers(data, "range", tuple[int, int, int])),
    "vec": lambda reader, data: Vec(tuple(_numbers(data, "vec", list[float]))),
    "rotation": lambda reader, data: Rotation(_numbers(data, "rotation", tuple[_Three, _Three, _Three])),
    "shape": lambda reader, data: _engine.Shape.of_data(data["shape"]),
    "camera": lambda reader, data: Camera.from_dict(data["camera"]),
    "array": _array,
    "dist": _distribution,
    "record": Reader.record,
    "target": lambda reader, data: reader.mesh(Target, data),
    "receiver": lambda reader, data: reader.mesh(Receiver, data),
    "host": Reader.host,
}


def model_data(model: Model[..., Any], write: Writer) -> dict[str, Any]:
    """Write the core form and the constants of a model."""
    core = model.core()
    return {
        "name": model.name,
        "core": core.text,
        "constants": write.each(core.constants),
        "classes": [record_class(kind) for kind in core.classes],
        "parameters": list(core.parameters),
        "required": core.required,
    }
