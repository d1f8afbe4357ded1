"""The files of this folder: one letter, twice (white on black, and black on white), in every form that people have.

`python tests/corpus/images/make.py` writes them. The letter has no symmetry, so that each way to turn it is seen. The
right answer is `letter.txt`, for every file.

light-*   the letter is white, or opaque where there is transparency: for silhouettes
dark-*    the letter is black: for drawings
"""

from __future__ import annotations

import io
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageCms
from PIL.PngImagePlugin import PngInfo

HERE = Path(__file__).parent
LETTER = np.array(
    [[sign == "#" for sign in line] for line in (HERE / "letter.txt").read_text().splitlines()], dtype=bool
)
#: What the pixels are before the program that shows them turns them (EXIF, Orientation).
TURNED = {
    1: None,
    2: Image.Transpose.FLIP_LEFT_RIGHT,
    3: Image.Transpose.ROTATE_180,
    4: Image.Transpose.FLIP_TOP_BOTTOM,
    5: Image.Transpose.TRANSPOSE,
    6: Image.Transpose.ROTATE_90,
    7: Image.Transpose.TRANSVERSE,
    8: Image.Transpose.ROTATE_270,
}


def main() -> None:
    """Write every file."""
    for tone, grey in (("light", np.where(LETTER, 255, 0)), ("dark", np.where(LETTER, 0, 255))):
        for name, data in files(grey.astype(np.uint8), tone == "dark").items():
            (HERE / f"{tone}-{name}").write_bytes(data)


def files(grey: Any, is_dark: bool) -> dict[str, bytes]:
    """The files of one tone, by name."""
    page = Image.fromarray(grey)
    deep = Image.fromarray(grey.astype(np.uint16) * 257)
    rgb, other = page.convert("RGB"), Image.fromarray(255 - grey)
    contents = {
        f"{mode.lower()}.png": written(page.convert(mode), "PNG") for mode in ("1", "L", "P", "RGB", "LA")
    }
    contents |= {
        "16-bit.png": written(deep, "PNG"),
        "16-bit.tif": written(deep, "TIFF"),
        "16-bit-white-is-0.tif": written(
            Image.fromarray(65535 - np.asarray(deep)), "TIFF", tiffinfo={262: 0}
        ),
        "real.tif": written(Image.fromarray(grey.astype(np.float32) / 255), "TIFF"),
        "lzw.tif": written(rgb, "TIFF", compression="tiff_lzw"),
        "jpeg.tif": written(rgb, "TIFF", compression="jpeg"),
        "lab.tif": written(lab(rgb), "TIFF"),
        "1.bmp": written(page.convert("1"), "BMP"),
        "rgb.bmp": written(rgb, "BMP"),
        "l.gif": written(page, "GIF"),
        "moving.gif": written(page, "GIF", save_all=True, append_images=[other]),
        "moving.webp": written(rgb, "WEBP", save_all=True, append_images=[other], lossless=True),
        "moving.png": written(page, "PNG", save_all=True, append_images=[other]),
        "pages.tif": written(page, "TIFF", save_all=True, append_images=[other]),
        "cmyk.jpg": written(page.convert("CMYK"), "JPEG", quality=60),
        "progressive.jpg": written(rgb, "JPEG", quality=60, progressive=True),
        "profile.jpg": written(rgb, "JPEG", quality=60, icc_profile=profile()),
        "quality-10.jpg": written(rgb, "JPEG", quality=10),
        "quality-75.jpg": written(page, "JPEG", quality=75),
        "quality-10.webp": written(rgb, "WEBP", quality=10),
        "broken-exif.png": written(page, "PNG", exif=b"Exif\0\0garbage"),
        "xmp-6.png": written(turned(page, 6), "PNG", pnginfo=xmp(6)),
    }
    contents |= {f"exif-{k}.jpg": written(turned(rgb, k), "JPEG", exif=exif(k), quality=75) for k in TURNED}
    for form, settings in (("png", {}), ("webp", {"lossless": True}), ("tif", {})):
        for k in (3, 6, 7):
            kind = {"png": "PNG", "webp": "WEBP", "tif": "TIFF"}[form]
            contents[f"exif-{k}.{form}"] = written(turned(rgb, k), kind, exif=exif(k), **settings)
    clear = np.zeros((*grey.shape, 4), np.uint8)
    clear[LETTER] = (0, 0, 0, 255) if is_dark else (255, 255, 255, 255)
    see = Image.fromarray(clear)
    contents |= {
        "clear.png": written(see, "PNG"),
        "clear.gif": written(see, "GIF"),
        "clear.webp": written(see, "WEBP", quality=60),
        "clear-multiplied.tif": multiplied(clear),
        "clear-p.png": written(see.quantize(4), "PNG"),
        # One grey of the picture is transparent.
        "clear-l.png": written(
            Image.fromarray(np.where(LETTER, grey, 77).astype(np.uint8)), "PNG", transparency=77
        ),
        "clear-16-bit.png": written(deep_on(grey, 40000), "PNG", transparency=40000),
    }
    return contents


