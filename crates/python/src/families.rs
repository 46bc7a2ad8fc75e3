//! The door to the registries: the names in each, in the order of error messages.

use evenlight_points::{scramble, warp};
use evenlight_render::accel::KernelChoice;
use evenlight_render::integrator::{self, Mis};
use evenlight_render::{bsdf, emitter, filter, sampler, sensor, shape, texture};
use pyo3::prelude::*;

/// One function for each family, and `register`, which adds them to the extension module.
macro_rules! families {
    ($($family:ident: $names:expr,)*) => {
        $(#[pyfunction]
        fn $family() -> Vec<&'static str> {
            $names.collect()
        })*

        /// Adds this room to the extension module.
        pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_function(wrap_pyfunction!($family, module)?)?;)*
            Ok(())
        }
    };
}

families! {
    scrambles: scramble::ALL.iter().map(|entry| entry.name),
    warps: warp::ALL.iter().map(|entry| entry.name),
    integrators: integrator::ALL.iter().map(|entry| entry.name),
    samplers: sampler::ALL.iter().map(|entry| entry.name),
    filters: filter::ALL.iter().map(|entry| entry.name),
    bsdfs: bsdf::ALL.iter().map(|entry| entry.name),
    emitters: emitter::ALL.iter().map(|entry| entry.name),
    shapes: shape::ALL.iter().map(|entry| entry.name),
    textures: texture::ALL.iter().map(|entry| entry.name),
    sensors: sensor::ALL.iter().map(|entry| entry.name),
    kernels: KernelChoice::ALL.into_iter().map(KernelChoice::name),
    heuristics: Mis::ALL.into_iter().map(|(name, _)| name),
}
