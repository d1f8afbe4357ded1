"""Claim: reading any bytes takes at most 5 seconds and 1 GB, and ends with a result or an error of the package.

Real files of each format are damaged: bits, bytes and numbers are changed, pieces are cut, doubled and moved, tokens
of texts are exchanged for extremes or nested. An input is known by its kind and its number, so that it can be made
again.
"""

from __future__ import annotations

import io
import json
import os
import random
import re
import struct
import sys
import time
import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path

import niwaki
import numpy as np
import pytest
import trimesh
from mesh_corpus import CASES
from niwaki.color import Drawing, Rules
from niwaki.errors import NiwakiError
from niwaki.letters import glyphs
from niwaki.methods import Guide
from niwaki.targets import images, outline, reading
from niwaki.targets.camera import Camera
from niwaki.targets.target import Target
from PIL import Image

SECONDS, MEMORY = 5.0, 1_000_000_000
WORDS = [
    *(b"-1 0 1 4294967295 2147483648 -2147483649 18446744073709551616 1e308 1e-320 1e999 nan inf -0").split(),
    *(b"null [] {} # . / url(#a) ../../x data:,").split(),
    *(b"9" * 5000, b"", b'""', b"\0", b"\xff\xfe", b"\n"),
    *(b"[" * 3000, b"{" * 2000, b"a." * 300, b"<g>" * 500, b'{"a":' * 2000),
]
NUMBERS = [0, 1, 2, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x10000000, 0x01000000]

