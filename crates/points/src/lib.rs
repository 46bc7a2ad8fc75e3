//! Uniform numbers: where to look.
