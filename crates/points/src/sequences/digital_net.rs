//! A digital net in base 2 from generating matrices of your own, with all scrambles and at the speed of `sobol`.
//!
//! Choose it for nets from a search or a table: those of `LatNet Builder`, the `LDData` collection, `MinT`, or other direction
//! numbers. `matrices` has one list of numbers for each dimension; number k writes column k, the digits of point 2^k, with the
//! first digit in the most significant of `bits` bits. m columns make 2^m points, 64 an endless sequence.
//! `quality::t_value` says how even the net is.

use super::{Entry, Spec};
use crate::digital_net::{BITS, DigitalNet};
use crate::scramble::Randomization;
use crate::{Error, PointSet};

const NAME: &str = "digital_net";

pub(super) const ENTRY: Entry = Entry {
    name: NAME,
    cite: "H. Niederreiter, Point sets and sequences with small discrepancy, Monatsh. Math. 104, 273-337 (1987)",
    accepts: Randomization::BASE_2,
    takes: &["matrices", "bits"],
    most_dims: 1 << 16,
    build,
};

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let wrong = |option, asked: String, allowed: String| {
        Err(Error::Option { sequence: NAME, option, asked, allowed })
    };
    let bits = match spec.options.bits {
        Some(bits) if (1..=BITS as u32).contains(&bits) => bits,
        other => {
            let asked = other.map_or("nothing".into(), |bits| bits.to_string());
            return wrong("bits", asked, "the number of digits of a column, 1 to 64".into());
        }
    };
    let matrices = spec.options.matrices.as_deref().unwrap_or(&[]);
    if matrices.len() != spec.dims {
        let allowed = format!("one list of columns for each of {} dimensions", spec.dims);
        return wrong("matrices", matrices.len().to_string(), allowed);
    }
    let columns = matrices[0].len();
    if !(1..=BITS).contains(&columns) {
        return wrong("matrices", columns.to_string(), "lists of 1 to 64 columns".into());
    }
    if let Some(other) = matrices.iter().find(|matrix| matrix.len() != columns) {
        let allowed = format!("lists of the same length, here {columns}");
        return wrong("matrices", other.len().to_string(), allowed);
    }
    if let Some(large) = matrices.iter().flatten().find(|&&column| column > u64::MAX >> (BITS as u32 - bits))
    {
        return wrong("matrices", large.to_string(), format!("numbers below 2^{bits}, as 'bits' says"));
    }
    let aligned =
        |matrix: &Vec<u64>| matrix.iter().map(|column| column << (BITS as u32 - bits)).collect::<Vec<_>>();
    let matrices: Vec<_> = matrices.iter().map(aligned).collect();
    Ok(Box::new(DigitalNet::finite(&matrices, spec.randomization, spec.seed)))
}
