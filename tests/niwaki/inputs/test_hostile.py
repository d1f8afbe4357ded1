"""Claim: no file makes a reader wait, end the process, take all memory, or fail with a foreign error."""

from __future__ import annotations

import io
import json
import os
import socket
import struct
import time
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from niwaki.color import Drawing, Rules
from niwaki.color.styles import Styles
from niwaki.errors import FileError, InputError, NiwakiError
from niwaki.inputs import LIMITS, read_apart
from niwaki.inputs.limits import VARIABLE, Limit
from niwaki.letters.glyphs import Font
from niwaki.methods import Guide
from niwaki.targets import gltf, images, outline, reading
from niwaki.targets.camera import Camera
from niwaki.targets.outline import load_polygon
from niwaki.targets.target import Receiver, Target
from PIL import Image

READERS: dict[str, Callable[[Path], object]] = {
    ".obj": Target.load,
    ".stl": Receiver.load,
    ".glb": Target.load,
    ".png": images.ink,
    ".jpg": Drawing.load,
    ".svg": Drawing.load,
    ".toml": Rules.load,
    ".json": Camera.load,
    ".guide": Guide.load,
    ".ttf": Font,
    "-room.json": load_polygon,
}


def code_of(reads: Callable[[], object]) -> str:
    with pytest.raises(NiwakiError) as caught:
        reads()
    assert " = help: " in str(caught.value)
    return caught.value.code


def working(reads: Callable[[], object]) -> float:
    """Return the processor seconds that a refusal takes."""
    began = time.process_time()
    code_of(reads)
    return time.process_time() - began


# Files that are opened.


@pytest.mark.parametrize("suffix", READERS)
def test_only_regular_files_are_read(suffix: str, tmp_path: Path) -> None:
    place = tmp_path / f"input{suffix}"
    place.mkdir()
    assert code_of(lambda: READERS[suffix](place)) == "file-not-regular"
    place.rmdir()
    if hasattr(os, "mkfifo"):
        os.mkfifo(place)
        assert code_of(lambda: READERS[suffix](place)) == "file-not-regular"
        place.unlink()
    if Path("/dev/zero").exists():
        place.symlink_to("/dev/zero")
        assert code_of(lambda: READERS[suffix](place)) == "file-not-regular"
    assert code_of(lambda: READERS[suffix](tmp_path / f"\0{suffix}")) == "file-missing"
    assert code_of(lambda: READERS[suffix](tmp_path / ("a" * 5000 + suffix))) == "file-unreadable"
    assert code_of(lambda: READERS[suffix](tmp_path / f"none{suffix}")) == "file-missing"


def test_a_socket_is_not_a_file(tmp_path: Path) -> None:
    if not hasattr(socket, "AF_UNIX"):
        pytest.skip("no sockets in folders")
    with socket.socket(socket.AF_UNIX) as endpoint:
        endpoint.bind(str(tmp_path / "s.obj"))
        assert code_of(lambda: Target.load(tmp_path / "s.obj")) == "file-not-regular"


def test_a_file_larger_than_its_limit_is_refused_and_the_environment_raises_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = tmp_path / "rules.toml"
    place.write_text('background = "sky"\n#' + "x" * 1_500_000)
    with pytest.raises(FileError) as caught:
        Rules.load(place)
    assert caught.value.code == "file-limit" and VARIABLE in str(caught.value)
    monkeypatch.setenv(VARIABLE, "2")
    assert Rules.load(place).background == "sky"
    for wrong in ("0", "many", "nan", "1e9"):
        monkeypatch.setenv(VARIABLE, wrong)
        assert code_of(lambda: Rules.load(place)) == "bad-setting"


# Meshes.


