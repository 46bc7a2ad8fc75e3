//! Korobov lattices {i (1, a, a², …) / n}: a whole lattice from one number.
//!
//! For a fixed number of points n, of any kind, where a published or searched a is at hand: the option `generator`.
//! Without it, a is the best of a few in eight dimensions, which takes time n and is done up to n = 2^20;
//! [`crate::construction::korobov::search`] finds better ones for the dimension and the weights of a problem. Vectors made
//! component by component, as in `lattice`, are better still.

use super::{Entry, Spec};
use crate::construction::korobov::{coprime, powers, search};
use crate::counts::counted_up_to;
use crate::modular::{Generator, MOST, ModularPoints};
use crate::quality::lattice_criteria::Space;
use crate::scramble::Randomization;
use crate::{Error, PointSet};

pub(super) const ENTRY: Entry = Entry {
    name: "korobov",
    cite: "N. M. Korobov, The approximate computation of multiple integrals, Dokl. Akad. Nauk SSSR 124, 1207-1210 (1959)",
    accepts: Randomization::MODULAR,
    takes: &["n", "generator"],
    most_dims: 1 << 16,
    build,
};

/// The most points for which a default is searched, and among how many numbers.
const SEARCHED: u64 = 1 << 20;
const CANDIDATES: u64 = 16;

/// The weights of the search: those of the coordinates that it looks at.
const WEIGHTS: [f64; 8] =
    [1.0, 1.0 / 4.0, 1.0 / 9.0, 1.0 / 16.0, 1.0 / 25.0, 1.0 / 36.0, 1.0 / 49.0, 1.0 / 64.0];

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let n = counted_up_to("korobov", spec, MOST)?;
    let wrong = |asked: String| {
        let allowed = if n > SEARCHED {
            format!("given if n is above {SEARCHED}: one number that has no divisor in common with n")
        } else {
            "one number that has no divisor in common with n".into()
        };
        Error::Option { sequence: "korobov", option: "generator", asked, allowed }
    };
    let a = match spec.options.generator.as_deref() {
        None if n <= SEARCHED => search(n, &WEIGHTS, Space::Sobolev, CANDIDATES)?,
        None => return Err(wrong("nothing".into())),
        Some(&[a]) if coprime(a, n) => a,
        Some([a]) => return Err(wrong(a.to_string())),
        Some(more) => return Err(wrong(format!("{} numbers", more.len()))),
    };
    let generator = Generator::lattice(&powers(a, n, spec.dims), n);
    Ok(Box::new(ModularPoints::new(generator, Some(n), spec.randomization, spec.seed)))
}
