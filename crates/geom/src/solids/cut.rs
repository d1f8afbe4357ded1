//! Solids cut from others: no word makes them, but the operators `-`, `&` and `|` ([`crate::cut`]).

use super::measured::{Checks, Form, Measured};
use crate::cut::{Cut, surface};
use crate::error::GeomError;
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use std::sync::Arc;

impl Measured for Arc<Cut> {
    const KIND: &'static str = "cut";
    const FORM: Form = Form::Mesh;

    fn check(&self, _checks: Checks) -> Result<(), GeomError> {
        Cut::check(self)
    }

    fn bytes(&self) -> usize {
        Cut::bytes(self)
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        surface::mesh(self).map(|mesh| mesh.map(|p| placement.apply(p)))
    }

    /// The frame of the solid from which the rest is cut.
    fn frame(&self, placement: &Placement) -> Placement {
        placement.after(&self.base().frame())
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        surface::fine(self)
    }
}
