//! No interface at all: light passes as if nothing were there. For the boundaries of participating media.

use std::sync::Arc;

use crate::bsdf::{Bsdf, BsdfSample};
use crate::geometry::{Rgb, Surface, Vec3};
use crate::scene::build::Entry;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "null", build: |_, _| Ok(Arc::new(Null)) };

/// Nothing.
pub struct Null;

impl Bsdf for Null {
    fn sample(&self, _: &Surface, wo: Vec3, _: f32, _: [f32; 2]) -> Option<BsdfSample> {
        Some(BsdfSample::pass_through(wo, Rgb::ONE, 1.0))
    }

    fn has_smooth_lobe(&self) -> bool {
        false
    }

    fn transmits(&self) -> bool {
        true
    }

    fn albedo(&self, _: &Surface) -> Rgb {
        Rgb::ONE
    }
}
