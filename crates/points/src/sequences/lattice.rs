//! Rank-1 lattices {i z / n}, extensible by default: for smooth and periodic integrands in many dimensions.
//!
//! Without `n`, points come in the order of the radical inverse, so that the first 2^m of them are the lattice of 2^m
//! points for every m up to 64: take powers of 2 of them. The default vector is our own, embedded from 2^10 to 2^20 points
//! for product weights 1/j²; beyond, its further digits are random, which is good with high probability (T. Goda and
//! P. L'Ecuyer, *Construction-free median quasi-Monte Carlo rules*, 2022). The option `generator` takes another vector of
//! odd numbers, such as one of [`crate::construction::lattice`].
//!
//! With `n` and a vector it is the lattice of n points in natural order; without a vector n is a power of 2.
//! For periodic integrands take `shift`, for others `shift_tent`.

use super::{Entry, Spec};
use crate::construction::korobov::coprime;
use crate::counts::{counted_up_to, wrong_count};
use crate::data::generating_vectors::{LATTICE_DIMS, lattice_number};
use crate::modular::{Generator, MOST, ModularPoints};
use crate::scramble::Randomization;
use crate::{Error, PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "lattice",
    cite: "I. H. Sloan and S. Joe, Lattice methods for multiple integration, Oxford (1994); extensible as in F. J. Hickernell \
           et al., SIAM J. Sci. Comput. 22, 1117-1138 (2000), and R. Cools, F. Y. Kuo and D. Nuyens, SIAM J. Sci. Comput. \
           28, 2162-2188 (2006)",
    accepts: Randomization::MODULAR,
    takes: &["n", "generator"],
    most_dims: LATTICE_DIMS,
    build,
};

/// The digits of the default vector that are constructed; the others are random.
const CONSTRUCTED: u32 = 20;

/// Number `dim` of the default vector, of 64 binary digits.
///
/// # Panics
/// If there is none.
pub fn default_number(dim: usize) -> u64 {
    lattice_number(dim) | (Seed::new(0).dimension(dim as u64).bits64() >> CONSTRUCTED << CONSTRUCTED)
}

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let n = spec.options.n.map(|_| counted_up_to("lattice", spec, MOST)).transpose()?;
    let z = vector(spec, n)?;
    let generator = match n {
        None => Generator::Radical(z.into()),
        Some(n) => Generator::lattice(&z, n),
    };
    Ok(Box::new(ModularPoints::new(generator, n, spec.randomization, spec.seed)))
}

/// The vector that is given or built in, once it is known to be right for n points.
fn vector(spec: &Spec, n: Option<u64>) -> Result<Vec<u64>, Error> {
    let wrong = |asked: String, allowed| {
        Err(Error::Option { sequence: "lattice", option: "generator", asked, allowed })
    };
    match (&spec.options.generator, n) {
        (None, Some(n)) if !n.is_power_of_two() => {
            let near = [Some(n.next_power_of_two() / 2), Some(n.next_power_of_two())];
            Err(wrong_count("lattice", n, "a power of 2 if no generator is given", near, MOST))
        }
        (None, _) => Ok((0..spec.dims).map(default_number).collect()),
        (Some(z), _) if z.len() != spec.dims => {
            wrong(format!("{} numbers", z.len()), format!("{} numbers", spec.dims))
        }
        (Some(z), None) => match z.iter().find(|z| z.is_multiple_of(2)) {
            Some(even) => wrong(format!("{even}"), "odd numbers if n is not given".into()),
            None => Ok(z.clone()),
        },
        (Some(z), Some(n)) => match z.iter().find(|&&z| !coprime(z, n)) {
            Some(z) => wrong(format!("{z}"), format!("numbers that have no divisor in common with n = {n}")),
            None => Ok(z.clone()),
        },
    }
}