def written(image: Image.Image, kind: str, **settings: Any) -> bytes:
    """The bytes of a file."""
    out = io.BytesIO()
    image.save(out, kind, **settings)
    return out.getvalue()


def turned(image: Image.Image, orientation: int) -> Image.Image:
    """The pixels as a camera stores them that was held in another way."""
    method = TURNED[orientation]
    return image if method is None else image.transpose(method)


def exif(orientation: int) -> Image.Exif:
    """Tags that a camera writes."""
    tags = Image.Exif()
    tags[0x112] = orientation
    return tags


def xmp(orientation: int) -> PngInfo:
    """Return an orientation as Adobe's programs write it."""
    info = PngInfo()
    info.add_itxt(
        "XML:com.adobe.xmp",
        '<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">'
        '<rdf:Description xmlns:tiff="http://ns.adobe.com/tiff/1.0/" '
        f'tiff:Orientation="{orientation}"/></rdf:RDF></x:xmpmeta>',
    )
    return info


def profile() -> bytes:
    """A profile of colours."""
    return ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()


def lab(image: Image.Image) -> Image.Image:
    """An image in CIELAB."""
    spaces = ImageCms.createProfile("sRGB"), ImageCms.createProfile("LAB")
    converted = ImageCms.profileToProfile(image, *spaces, outputMode="LAB")
    assert converted is not None
    return converted


def deep_on(grey: Any, paper: int) -> Image.Image:
    """Sixteen bits, with one value around the letter."""
    return Image.fromarray(np.where(LETTER, grey.astype(np.uint16) * 257, np.uint16(paper)))


def multiplied(clear: Any) -> bytes:
    """A TIFF whose colours are multiplied by their alpha (ExtraSamples 1), written by hand: Pillow writes none."""
    rows, columns, _ = clear.shape
    data = zlib.compress((clear * (clear[:, :, 3:] / 255.0)).astype(np.uint8).tobytes())
    entries = [(256, 3, 1, columns), (257, 3, 1, rows), (258, 3, 4, 0), (259, 3, 1, 8), (262, 3, 1, 2)]
    entries += [(273, 4, 1, 0), (277, 3, 1, 4), (278, 3, 1, rows), (279, 4, 1, len(data)), (338, 3, 1, 1)]
    after = 8 + 2 + 12 * len(entries) + 4
    values = {258: after, 273: after + 8}
    out = struct.pack("<2sHIH", b"II", 42, 8, len(entries))
    for tag, kind, count, value in entries:
        out += struct.pack("<HHII", tag, kind, count, values.get(tag, value))
    return out + struct.pack("<I4H", 0, 8, 8, 8, 8) + data


if __name__ == "__main__":
    main()
