//! A guide as the proposal of a chain.

use super::Proposing;
use super::accept::Rules;
use super::leaf::ChainMove;
use crate::Failure;
use crate::guide::bound::BoundGuide;
use niwaki_vm::fault::Fault;
use std::sync::Arc;

impl ChainMove for Arc<BoundGuide> {
    fn apply<R: Rules>(&mut self, _: Proposing<'_, '_, R>) -> Result<(), Failure> {
        Err(Fault::new("bad-kernel", "a guide draws the choices of runs that begin, not of chains").into())
    }
}
