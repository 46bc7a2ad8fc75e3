//! Interlaced Sobol' points: a higher-order net, for smooth integrands.
//!
//! One coordinate takes its digits in turn from `order` = α consecutive Sobol' coordinates (J. Dick 2008). If the integrand
//! has α square-integrable mixed derivatives, errors fall nearly as n^(−α) without a scramble and as n^(−α − 1/2) with
//! one, which acts on each of the coordinates before they are interlaced; n^(−3/2) is what `sobol` reaches. Below the first
//! kink, jump or dimension too many it is no better than `sobol`, and its quality parameter t is larger.
//!
//! Errors stop falling at the 53 digits of a double, to which each of the coordinates gives 53/α: after some 2^27, 2^18,
//! 2^14 and 2^11 points for orders 2 to 5. Up to there all digits of the index arrive in the result.

use super::{Entry, Spec};
use crate::data::direction_numbers::{SOBOL_DIMS, direction_numbers};
use crate::digital_net::interlaced::{ACCEPTS, InterlacedNet, ORDERS};
use crate::scramble::Randomization;
use crate::{Error, PointSet, Seed};

const NAME: &str = "interlaced_sobol";

pub(super) const ENTRY: Entry = Entry {
    name: NAME,
    cite: "J. Dick, Walsh spaces containing smooth functions and quasi-Monte Carlo rules of arbitrary high order, SIAM J. \
           Numer. Anal. 46, 1519-1553 (2008), of the Sobol' points of S. Joe and F. Y. Kuo (2008)",
    accepts: ACCEPTS,
    takes: &["order"],
    most_dims: SOBOL_DIMS / 2,
    build,
};

/// The first `dims` coordinates, each of `order` Sobol' coordinates.
///
/// # Panics
/// If the order is not 2 to 5, there are more than 21,201 / order dimensions, or none.
pub fn interlaced_sobol(
    dims: usize,
    order: usize,
    randomization: Randomization,
    seed: Seed,
) -> InterlacedNet {
    let matrices: Vec<_> = (0..dims * order).map(direction_numbers).collect();
    InterlacedNet::new(&matrices, order, randomization, seed)
}

fn build(spec: &Spec) -> Result<Box<dyn PointSet>, Error> {
    let asked = spec.options.order.unwrap_or(2);
    let order = asked as usize;
    if !ORDERS.contains(&order) {
        let allowed = format!("{} to {}", ORDERS.start(), ORDERS.end());
        return Err(Error::Option { sequence: NAME, option: "order", asked: asked.to_string(), allowed });
    }
    if spec.dims > SOBOL_DIMS / order {
        return Err(Error::Dimensions { sequence: NAME, asked: spec.dims, most: SOBOL_DIMS / order });
    }
    Ok(Box::new(interlaced_sobol(spec.dims, order, spec.randomization, spec.seed)))
}
