//! Scenes: from a file to plain data to something a ray can meet.

pub mod build;
pub mod folder;
pub mod materials;
pub mod mesh;
pub mod mitsuba;
pub mod node;
pub mod properties;
pub mod spectrum;