def tree_of(count: int, length: int = 36, **more: object) -> dict[str, object]:
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [
            {"byteLength": length, "uri": "data:application/octet-stream;base64," + "A" * (length * 4 // 3)}
        ],
        "bufferViews": [{"buffer": 0, "byteLength": length}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"}],
        **more,
    }


def gltf_of(tree: object) -> Callable[[], object]:
    return lambda: reading.parsed(json.dumps(tree).encode(), ".gltf")


def test_counts_of_gltf_are_checked_against_the_bytes() -> None:
    assert code_of(gltf_of(tree_of(300_000_000))) == "file-unreadable"
    placeholder = {"componentType": 5126, "count": 300_000_000, "type": "VEC3"}
    assert code_of(gltf_of(tree_of(3, accessors=[placeholder]))) == "file-unreadable"
    for value in (-1, True, 1.5, 10**30, "3", None, [3]):
        assert code_of(gltf_of(tree_of(value))) == "file-unreadable"  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "more",
    [
        {"nodes": [{"children": [0]}]},
        {"nodes": [{"children": [1, 1]}, {"mesh": 0}]},
        {"nodes": [{"mesh": 7}]},
        {"nodes": [{"mesh": 0, "matrix": [1] * 15}]},
        {"nodes": {"mesh": 0}},
        {"scene": [0]},
        {"buffers": [{"uri": "../secret.bin"}]},
        {"buffers": [{"uri": "https://example.org/a.bin"}]},
        {"buffers": [{"uri": "%2e%2e/a.bin"}]},
        {"bufferViews": [{"buffer": 0, "byteOffset": 30, "byteLength": 36}]},
        {"bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 1}]},
        {"accessors": [{"bufferView": 0, "componentType": [5126], "count": 3, "type": "VEC3"}]},
        {"asset": []},
    ],
)
def test_invalid_gltf_is_refused(more: dict[str, object]) -> None:
    assert code_of(gltf_of(tree_of(3, **more))) == "file-unreadable"


def test_copies_of_a_mesh_by_many_nodes_are_bounded() -> None:
    nodes = [{"mesh": 0}] * 3000
    tree = tree_of(3000, 36_000, nodes=nodes, scenes=[{"nodes": list(range(3000))}])
    assert code_of(gltf_of(tree)) == "file-limit"
    few = tree_of(3, nodes=nodes, scenes=[{"nodes": list(range(3000))}])
    assert len(reading.parsed(json.dumps(few).encode(), ".gltf")[1]) == 3000


def test_gltf_is_read_as_trimesh_reads_it() -> None:
    scene = trimesh.Scene()
    for k in range(4):
        turn = trimesh.transformations.random_rotation_matrix(np.random.default_rng(k).random(3))
        turn[:3, 3] = (3.0 * k, 1.0, -2.0)
        if k == 3:
            turn[:3, 0] *= -1.0  # a mirror image
        scene.add_geometry(trimesh.creation.icosphere(1, radius=1.0 + k), transform=turn)
    expected = scene.to_mesh()
    target = Target(*reading.parsed(scene.export(file_type="glb"), ".glb"))
    assert target.open_edges == 0 and len(target.faces) == len(expected.faces)
    assert target.volume == pytest.approx(expected.volume, rel=1e-5) and target.volume > 0.0
    assert target.bounds == pytest.approx(expected.bounds, abs=1e-5)


def test_strips_and_fans_of_gltf_keep_their_sides() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 2, 0]], "<f4")
    areas = {}
    for mode in (gltf._STRIP, gltf._FAN):
        faces = gltf._triangles(np.arange(5), mode)
        a, b, c = (corners[faces[:, k]] for k in range(3))
        areas[mode] = np.cross(b - a, c - a)[:, 2]
    assert (areas[gltf._STRIP] > 0).all() and len(areas[gltf._FAN]) == 3


@pytest.mark.parametrize("count", [0, 1, 2**31, 2**32 - 1])
def test_a_wrong_count_of_an_stl_is_named(count: int) -> None:
    data = b"\0" * 80 + struct.pack("<I", count) + b"\0" * 125
    with pytest.raises(FileError, match=f"announces {count:,} triangles") as caught:
        reading.parsed(data, ".stl")
    assert caught.value.code == "file-unreadable"


@pytest.mark.parametrize("form", ["ascii 1.0", "binary_little_endian 1.0"])
@pytest.mark.parametrize("count", ["4000000000", "-1", "1e9", "9" * 5000])
def test_a_wrong_count_of_a_ply_is_refused(form: str, count: str) -> None:
    rows = "".join(f"property float {axis}\n" for axis in "xyz")
    head = f"ply\nformat {form}\nelement vertex {count}\n{rows}end_header\n"
    assert code_of(lambda: reading.parsed(head.encode() + b"\0" * 99, ".ply")) == "file-unreadable"


