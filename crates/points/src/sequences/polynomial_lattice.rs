//! Polynomial lattices in base 2, extensible: nets whose matrices are made for given weights.
//!
//! What lattices are for shifts modulo 1, these are for digits: point i is φ(i) q, a product without carry modulo 1,
//! for polynomials q over {0, 1}. The first 2^m points are the polynomial lattice modulo x^m, for every m: take powers of 2 of
//! them. They run on the engine of all nets, with all its randomizations; `owen` gives smooth functions the rate n^-3/2.
//!
//! The option `generator` takes the polynomials, bit i the coefficient of x^i, bit 0 set: those of
//! [`crate::construction::polynomial_lattice`] are made for the weights of a problem and one number of points. With weights 1/j² and
//! from 2^8 to 2^14 points, their squared error is that of `sobol` in 2 dimensions, 2 to 13 % larger in 5, and 18 % smaller to
//! 1 % larger in 20. The default ones serve all numbers of points from 2^8 to 2^18, and their squared error is 1.1 to 1.9 times
//! that of `sobol`: for trying things out.
//!
//! The latter is the price of extending polynomial lattices. In two dimensions, of which the first has q = 1, the first 2^m points
//! have t = 0 if for every a the matrix with entries `q_(m − a + k − r)`, 0 ≤ k, r < a, is invertible. For a = 1 and all m, every
//! coefficient of q would have to be 1, and then no matrix with a = 2 is invertible; the first two coordinates of `sobol` have t = 0
//! for all m. One more digit of the index leaves a polynomial lattice one free bit for each coordinate.

use super::{Entry, Spec};
use crate::data::generating_vectors::{POLYNOMIAL_DIMS, polynomial};
use crate::digital_net::{BITS, DigitalNet};
use crate::scramble::Randomization;
use crate::{Error, PointSet, Seed};

pub(super) const ENTRY: Entry = Entry {
    name: "polynomial_lattice",
    cite: "H. Niederreiter, Low-discrepancy point sets obtained by digital constructions over finite fields, Czechoslovak \
           Math. J. 42, 143-166 (1992); extensible as in J. Dick, The construction of extensible polynomial lattice rules \
           with small weighted star discrepancy, Math. Comp. 76, 2077-2085 (2007)",
    accepts: Randomization::BASE_2,
    takes: &["generator"],
    most_dims: POLYNOMIAL_DIMS,
    build,
};

/// The digits of the default polynomials that are constructed; the others are random.
const CONSTRUCTED: u32 = 18;

/// The default polynomial of a coordinate, of degree 63 at most.
///
/// # Panics
/// If there is none.
pub fn default_polynomial(dim: usize) -> u64 {
    polynomial(dim) | (Seed::new(1).dimension(dim as u64).bits64() >> CONSTRUCTED << CONSTRUCTED)
}

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let wrong = |asked: String, allowed| {
        Err(Error::Option { sequence: "polynomial_lattice", option: "generator", asked, allowed })
    };
    let polynomials = match &spec.options.generator {
        None => (0..spec.dims).map(default_polynomial).collect(),
        Some(given) if given.len() != spec.dims => {
            return wrong(format!("{} numbers", given.len()), format!("{} numbers", spec.dims));
        }
        Some(given) => match given.iter().find(|q| q.is_multiple_of(2)) {
            Some(even) => {
                return wrong(even.to_string(), "odd numbers: polynomials with a constant term".into());
            }
            None => given.clone(),
        },
    };
    // Bit k of the index is worth x^-(k+1).
    let matrix = |q: &u64| std::array::from_fn(|k| q << (BITS - 1 - k));
    let matrices: Vec<[u64; BITS]> = polynomials.iter().map(matrix).collect();
    Ok(Box::new(DigitalNet::new(&matrices, spec.randomization, spec.seed)))
}