SVG = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 60 60">
<style>.a, path.b { fill: red } #c { stroke: blue } @media print { .d { fill: none } } /* note */</style>
<defs><g id="s"><rect width="9" height="9"/></g><linearGradient id="l"><stop offset="0"/></linearGradient></defs>
<rect class="a" width="50" height="40" fill="url(#l)"/>
<path class="b" d="M0 0L30 30 10 50z" style="stroke:#123;opacity:.5"/>
<g id="c" transform="rotate(10)"><circle cx="30" cy="30" r="9"/><use xlink:href="#s" x="5"/></g></svg>"""
HEAVY = SVG.replace("<defs>", '<defs><filter id="f"><feGaussianBlur stdDeviation="3"/></filter>').replace(
    'class="a"', 'class="a" filter="url(#f)" stroke="red" stroke-dasharray="3 2"'
)
RULES = """background = "sky"
lightness = [["wall", "shade", "ink"], ["roof", "ink"]]
same-hue = [["roof", "door"]]
[muted]
all = 60
sky = 30.5
[pinned]
ink = "#1a1a2e"
"""
CAMERA = json.dumps({"kind": "perspective", "position": [31, 2, 33], "look_at": [-3, 5, 0], "up": [0, 1, 0]})
ROOM = '<svg><g><path d="M0 0H4V-2L2-2v-2h-2z"/></g><polygon points="0,0 4,0 4,-2 2,-2"/></svg>'


def exported(kind: str, **settings: object) -> bytes:
    scene = trimesh.Scene()
    for at in (0.0, 3.0):
        box = trimesh.creation.box((1.0, 2.0, 3.0))
        scene.add_geometry(box, transform=trimesh.transformations.translation_matrix((at, 0.0, 0.0)))
    whole = scene if kind in ("glb", "gltf") else scene.to_mesh()
    data = whole.export(file_type=kind, **settings)
    return data.encode() if isinstance(data, str) else data


def embedded() -> bytes:
    """Return a .gltf file with embedded buffers."""
    import base64

    files = trimesh.Scene(trimesh.creation.box((1.0, 2.0, 3.0))).export(file_type="gltf")
    tree = json.loads(files["model.gltf"])
    for buffer in tree["buffers"]:
        buffer["uri"] = (
            "data:application/octet-stream;base64," + base64.b64encode(files[buffer["uri"]]).decode()
        )
    return json.dumps(tree).encode()


def picture(kind: str, mode: str = "RGB", **settings: object) -> bytes:
    page = np.zeros((24, 32, 3), np.uint8)
    page[5:15, 7:20] = (200, 30, 30)
    image = Image.fromarray(page).convert(mode)
    file = io.BytesIO()
    image.save(file, kind, **settings)
    return file.getvalue()


def mesh(suffix: str) -> Callable[[Path, bytes], object]:
    return lambda _, data: Target(*reading.parsed(data, suffix))


def image_of(place: Path, data: bytes) -> None:
    place.write_bytes(data)
    for reader in (images.ink, images.silhouette, Drawing.load):
        try:
            reader(place)
        except NiwakiError as error:
            if error.code == "file-unreadable":
                raise


def svg_of(place: Path, data: bytes) -> None:
    place.write_bytes(data)
    Drawing.load(place, 48).picture({"a": "#102030"}, 48)


def rules_of(place: Path, data: bytes) -> None:
    place.write_bytes(data)
    Rules.load(place).check(("sky", "wall", "shade", "ink", "roof", "door"))


def font_of(place: Path, data: bytes) -> None:
    place.write_bytes(data)
    font = glyphs.Font(place)
    font.pieces("i")
    font.along("ab")


def saved(reader: Callable[[Path], object]) -> Callable[[Path, bytes], object]:
    def read(place: Path, data: bytes) -> None:
        place.write_bytes(data)
        reader(place)

    return read


@cache
def seeds() -> dict[str, tuple[bytes, str, Callable[[Path, bytes], object]]]:
    """By kind: a real file, its suffix, and what reads it."""
    glb = exported("glb")
    trap = {case.name: case.data for case in CASES}
    return {
        "stl": (exported("stl"), ".stl", mesh(".stl")),
        "stl-text": (exported("stl_ascii"), ".stl", mesh(".stl")),
        "stl-quads": (trap["stl: facets of four corners"], ".stl", mesh(".stl")),
        "obj": (b"mtllib a.mtl\no one\nusemtl red\nvt 0 0\n" + exported("obj"), ".obj", mesh(".obj")),
        "obj-concave": (trap["obj: a U"] + trap["obj: a frame"], ".obj", mesh(".obj")),
        "ply": (exported("ply"), ".ply", mesh(".ply")),
        "ply-text": (exported("ply", encoding="ascii"), ".ply", mesh(".ply")),
        "ply-lists": (
            trap["ply: binary_big_endian, doubles and numbers around lists"],
            ".ply",
            mesh(".ply"),
        ),
        "ply-strips": (trap["ply: strips"], ".ply", mesh(".ply")),
        "glb": (glb, ".glb", mesh(".glb")),
        "glb-instances": (trap["gltf: turned instances"], ".glb", mesh(".glb")),
        "glb-sparse": (trap["gltf: sparse"], ".glb", mesh(".glb")),
        "glb-bones": (trap["gltf: bones"], ".glb", mesh(".glb")),
        "gltf": (embedded(), ".gltf", mesh(".gltf")),
        "png": (picture("PNG", "RGBA"), ".png", image_of),
        "png-palette": (picture("PNG", "P", transparency=0), ".png", image_of),
        "png-16": (picture("PNG", "I;16"), ".png", image_of),
        "jpeg": (picture("JPEG"), ".jpg", image_of),
        "jpeg-scans": (picture("JPEG", progressive=True), ".jpg", image_of),
        "webp": (picture("WEBP"), ".webp", image_of),
        "webp-lossless": (picture("WEBP", "RGBA", lossless=True), ".webp", image_of),
        "gif": (picture("GIF", save_all=True, append_images=[Image.new("RGB", (9, 9))]), ".gif", image_of),
        "bmp": (picture("BMP"), ".bmp", image_of),
        "tiff": (picture("TIFF", compression="tiff_lzw"), ".tif", image_of),
        "svg": (SVG.encode(), ".svg", svg_of),
        "svg-heavy": (HEAVY.encode(), ".svg", svg_of),
        "rules": (RULES.encode(), ".toml", rules_of),
        "camera": (CAMERA.encode(), ".json", saved(Camera.load)),
        "room-svg": (ROOM.encode(), ".svg", saved(outline.load_polygon)),
        "room-json": (
            b'{"polygon": [[0, 4], [2, 4], [2.5, 2e0], [4, 0]]}',
            ".json",
            saved(outline.load_polygon),
        ),
        "guide": (
            (Path(niwaki.__file__).parent / "guides/shipped/lightning.guide").read_bytes(),
            ".guide",
            lambda _, data: Guide(data),
        ),
        "font": (glyphs.FONT.read_bytes(), ".ttf", font_of),
    }


KINDS = (
    "stl stl-text stl-quads obj obj-concave ply ply-text ply-lists ply-strips glb glb-instances glb-sparse glb-bones "
    "gltf png png-palette png-16 jpeg jpeg-scans webp webp-lossless gif bmp tiff svg svg-heavy rules camera room-svg "
    "room-json guide font"
).split()
#: Kinds whose inputs start a process, and a slow kind; a short run tries few of them.
APART = ("tiff", "svg-heavy", "font")


def damaged(data: bytes, random: random.Random) -> bytes:
    """Return a file with one to six mistakes."""
    content = bytearray(data)
    for _ in range(random.choice((1, 1, 1, 2, 3, 6))):
        at = random.randrange(len(content) + 1)
        match random.randrange(9):
            case 0 if content:
                content[at % len(content)] ^= 1 << random.randrange(8)
            case 1:
                content = content[:at]
            case 2:
                del content[at : at + random.choice((1, 4, 40, 400))]
            case 3:
                piece = content[at : at + random.choice((1, 4, 40, 400))] * random.choice((1, 2, 50))
                to = random.randrange(len(content) + 1)
                content[to:to] = piece
            case 4:
                number = random.choice(NUMBERS)
                size, order = random.choice((1, 2, 4, 8)), random.choice(("little", "big"))
                place = at - at % 4 if random.random() < 0.7 else at
                content[place : place + size] = (number & (1 << 8 * size) - 1).to_bytes(size, order)
            case 5:
                content[at : at + 4] = struct.pack(
                    "<f", random.choice((1e38, -1e38, float("nan"), float("inf"), 1e-40))
                )
            case 6 | 7:
                tokens = list(re.finditer(rb"-?[0-9.]+(?:e-?[0-9]+)?|\w+|[^\w\s]", bytes(content[:100_000])))
                if tokens:
                    token = random.choice(tokens)
                    content[token.start() : token.end()] = random.choice((*WORDS, random.choice(tokens)[0]))
            case _:
                content[at:at] = random.choice(WORDS)
    return bytes(content)


def attempt(kind: str, number: int, folder: Path) -> str:
    """Read an input; return the error's code, or an empty text."""
    data, suffix, read = seeds()[kind]
    mutated = damaged(data, random.Random(f"{kind} {number}"))
    began, before = spent(), peak()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            read(folder / f"input{suffix}", mutated)
        code = ""
    except NiwakiError as error:
        assert str(error).startswith("error["), (kind, number)
        code = error.code
    except BaseException as error:
        raise AssertionError(f"input {number} of {kind}: {error!r:.300}") from error
    took, grew = spent() - began, peak() - before
    assert took < SECONDS, f"input {number} of {kind} took {took:.1f} s"
    assert grew < MEMORY, f"input {number} of {kind} took {grew / 1e6:.0f} MB"
    return code