def test_the_time_of_a_mesh_grows_less_than_the_square_of_its_parts() -> None:
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n" * 3_000
    divided = corners + "".join(f"usemtl m{k}\nf {k + 1} {k + 2} {k + 3}\n" for k in range(8_000))
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    solids = f"solid a\n{facet}endsolid a\n" * 5_000
    for text, suffix, count in ((divided, ".obj", 8_000), (solids, ".stl", 5_000)):
        began = time.process_time()
        assert len(reading.parsed(text.encode(), suffix)[1]) == count
        assert time.process_time() - began < 3.0


def test_meshes_of_extreme_sizes_are_refused() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    for size in (1e300, 1e13, 1e-300, 1e-10):
        for kind in (Target, Receiver):
            with pytest.raises(FileError) as caught:
                kind(size * corners, faces)
            assert caught.value.code == "target-size" and "voxel" not in str(caught.value)
    assert Target(1e11 * corners, faces).volume > 0.0
    assert code_of(lambda: Target([[0, 0], [1, 2]], faces)) == "file-unreadable"


# Images.


def png_of(columns: int, rows: int) -> bytes:
    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    body = zlib.compress(b"\0" * 1_000_000)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


@pytest.mark.parametrize("reader", [images.ink, images.silhouette, Drawing.load])
@pytest.mark.parametrize("size", [(60_000, 60_000), (2**31 - 1, 1), (9_000, 9_000)])
def test_an_image_of_too_many_pixels_is_refused(
    reader: Callable[[Path], object], size: tuple[int, int], tmp_path: Path
) -> None:
    place = tmp_path / "bomb.png"
    place.write_bytes(png_of(*size))
    assert code_of(lambda: reader(place)) == "file-limit"


def test_a_webp_of_too_many_pixels_is_refused_before_it_is_opened(tmp_path: Path) -> None:
    file = io.BytesIO()
    Image.new("RGBA", (8, 8), (1, 2, 3, 4)).save(file, "WEBP", lossless=True)
    data = bytearray(file.getvalue())
    at = data.index(b"VP8L") + 9
    data[at : at + 4] = (0x3FFF | 0x3FFF << 14 | 1 << 28).to_bytes(4, "little")
    (tmp_path / "a.webp").write_bytes(data)
    assert code_of(lambda: images.ink(tmp_path / "a.webp")) == "file-limit"


def test_a_jpeg_of_many_scans_is_refused(tmp_path: Path) -> None:
    file = io.BytesIO()
    Image.new("RGB", (64, 64), (200, 100, 30)).save(file, "JPEG", progressive=True)
    data = file.getvalue()
    at = data.rindex(b"\xff\xda")
    (tmp_path / "a.jpg").write_bytes(data[:at] + data[at:-2] * 200 + data[-2:])
    assert code_of(lambda: images.ink(tmp_path / "a.jpg")) == "file-limit"


