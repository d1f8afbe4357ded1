"""Errors about images to match, cameras, lights, receivers and obstacles."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

VIEWS = (
    Message(
        "bad-camera",
        "this camera cannot see a scene",
        why="{reason}",
        help="give the camera's position, look_at, lens, and an up that is not parallel to the view",
        example="Camera.perspective((0, 2, 20), look_at=(0, 2, 20))",
        cure="Camera.perspective((0, 2, 20), look_at=(0, 2, 0), fov_degrees=45)",
    ),
    Message(
        "behind-camera",
        "the target `{name}` is behind the camera",
        why="the camera at {position} looks at {look_at}, away from the target",
        help="turn the camera, or exchange its position and look_at",
        example="match_volume(ship) * match_image(front, a camera that looks away from the ship)",
        cure="match_volume(ship) * match_image(front, a camera that looks at the ship)",
    ),
    Message(
        "receiver-unseen",
        "the receiver `{receiver}` is outside of the camera's view",
        why="{reason}, so no pixel can be in shadow",
        help="point the camera at the receiver, or leave the camera out to see the receiver along the light",
        example="match_shadow(face, (0, -1, 0), floor, a camera that looks at the sky)",
        cure="match_shadow(face, (0, -1, 0), floor)",
    ),
    Message(
        "light-grazes",
        "the light is parallel to the receiver `{receiver}`",
        why="{reason}, so no shape can cast a shadow on it",
        help="tilt the light towards the receiver: for a floor, (-1, -0.3, 0) is light from a low sun",
        example="match_shadow(face, (-1, 0, 0), floor)",
        cure="match_shadow(face, (-1, -0.3, 0), floor)",
    ),
    Message(
        "bad-image",
        "this is not an image to match",
        why="found {found}",
        help="give a file, a Pillow image, or an array of rows and columns: truth values, or greys from 0 to 255",
        example="match_image(np.zeros(7), camera)",
        cure='match_image("skyline.png", camera)',
    ),
    Message(
        "image-one-color",
        "`{name}` has only one colour",
        why="all {size} pixels are {state}: a pixel is on if its red is at least half of the brightest red",
        help="draw the shape in white on black; invert an image that is black on white",
        example="a white page with a black skyline that was scanned as grey",
        cure="a black page with a white skyline",
    ),
    Message(
        "drawing-one-color",
        "the drawing `{name}` has only one colour",
        why="all {size} pixels are {state}: a drawing is dark ink on white or transparent paper",
        help="draw in black on white; invert an image that is white on black",
        example="a white letter on a black page",
        cure="a black letter on a white page",
    ),
    Message(
        "unknown-drawing",
        "there is no drawing `{name}`",
        why="`niwaki.targets.drawings.names()` lists the drawings of the package",
        help="did you mean `{near}`?",
        example='targets.drawings.drawing("letters/e")',
        cure='targets.drawings.drawing("letters/E")',
    ),
    Message(
        "weight-size",
        "the weight image `{name}` must have the size of its image",
        why="the weight image is {found}, the image {expected}",
        help="scale the weight image to {expected}",
        example="a weight image of 200 x 200 for an image of 250 x 250",
        cure="both of 250 x 250",
    ),
    Message(
        "obstacle-at-start",
        "the obstacle covers the place where the model starts",
        why="at the first barrier all {count} particles were inside the obstacle",
        help="move the obstacle or the model's first shape, or use smaller cells (`voxel`), which keep a smaller distance",
        example="avoid(a ball around the root) of a tree",
        cure="avoid(a ball beside the root)",
    ),
    Message(
        "mesh-too-large",
        "the mesh `{name}` is too large for this machine's memory",
        why="its {what} need about {needed}, and {free} are free",
        help="simplify the mesh: a target of a hundred thousand triangles gives the same scores as one of ten million",
        example="a scan of a hundred million triangles",
        cure="the same scan, reduced to a hundred thousand triangles",
    ),
)
