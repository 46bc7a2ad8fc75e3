//! Scenes: from a file to plain data to something a ray can meet.

pub mod build;
pub mod materials;
pub mod node;
pub mod properties;