def test_formats_that_start_programs_are_not_opened(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(
        b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n%%EndComments\n(x) print\n"
    )
    with pytest.raises(FileError, match="none of PNG"):
        images.ink(tmp_path / "a.png")


def test_a_tiff_with_numbers_that_are_not_finite_is_refused(tmp_path: Path) -> None:
    Image.fromarray(np.full((9, 9), np.nan, np.float32)).save(tmp_path / "a.tif")
    assert code_of(lambda: images.ink(tmp_path / "a.tif")) == "file-unreadable"


# Drawings, rules, outlines, cameras.

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9">'
SHAPES = '<rect class="a" width="5" height="5"/><rect class="b" x="5" width="4" height="9"/>'


def drawn(folder: Path, body: str, head: str = HEAD) -> Drawing:
    (folder / "a.svg").write_text(f"{head}{body}{SHAPES}</svg>")
    return Drawing.load(folder / "a.svg", 32)


@pytest.mark.parametrize(
    "sheet", ["a" * 110_000, "/*" * 55_000, "@import x" * 12_000, ".a{" * 30_000, "}" * 110_000]
)
def test_the_time_of_a_style_sheet_grows_with_its_length(sheet: str) -> None:
    began = time.process_time()
    Styles.of([sheet])
    assert time.process_time() - began < 1.0


def test_braces_divide_a_style_sheet_into_blocks() -> None:
    sheet = (
        "/* .x{fill:red} */ @import 'a'; .a{fill:none} @media print { .b { stroke : red } } #c,.d{fill:blue;}"
    )
    rules = Styles.of([sheet]).rules
    assert [(set(rule.ids), set(rule.classes), rule.declared) for rule in rules] == [
        (set(), {"a"}, {"fill": "none"}),
        (set(), {"b"}, {"stroke": "red"}),
        (set(), {"d"}, {"fill": "blue"}),
        ({"c"}, set(), {"fill": "blue"}),
    ]


def test_many_selectors_for_many_shapes_are_bounded(tmp_path: Path) -> None:
    sheet = "<style>" + ".q{fill:red}" * 3_000 + "</style>"
    assert code_of(lambda: drawn(tmp_path, sheet + '<g class="q"/>' * 3_000)) == "file-limit"
    other = "<style>" + "".join(f".q{k}{{fill:red}}" for k in range(3_000)) + "</style>"
    assert drawn(tmp_path, other + '<g class="q"/>' * 3_000).names == ("a", "b")


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("<g>" * 100_000, "file-limit"),
        ("<defs>" + "<mask>" * 300 + "</mask>" * 300 + "</defs>", "file-limit"),
        ("<g/>" * 30_000, "file-limit"),
        (f'<defs><path id="p" d="{"M0 0" * 25_000}"/></defs>' + '<use href="#p"/>' * 1_000, "file-limit"),
        ("".join(f'<g xmlns:n{k}="urn:{k}"/>' for k in range(99)), "file-limit"),
        ('<image href="/etc/hostname.png" width="9" height="9"/>', "drawing-unclear"),
        ('<image xlink:href="a.png" width="9" height="9"/>', "drawing-unclear"),
    ],
)
def test_a_drawing_that_expands_or_links_elsewhere_is_refused(body: str, code: str, tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    assert working(lambda: drawn(tmp_path, body)) < 3.0
    assert code_of(lambda: drawn(tmp_path, body)) == code


def test_entities_are_bounded(tmp_path: Path) -> None:
    names = "".join(f'<!ENTITY e{k + 1} "{f"&e{k};" * 10}">' for k in range(9))
    head = f'<!DOCTYPE svg [<!ENTITY e0 "{"x" * 1000}">{names}]>{HEAD}'
    assert code_of(lambda: drawn(tmp_path, "<desc>&e9;</desc>", head)) in ("file-limit", "file-unreadable")
    flat = f'<!DOCTYPE svg [<!ENTITY e "{"x" * 50_000}">]>{HEAD}'
    assert code_of(lambda: drawn(tmp_path, "<desc>" + "&e;" * 5_000 + "</desc>", flat)) in (
        "file-limit",
        "file-unreadable",
    )


@pytest.mark.parametrize("box", ["0 0 1 1000000000", "0 0 1000000000 1", "0 0 1e30 1e-30"])
def test_a_drawing_of_any_shape_has_the_requested_pixels(box: str, tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    try:
        assert max(drawn(tmp_path, "", HEAD.replace("0 0 9 9", box)).labels.shape) <= 64
    except FileError as error:
        assert error.code == "file-unreadable"


def test_slow_drawings_of_resvg_end_within_the_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("resvg_py")
    monkeypatch.setitem(LIMITS, "seconds", Limit(2, "seconds", ""))
    chain = "".join(f'<g id="g{k}">' + f'<use href="#g{k + 1}"/>' * 2 + "</g>" for k in range(16))
    clip = f'<clipPath id="p">{chain}<rect id="g16" width="9" height="9"/></clipPath>'
    body = f'{clip}<g clip-path="url(#p)">{SHAPES}</g>'
    began = time.monotonic()
    try:
        drawn(tmp_path, body)
    except FileError as error:
        assert error.code in ("file-limit", "file-unreadable")
    assert time.monotonic() - began < 30.0


def test_the_size_of_a_picture_is_limited() -> None:
    pytest.importorskip("resvg_py")
    for size in (10**6, 0, -5, 10**30):
        assert code_of(lambda size=size: Drawing.load("robot", size)) == "bad-setting"


@pytest.mark.parametrize(
    "text",
    [
        "a" + ".a" * 50_000 + " = 1",
        "a = " + "[" * 100_000,
        "a = " + "{a=" * 5_000,
        "a = " + "9" * 5_000,
        "[" + "a." * 20_000 + "a]",
        ("a" + ".a" * 60 + " = 1\n") * 3,
    ],
)
def test_rules_that_are_deep_or_long_are_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(text)
    assert working(lambda: Rules.load(tmp_path / "a.toml")) < 1.0


def test_dots_in_strings_and_numbers_do_not_count_as_dots_of_a_key(tmp_path: Path) -> None:
    chain = ", ".join(f'"a.{k}.b"' for k in range(99))
    numbers = "\n".join(f"r{k} = {k}.5" for k in range(99))
    (tmp_path / "a.toml").write_text(f"lightness = [[{chain}]]\n[muted]\n{numbers}\n")
    assert len(Rules.load(tmp_path / "a.toml").lightness[0]) == 99


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        "[[0, 0], [1, 0], [1, " + "9" * 400 + "]]",
        "[[0, 0], [1, 0], [1, " + "9" * 5000 + "]]",
        "[[0, 0], [1, 0], [1, 1e200]]",
        "[[true, 0], [1, 0], [1, 1]]",
        json.dumps([[k, k * k] for k in range(10_001)]),
    ],
)
def test_points_that_are_deep_huge_or_many_are_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(text)
    assert working(lambda: load_polygon(tmp_path / "a.json")) < 1.0


