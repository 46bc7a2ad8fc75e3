//! How evenly points are spread, as numbers: one file, one family of measures.

pub mod lattice_criteria;
