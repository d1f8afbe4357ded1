"""Pages of pictures: panels in a row, rows with titles, a scene with its target in grey."""

from niwaki import Target, _engine
from niwaki.draw.scene import Scene
from PIL import Image, ImageDraw, ImageFont

GREY = (0.72, 0.72, 0.71)


def together(scene: Scene, target: Target) -> Scene:
    """A scene with a target, in grey, as one more part."""
    return Scene(
        [*scene.parts, ("target", [_engine.shape("mesh", target.vertices, target.faces, color=GREY)])]
    )


def beside(images: list[Image.Image], gap: int = 4) -> Image.Image:
    """Paste pictures of one height in a row."""
    page = Image.new(
        "RGB", (sum(i.width + gap for i in images) - gap, max(i.height for i in images)), "white"
    )
    x = 0
    for image in images:
        page.paste(image, (x, 0))
        x += image.width + gap
    return page


def stacked(rows: list[tuple[str, Image.Image]]) -> Image.Image:
    """Paste rows below each other, each with its title above it."""
    font, strip = ImageFont.load_default(13), 22
    width, height = max(i.width for _, i in rows), sum(i.height + strip for _, i in rows)
    page = Image.new("RGB", (width, height), "white")
    pen, y = ImageDraw.Draw(page), 0
    for title, image in rows:
        pen.text((4, y + 0.5 * strip), title, (84, 82, 78), font, anchor="lm")
        page.paste(image, (0, y + strip))
        y += image.height + strip
    return page
