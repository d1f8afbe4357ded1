"""Shapes, the things that `emit` adds to a scene. Right-handed, y up, metres by default.

A point is a 3-tuple, a list or a `vec`. Flat shapes lie on a plane parallel to z = 0, and are seen from +z. A colour
is `(r, g, b)` in [0, 1] or a name. A rotation is three rows of three numbers, as `rotation(axis, angle)` gives. In a
plain-Python run a shape is the engine's own `Shape`.

Written by tests/house/words.py from the engine's table of solids.
"""

from __future__ import annotations

from typing import Any

from niwaki.words.measures import Axis, Bark, Color, Frame, Pairs, Points, Rotation, make
from niwaki.words.vectors import VecLike

__all__ = [
    "arch",
    "box",
    "cone",
    "cylinder",
    "disc",
    "ellipse",
    "ellipsoid",
    "extrude",
    "hull",
    "limb",
    "mesh",
    "revolve",
    "segment",
    "sphere",
    "stroke",
    "sweep",
    "torus",
    "wedge",
]


def box(
    center: VecLike,
    size: VecLike,
    rotation: Rotation | None = None,
    taper: float = 1.0,
    taper_axis: str = "z",
    bevel: float | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A box.

    Parameters
    ----------
    center
        Its middle.
    size
        Its three side lengths, greater than 0.
    rotation
        Turns it about its middle.
    taper
        How much the end towards `taper_axis` is scaled; 1 for a plain box.
    taper_axis
        "x", "y" or "z".
    bevel
        Rounding of the edges, drawn only: a share of half the smallest side, 0 for sharp edges.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make(
        "box", center, size, rotation, taper, taper_axis, bevel, color, metalness, roughness, material
    )


def cylinder(
    center: VecLike,
    radius: float,
    length: float,
    axis: Axis = "y",
    top_radius: float | None = None,
    rotation: Rotation | None = None,
    bevel: float | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A cylinder, or a cone cut off when `top_radius` is given.

    Parameters
    ----------
    center
        Its middle.
    radius
        Radius of the start, greater than 0.
    length
        Length along its axis, greater than 0.
    axis
        "x", "y", "z" or a direction.
    top_radius
        Radius of the far end; `radius` when left out.
    rotation
        Turns it about its middle.
    bevel
        Rounding of the edges, drawn only: a share of half the smallest side, 0 for sharp edges.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make(
        "cylinder",
        center,
        radius,
        length,
        axis,
        top_radius,
        rotation,
        bevel,
        color,
        metalness,
        roughness,
        material,
    )


def cone(
    center: VecLike,
    radius: float,
    length: float,
    axis: Axis = "y",
    rotation: Rotation | None = None,
    bevel: float | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A cone.

    Parameters
    ----------
    center
        The middle between its base and its tip.
    radius
        Radius of the base, greater than 0.
    length
        Length along its axis, greater than 0.
    axis
        "x", "y", "z" or a direction: towards the tip.
    rotation
        Turns it about its middle.
    bevel
        Rounding of the edges, drawn only: a share of half the smallest side, 0 for sharp edges.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("cone", center, radius, length, axis, rotation, bevel, color, metalness, roughness, material)


def limb(
    start: VecLike,
    end: VecLike,
    start_radius: float,
    end_radius: float,
    start_normal: VecLike | None = None,
    end_normal: VecLike | None = None,
    joint: str | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A tapering, bending segment between two rings; limbs that share a ring only touch.

    Parameters
    ----------
    start, end
        Centres of the rings.
    start_radius, end_radius
        Their radii, greater than 0.
    start_normal, end_normal
        Their directions; from `start` to `end` when left out.
    joint
        "round": it begins with a ball, and may overlap the parts in which its start lies.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make(
        "limb",
        start,
        end,
        start_radius,
        end_radius,
        start_normal,
        end_normal,
        joint,
        color,
        metalness,
        roughness,
        material,
    )


def segment(
    start: Frame,
    split: Frame,
    end: Frame,
    onto: Bark | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A bent, tapering segment of a tree: a wedge from `start` to `split`, a clean cone from there to `end`.

    A segment that starts with the frame in which another ends only touches it. A branch starts on its parent's bark
    and names it: its base is laid onto the cone, and drawn as grown out of it.

    Parameters
    ----------
    start, split, end
        Frames `(center, forward, up, radius)`: the two directions are unit vectors at right angles.
    onto
        What the base lies on, `(low, low_radius, high, high_radius)`.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("segment", start, split, end, onto, color, metalness, roughness, material)


def mesh(
    vertices: Any,
    faces: Any,
    center: VecLike = (0.0, 0.0, 0.0),
    rotation: Rotation | None = None,
    scale: float = 1.0,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A closed mesh of triangles.

    Parameters
    ----------
    vertices
        (n, 3) numbers; data from outside of the model.
    faces
        (m, 3) indices into `vertices`, counter-clockwise seen from outside; data from outside of the model.
    center
        Where the mesh's origin goes.
    rotation
        Turns it about its origin.
    scale
        Factor on all lengths, greater than 0.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("mesh", vertices, faces, center, rotation, scale, color, metalness, roughness, material)


def stroke(
    start: VecLike, end: VecLike, width: float, end_width: float | None = None, color: Color | None = None
) -> Any:
    """A straight stroke with round ends. Flat: z says only what lies in front of what.

    Parameters
    ----------
    start, end
        The middles of its ends, with the same z.
    width
        Width of the start, greater than 0.
    end_width
        Width of the end; `width` when left out.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    """
    return make("stroke", start, end, width, end_width, color)


def ellipse(
    center: VecLike, length: float, width: float, angle: float = 0.0, color: Color | None = None
) -> Any:
    """An ellipse. Flat: z says only what lies in front of what.

    Parameters
    ----------
    center
        Its middle.
    length, width
        Its full lengths, greater than 0.
    angle
        Of the length, radians from +x to +y.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    """
    return make("ellipse", center, length, width, angle, color)


def disc(center: VecLike, radius: float, color: Color | None = None) -> Any:
    """A disc. Flat: z says only what lies in front of what.

    Parameters
    ----------
    center
        Its middle.
    radius
        Greater than 0.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    """
    return make("disc", center, radius, color)


def sphere(
    center: VecLike,
    radius: float,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A sphere.

    Parameters
    ----------
    center
        Its middle.
    radius
        Greater than 0.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("sphere", center, radius, color, metalness, roughness, material)


def ellipsoid(
    center: VecLike,
    size: VecLike,
    rotation: Rotation | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """An ellipsoid: a sphere with a length along each axis.

    Parameters
    ----------
    center
        Its middle.
    size
        Its three full lengths, greater than 0.
    rotation
        Turns it about its middle.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("ellipsoid", center, size, rotation, color, metalness, roughness, material)


def wedge(
    center: VecLike,
    size: VecLike,
    rotation: Rotation | None = None,
    ridge: float = 0.0,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A wedge: a gable roof whose ridge runs along x.

    Parameters
    ----------
    center
        The middle of the box around it.
    size
        The side lengths of this box, greater than 0.
    rotation
        Turns it about its middle.
    ridge
        Place of the ridge across: 0 in the middle, -1 and 1 above the edges at -z and +z (a ramp).
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("wedge", center, size, rotation, ridge, color, metalness, roughness, material)


def torus(
    center: VecLike,
    radius: float,
    tube: float,
    axis: Axis = "y",
    rotation: Rotation | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A ring.

    Parameters
    ----------
    center
        Its middle.
    radius
        From the axis to the middle of the tube, greater than 0.
    tube
        Radius of the tube, greater than 0 and less than `radius`.
    axis
        The axis of the ring: "x", "y", "z" or a direction.
    rotation
        Turns it about its middle.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("torus", center, radius, tube, axis, rotation, color, metalness, roughness, material)


def arch(
    center: VecLike,
    size: VecLike,
    thickness: float,
    rotation: Rotation | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """An arch: a half ring on two legs, as of a bridge or a door.

    Parameters
    ----------
    center
        The middle of the box around it.
    size
        The side lengths of this box, greater than 0: across, up, deep.
    thickness
        Width of the legs and height of the middle stone, greater than 0 and less than half of the width.
    rotation
        Turns it about its middle.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("arch", center, size, thickness, rotation, color, metalness, roughness, material)


def extrude(
    polygon: Pairs,
    height: float,
    center: VecLike = (0.0, 0.0, 0.0),
    twist: float = 0.0,
    taper: float = 1.0,
    axis: str = "y",
    rotation: Rotation | None = None,
    bevel: float | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A prism over a polygon, which may be concave.

    Parameters
    ----------
    polygon
        Its corners in order, in either direction: pairs (x, z); with the axis "z" (x, y), with "x" (z, y).
    height
        Length along the axis, greater than 0.
    center
        Where the polygon's origin goes.
    twist
        The angle by which the far end is turned about the axis, in radians.
    taper
        How much the far end is scaled about the polygon's origin; 0 for a tip.
    axis
        "x", "y" or "z": where it goes from the polygon.
    rotation
        Turns it about the polygon's origin.
    bevel
        Rounding of the edges, drawn only: a share of half the smallest side, 0 for sharp edges.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make(
        "extrude",
        polygon,
        height,
        center,
        twist,
        taper,
        axis,
        rotation,
        bevel,
        color,
        metalness,
        roughness,
        material,
    )


def revolve(
    profile: Pairs,
    center: VecLike = (0.0, 0.0, 0.0),
    axis: Axis = "y",
    rotation: Rotation | None = None,
    bevel: float | None = None,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A solid of revolution, such as a vase.

    Parameters
    ----------
    profile
        Points of a line, in either direction: pairs (radius, height), the radius from the axis. Ends that are not on
        the axis are closed by discs; a line that ends where it begins makes a ring.
    center
        Where the point of the axis at height 0 goes.
    axis
        The axis: "x", "y", "z" or a direction.
    rotation
        Turns it about this point.
    bevel
        Rounding of the edges, drawn only: a share of half the smallest side, 0 for sharp edges.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("revolve", profile, center, axis, rotation, bevel, color, metalness, roughness, material)


def sweep(
    profile: Pairs,
    path: Points,
    scale: float = 1.0,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """A polygon that is drawn along a path of straight lines, such as a handrail.

    Parameters
    ----------
    profile
        Corners of the polygon in order, in either direction: pairs (sideways, up) about the path. Up is as near to
        the y axis as can be where the path starts, or to the z axis if it starts steeply.
    path
        Points of the path, at least two.
    scale
        How much the polygon is scaled at the end of the path; 0 for a tip.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("sweep", profile, path, scale, color, metalness, roughness, material)


def hull(
    points: Points,
    color: Color | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> Any:
    """The convex hull of points.

    Parameters
    ----------
    points
        At least four, not all in a plane; some may be inside.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e".
    metalness
        From 0 (paint, wood, stone) to 1 (metal); 0 when left out.
    roughness
        From 0 (a mirror) to 1 (chalk); that of the palette when left out.
    material
        The name of a material, which files keep; pictures do not show it.
    """
    return make("hull", points, color, metalness, roughness, material)


#: The functions for shapes; the engine has one of the same name for each.
SHAPES = (
    box,
    cylinder,
    cone,
    limb,
    segment,
    mesh,
    stroke,
    ellipse,
    disc,
    sphere,
    ellipsoid,
    wedge,
    torus,
    arch,
    extrude,
    revolve,
    sweep,
    hull,
)
