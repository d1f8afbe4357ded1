//! The content and settings of a picture: surfaces, backdrop, camera.

use super::camera::Camera;
use super::v3::V3;

/// A triangle mesh with paint on it.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Corners in scene units.
    pub vertices: Vec<[f32; 3]>,
    /// Triangles as indices of corners.
    pub faces: Vec<[u32; 3]>,
    /// Normals: one for each vertex (smooth), one for each face (flat), or none (those of the faces).
    pub normals: Vec<[f32; 3]>,
    /// Paint, sRGB in `[0, 1]`.
    pub color: [f32; 3],
    /// Gloss, from 0 (chalk) to 1 (lacquer).
    pub gloss: f32,
    /// Metalness, from 0 (paint) to 1 (metal). Metal tints its reflections and has no other colour.
    pub metal: f32,
    /// Roughness, from 0 (smooth) to 1 (foliage): bumps in the shading only.
    pub rough: f32,
    /// Size of those bumps, scene units.
    pub pitch: f32,
}

/// The background of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Backdrop {
    /// A transparent page: the shadow and the scene lie over zero alpha.
    Clear,
    /// A seamless studio roll, from `top` to `bottom` of the picture; sRGB in `[0, 1]`.
    Roll {
        /// Colour at the picture's upper edge.
        top: [f32; 3],
        /// Colour at the picture's lower edge.
        bottom: [f32; 3],
    },
}

/// The settings of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Rays for each pixel where the picture changes, and a quarter of them elsewhere. Shadow rays and sky rays are as many.
    pub samples: usize,
    /// The camera; `None` frames the scene and its ghost.
    pub camera: Option<Camera>,
    /// Height of the floor that catches shadows; `None` is the scene's lowest point.
    pub floor: Option<f32>,
    /// The background.
    pub backdrop: Backdrop,
    /// Colour of the ghost; sRGB in `[0, 1]`.
    pub ghost_color: [f32; 3],
}

impl Default for Shot {
    fn default() -> Shot {
        Shot {
            width: 640,
            height: 480,
            samples: 16,
            camera: None,
            floor: None,
            backdrop: Backdrop::Roll { top: [0.97, 0.965, 0.955], bottom: [0.90, 0.895, 0.885] },
            ghost_color: [0.36, 0.58, 0.80],
        }
    }
}

/// Corners of the faces, ready for a tree.
pub(super) fn corners(surface: &Surface) -> impl Iterator<Item = [V3; 3]> + '_ {
    surface.faces.iter().map(|face| face.map(|i| V3::from(surface.vertices[i as usize])))
}
