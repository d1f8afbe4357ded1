"""Build the Blender extension: a zip with its sources and the wheels that it needs.

    python integrations/blender/build_extension.py --wheel dist/niwaki-0.1.0-cp311-abi3-linux_x86_64.whl --out dist

The wheels are those of requirements/core.txt, at its versions and hashes, without NumPy, which Blender has. Blender
before 5.1 has Python 3.11, later versions have 3.13. A zip is for one Python and one platform.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCES = HERE / "niwaki_blender"
LOCK = HERE.parent.parent / "requirements" / "core.txt"

#: Packages that the worker imports, except NumPy.
NEEDED = ("lazy-loader", "mapbox-earcut", "msgspec", "packaging", "pillow", "trimesh", "typing-extensions")
#: The first version of Blender with each Python, and the first version with another Python.
BLENDERS = {"3.11": ("4.2.0", "5.1.0"), "3.13": ("5.1.0", None)}
#: Blender's names of platforms, with the tags of their wheels.
PLATFORMS = {
    "linux-x64": ("manylinux_2_28_x86_64", "manylinux_2_17_x86_64", "manylinux2014_x86_64"),
    "macos-arm64": ("macosx_11_0_arm64", "macosx_10_13_universal2"),
    "windows-x64": ("win_amd64",),
}


def requirements(lock: str) -> str:
    """Select the needed entries of a lock file, with their hashes."""
    entries = re.split(r"\n(?=\S)", lock)
    return "\n".join(entry for entry in entries if re.split(r"[=\s]", entry)[0] in NEEDED)


def fetch(folder: Path, python: str, platform: str) -> None:
    """Download the wheels that the extension needs."""
    with tempfile.TemporaryDirectory() as temporary:
        listed = Path(temporary) / "needed.txt"
        listed.write_text(requirements(LOCK.read_text()))
        command = [
            sys.executable,
            "-m",
            "pip",
            "--disable-pip-version-check",
            "--quiet",
            "download",
            "--no-deps",
        ]
        command += [
            "--require-hashes",
            "--only-binary",
            ":all:",
            "--python-version",
            python,
            "-d",
            str(folder),
        ]
        for tag in PLATFORMS[platform]:
            command += ["--platform", tag]
        subprocess.run([*command, "-r", str(listed)], check=True)


def manifest(version: str, python: str, platform: str, wheels: list[str]) -> str:
    """Write the manifest of a zip."""
    text = (SOURCES / "blender_manifest.toml").read_text()
    first, last = BLENDERS[python]
    text = re.sub(r'^version = ".*"$', f'version = "{version}"', text, flags=re.M)
    ends = "" if last is None else f'\nblender_version_max = "{last}"'
    text = re.sub(r'^blender_version_min = ".*"$', f'blender_version_min = "{first}"{ends}', text, flags=re.M)
    listed = "".join(f'  "./wheels/{wheel}",\n' for wheel in wheels)
    head, mark, tables = text.partition("\n[permissions]")
    text = f'{head}platforms = ["{platform}"]\nwheels = [\n{listed}]\n{mark}{tables}'
    tomllib.loads(text)
    return text


def build(wheel: Path, out: Path, python: str, platform: str) -> Path:
    """Build a zip; equal sources and wheels give equal bytes."""
    version = wheel.name.split("-")[1]
    first = BLENDERS[python][0].rpartition(".")[0]
    with tempfile.TemporaryDirectory() as temporary:
        fetch(Path(temporary), python, platform)
        wheels = {path.name: path.read_bytes() for path in [wheel, *Path(temporary).glob("*.whl")]}
    files = {f"wheels/{name}": data for name, data in wheels.items()}
    files |= {path.name: path.read_bytes() for path in SOURCES.glob("*.py")}
    files["blender_manifest.toml"] = manifest(version, python, platform, sorted(wheels)).encode()
    out.mkdir(parents=True, exist_ok=True)
    place = out / f"niwaki-{version}-blender{first}-{platform}.zip"
    with zipfile.ZipFile(place, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(".whl") else zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[name])
    return place


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Build the extension for Blender.")
    parser.add_argument("--wheel", type=Path, required=True, help="the wheel of Niwaki")
    parser.add_argument("--out", type=Path, default=Path("dist"), help="the folder of the zip")
    parser.add_argument(
        "--python",
        choices=BLENDERS,
        default="3.11",
        help="Blender's Python: 3.11, or 3.13 from Blender 5.1 on",
    )
    parser.add_argument("--platform", choices=PLATFORMS, default="linux-x64")
    arguments = parser.parse_args()
    print(build(arguments.wheel, arguments.out, arguments.python, arguments.platform))
