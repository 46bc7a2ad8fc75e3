//! Fibonacci lattices: the best lattices of the plane.
//!
//! n is a Fibonacci number, m the one before, and point i is (i / n, {i m / n}). For two dimensions and a fixed number of points;
//! for any number of points take `kronecker`, for more dimensions `lattice`.

use super::{Entry, Spec};
use crate::counts::{counted_up_to, wrong_count};
use crate::modular::{Generator, MOST, ModularPoints};
use crate::scramble::Randomization;
use crate::{Error, PointSet};

pub(super) const ENTRY: Entry = Entry {
    name: "fibonacci",
    cite: "N. S. Bakhvalov, Approximate computation of multiple integrals, Vestnik Moskov. Univ. 4, 3-18 (1959); S. K. \
           Zaremba, Good lattice points, discrepancy, and numerical integration, Ann. Mat. Pura Appl. 73, 293-317 (1966)",
    accepts: Randomization::MODULAR,
    takes: &["n"],
    most_dims: 2,
    build,
};

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let n = counted_up_to("fibonacci", spec, MOST)?;
    let (mut before, mut last) = (1, 1);
    while last < n {
        (before, last) = (last, before + last);
    }
    if last != n {
        return Err(wrong_count("fibonacci", n, "a Fibonacci number", [Some(before), Some(last)], MOST));
    }
    let generator = Generator::lattice(&[1, before][..spec.dims], n);
    Ok(Box::new(ModularPoints::new(generator, Some(n), spec.randomization, spec.seed)))
}