def spent() -> float:
    """Return the processor seconds of this process and its children."""
    return sum(os.times()[:4])


def peak() -> int:
    """Return the most memory that this process and its children have had, in bytes."""
    try:
        import resource
    except ImportError:
        return 0
    unit = 1 if sys.platform == "darwin" else 1024
    return unit * max(
        resource.getrusage(scope).ru_maxrss for scope in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )


@pytest.mark.parametrize("kind", KINDS)
def test_a_damaged_file_is_read_or_refused(kind: str, tmp_path: Path) -> None:
    assert list(seeds()) == KINDS
    data, suffix, read = seeds()[kind]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        read(tmp_path / f"whole{suffix}", data)
    codes = [attempt(kind, number, tmp_path) for number in range(3 if kind in APART else 20)]
    assert kind in APART or any(codes)


@pytest.mark.soak
def test_many_damaged_files_are_read_or_refused(tmp_path: Path) -> None:
    first = random.SystemRandom().randrange(1 << 40)
    print(f"from input {first}")
    until, number = time.monotonic() + 60.0, first
    while time.monotonic() < until:
        for kind in KINDS:
            if kind not in APART or number % 20 == 0:
                attempt(kind, number, tmp_path)
        number += 1


if __name__ == "__main__":
    # python test_mutations.py SECONDS [KIND ...]: all failures of a long run, each on a line.
    import tempfile

    until, number, failures, tried = (
        time.process_time() + float(sys.argv[1]),
        int(os.environ.get("FIRST", 0)),
        0,
        0,
    )
    kinds = sys.argv[2:] or KINDS
    with tempfile.TemporaryDirectory() as folder:
        while time.process_time() < until:
            for kind in kinds:
                if kind not in APART or number % 20 == 0 or kinds == [kind]:
                    tried += 1
                    try:
                        attempt(kind, number, Path(folder))
                    except AssertionError as error:
                        failures += 1
                        print(error, flush=True)
            number += 1
    print(f"{tried} inputs, {failures} failures, {peak() / 1e6:.0f} MB, next {number}")