def test_a_point_with_one_number_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text('<svg><polygon points="0,0 4,0 4,4 1"/></svg>')
    with pytest.raises(FileError, match="one number"):
        load_polygon(tmp_path / "a.svg")


def test_ten_thousand_corners_are_read_in_seconds(tmp_path: Path) -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 10_000, endpoint=False)
    radii = 1.0 + 0.2 * np.sin(400.0 * angles)
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    (tmp_path / "a.json").write_text(json.dumps(points.tolist()))
    began = time.process_time()
    assert len(load_polygon(tmp_path / "a.json")) == 10_000
    assert time.process_time() - began < 5.0


def test_crossings_agree_with_a_search_of_all_pairs() -> None:
    def crossing(corners: list[tuple[float, float]]) -> tuple[int, int] | None:
        count = len(corners)
        for i in range(count):
            for j in range(i + 2, count - (i == 0)):
                if crosses(corners[i], corners[(i + 1) % count], corners[j], corners[(j + 1) % count]):
                    return i, j
        return None

    def crosses(
        a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], d: tuple[float, float]
    ) -> bool:
        def side(p: tuple[float, float], q: tuple[float, float], r: tuple[float, float]) -> float:
            return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

        def between(p: tuple[float, float], q: tuple[float, float], r: tuple[float, float]) -> bool:
            return all(min(p[k], q[k]) <= r[k] <= max(p[k], q[k]) for k in (0, 1))

        abc, abd, cda, cdb = side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)
        if abc * abd < 0.0 and cda * cdb < 0.0:
            return True
        touching = ((abc, a, b, c), (abd, a, b, d), (cda, c, d, a), (cdb, c, d, b))
        return any(value == 0.0 and between(p, q, r) for value, p, q, r in touching)

    random = np.random.default_rng(5)
    seen = []
    for _ in range(2000):
        corners = random.integers(0, 6, (int(random.integers(3, 9)), 2)).astype(float)
        if (corners == np.roll(corners, 1, axis=0)).all(axis=1).any():
            continue
        expected = crossing([tuple(row) for row in corners.tolist()])
        assert outline._crossing(corners) == expected
        seen.append(expected is None)
    assert 20 < sum(seen) < len(seen) - 20


