//! Generating vectors of lattices and of polynomial lattices, which `README.md` here describes.

/// Bytes of a number, little-endian.
const RECORD: usize = 3;

static LATTICE: &[u8] = include_bytes!("lattice.bin");
static POLYNOMIALS: &[u8] = include_bytes!("polynomial_lattice.bin");

/// The coordinates of the lattice.
pub(crate) const LATTICE_DIMS: usize = LATTICE.len() / RECORD;

/// The coordinates of the polynomial lattice.
pub(crate) const POLYNOMIAL_DIMS: usize = POLYNOMIALS.len() / RECORD;

/// One number of the lattice for 2^10 to 2^20 points.
pub(crate) fn lattice_number(dim: usize) -> u64 {
    number(LATTICE, dim)
}

/// One polynomial of the polynomial lattice for 2^8 to 2^18 points.
pub(crate) fn polynomial(dim: usize) -> u64 {
    number(POLYNOMIALS, dim)
}

fn number(records: &[u8], dim: usize) -> u64 {
    let record = &records[dim * RECORD..][..RECORD];
    record.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}