@pytest.mark.parametrize(
    "more",
    [
        {"kind": ["perspective"]},
        {"kind": {}},
        {"position": [10**400, 0, 0]},
        {"position": [1e300, 0, 0]},
        {"position": 7},
        {"look_at": "abc"},
        {"up": [[0], [1], [0]]},
        {"fov_degrees": 10**5000},
        {"near": None},
    ],
)
def test_invalid_cameras_are_refused(more: dict[str, object]) -> None:
    data = {"kind": "perspective", "position": [0, 0, 9], "look_at": [0, 0, 0], **more}
    assert code_of(lambda: Camera.from_dict(data)) == "bad-camera"


def test_a_camera_that_is_deep_or_of_huge_numbers_is_refused(tmp_path: Path) -> None:
    for text in (
        "[" * 100_000,
        '{"position": [' + "9" * 5000 + ', 0, 0], "look_at": [0, 0, 0]}',
        "\0",
        '"\\ud800"',
    ):
        (tmp_path / "a.json").write_text(text)
        assert code_of(lambda: Camera.load(tmp_path / "a.json")) in ("file-unreadable", "bad-camera")


# The process of its own.

CHILD = """
import os, time
import numpy as np
from niwaki.errors import FileError, InputError

def good(data, times): print("noise"); return {"bytes": np.frombuffer(data, np.uint8) * times, "none": np.empty((0, 3))}
def refused(data): raise FileError("target-empty", None, reason="nothing")
def setting(data): raise InputError("bad-image", found="nothing")
def endless(data):
    while True: pass
def asleep(data): time.sleep(60)
def greedy(data): return {"bytes": np.ones(1 << 34, np.uint8)}
def fallen(data): os.abort()
def wrong(data): return {}["key"]
def objects(data): return {"things": np.array([object()])}
def writing(data): open("written", "w").write("x" * 9)
"""


@pytest.fixture
def readers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> object:
    (tmp_path / "own_readers.py").write_text(CHILD)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(LIMITS, "seconds", Limit(1, "seconds", ""))
    import importlib
    import sys

    yield importlib.import_module("own_readers")
    sys.modules.pop("own_readers")


def test_a_child_sends_arrays(readers: object) -> None:
    arrays = read_apart(readers.good, b"\1\2\3\n", "a", ".obj", times=2)  # type: ignore[attr-defined]
    assert arrays["bytes"].tolist() == [2, 4, 6, 20] and arrays["none"].shape == (0, 3)


@pytest.mark.parametrize(
    ("name", "code", "reason"),
    [
        ("refused", "target-empty", "nothing"),
        ("setting", "bad-image", "nothing"),
        ("endless", "file-limit", "more than 1 seconds"),
        ("greedy", "file-limit", "memory"),
        ("fallen", "file-unreadable", "ended with code"),
    ],
)
def test_a_child_that_fails_gives_an_error(readers: object, name: str, code: str, reason: str) -> None:
    with pytest.raises((FileError, InputError), match=reason) as caught:
        read_apart(getattr(readers, name), b"", "mesh.obj", ".obj")
    assert caught.value.code == code


def test_a_child_that_waits_is_ended(readers: object) -> None:
    began = time.monotonic()
    with pytest.raises(FileError, match="more than 1 seconds"):
        read_apart(readers.asleep, b"", "mesh.obj", ".obj")  # type: ignore[attr-defined]
    assert time.monotonic() - began < 30.0


@pytest.mark.parametrize("name", ["wrong", "objects", "writing"])
def test_a_mistake_of_a_reader_is_not_a_bad_file(readers: object, name: str, tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match="a reader of Niwaki failed"):
        read_apart(getattr(readers, name), b"", "mesh.obj", ".obj")
    assert not (tmp_path / "written").exists() or (tmp_path / "written").stat().st_size == 0


def test_a_child_reads_a_large_text_as_this_process_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data = trimesh.creation.icosphere(3).export(file_type="ply", encoding="ascii")
    here = reading.parsed(data, ".ply")
    monkeypatch.setitem(LIMITS, "apart", Limit(1, "bytes", ""))
    there = reading.parsed(data, ".ply")
    assert all(np.array_equal(a, b) and a.dtype == b.dtype for a, b in zip(here, there, strict=True))
    (tmp_path / "a.obj").write_text("v 0 0\nf 1 2 3\n")
    with pytest.raises(FileError) as caught:
        Target.load(tmp_path / "a.obj")
    assert caught.value.place == tmp_path / "a.obj"
