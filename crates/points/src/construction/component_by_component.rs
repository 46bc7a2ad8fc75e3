//! The component-by-component algorithm, for one number of points or for all powers of 2 in a range.
//!
//! A vector for a range is *embedded*: its first 2^m points are a good lattice for every 2^m of the range. Each
//! coordinate takes the number whose worst ratio of errors to those of the best lattice of 2^m points is least, over
//! the range (R. Cools, F. Y. Kuo and D. Nuyens, *Constructing embedded lattice rules for multivariate integration*, SIAM J.
//! Sci. Comput. 28, 2162-2188, 2006).

use super::levels::Levels;
use crate::Error;
use crate::quality::lattice_criteria::{Space, check, wrong};

/// The most points of a lattice that can be constructed.
pub const MOST: u64 = 1 << 28;

/// The most points of a polynomial lattice that can be constructed.
pub const MOST_POLYNOMIAL: u64 = 1 << 24;

/// A generating vector for the lattice {k z / n}, with one coordinate for each weight.
///
/// `n` is prime or a power of 2. With `least`, both are powers of 2 and the vector is good for all between; it then
/// generates an extensible lattice. In time n log n for each coordinate, three times that for a range: a second for 100
/// coordinates and n = 2^18. The first number is 1; all are below n / 2 + 1.
///
/// ```
/// use evenlight_points::construction;
/// use evenlight_points::quality::lattice_criteria::Space;
/// let z = construction::lattice(1 << 10, None, &[1.0, 0.25], Space::Sobolev)?;
/// assert_eq!((z.len(), z[0]), (2, 1));
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Errors
/// If `n` is not as above or larger than [`MOST`], or the weights are not positive numbers.
pub fn lattice(n: u64, least: Option<u64>, weights: &[f64], space: Space) -> Result<Vec<u64>, Error> {
    check(&vec![1; weights.len()], n, weights, space)?;
    if space == Space::Walsh {
        return Err(wrong("space", "Walsh", "Sobolev or Korobov"));
    }
    let power = n.is_power_of_two() && n > 1;
    if n > MOST || !(power || n > 2 && (2..=n.isqrt()).all(|divisor| !n.is_multiple_of(divisor))) {
        return Err(wrong("n", &n.to_string(), &format!("prime or a power of 2, from 2 to {MOST}")));
    }
    let levels = if power { Levels::powers_of_two(n.ilog2(), space) } else { Levels::prime(n, space) };
    let first = first_level(least, n, power, levels.top())?;
    Ok(construct(&levels, first, weights))
}

/// Generating polynomials for the polynomial lattice modulo x^m, 2^m = n, with one for each weight: bit i is the
/// coefficient of x^i. With `least`, the vector is good for all powers of 2 between.
///
/// The criterion is that of [`Space::Walsh`]; time and result are as for [`lattice`].
///
/// # Errors
/// If `n` is not a power of 2 up to [`MOST_POLYNOMIAL`], or the weights are not positive numbers.
pub fn polynomial_lattice(n: u64, least: Option<u64>, weights: &[f64]) -> Result<Vec<u64>, Error> {
    check(&vec![1; weights.len()], n, weights, Space::Walsh)?;
    if !n.is_power_of_two() || !(2..=MOST_POLYNOMIAL).contains(&n) {
        return Err(wrong("n", &n.to_string(), &format!("a power of 2 from 2 to {MOST_POLYNOMIAL}")));
    }
    let levels = Levels::polynomials(n.ilog2());
    let first = first_level(least, n, true, levels.top())?;
    Ok(construct(&levels, first, weights))
}

fn first_level(least: Option<u64>, n: u64, power: bool, top: usize) -> Result<usize, Error> {
    match least {
        None => Ok(top),
        Some(least) if power && least.is_power_of_two() && (2..=n).contains(&least) => {
            Ok(least.ilog2() as usize)
        }
        Some(least) => Err(wrong(
            "least",
            &least.to_string(),
            &format!("a power of 2 from 2 to n, which is one too; n is {n}"),
        )),
    }
}

/// A lattice that grows by one coordinate after the other.
struct Growing {
    /// The level with which it ends.
    top: usize,
    /// For each level, Π (1 + γ ω) of its points.
    products: Vec<Vec<f64>>,
    /// The squared error so far, for each level with which it may end.
    errors: Vec<f64>,
    /// For every candidate, the sum of products times ω, over the levels that were seen.
    sums: Vec<f64>,
}

impl Growing {
    fn new(levels: &Levels, top: usize) -> Self {
        let products = (0..=top).map(|level| vec![1.0; levels.size(level)]).collect();
        Self { top, products, errors: vec![0.0; top + 1], sums: vec![] }
    }

    fn add(&mut self, sums: &[f64]) {
        repeat_to(&mut self.sums, sums.len());
        self.sums.iter_mut().zip(sums).for_each(|(sum, more)| *sum += more);
    }

    /// The squared error with a candidate, if the lattice ends with this level, which was the last to be added.
    fn error(&self, levels: &Levels, level: usize, weight: f64, candidate: usize) -> f64 {
        self.errors[level] + weight * self.sums[candidate] / levels.points(level) as f64
    }

    fn extend(&mut self, levels: &Levels, candidate: usize, weight: f64) {
        for (level, products) in self.products.iter_mut().enumerate() {
            levels.multiply(level, candidate, weight, products);
        }
        self.sums.clear();
    }
}

/// Goes on with the same numbers over again.
fn repeat_to(numbers: &mut Vec<f64>, len: usize) {
    if numbers.is_empty() {
        numbers.push(0.0);
    }
    while numbers.len() < len {
        numbers.extend_from_within(..numbers.len().min(len - numbers.len()));
    }
}

/// One number for each weight: the best for the last level, or the best in the worst case from level `first` on.
fn construct(levels: &Levels, first: usize, weights: &[f64]) -> Vec<u64> {
    let top = levels.top();
    // The best lattices of each size, and in a range also the one that is embedded, which is the last.
    let mut lattices: Vec<_> = (first..=top).map(|level| Growing::new(levels, level)).collect();
    let embedded = (first < top).then_some(lattices.len());
    lattices.extend(embedded.map(|_| Growing::new(levels, top)));
    let one = |(dim, &weight): (usize, &f64)| {
        let mut chosen = choose(levels, &mut lattices, (first, embedded), weight);
        if dim == 0 {
            chosen.fill(0); // all are the same but for rounding, and the first is 1
        }
        for (lattice, &candidate) in lattices.iter_mut().zip(&chosen) {
            lattice.extend(levels, candidate, weight);
        }
        levels.generator(*chosen.last().expect("there is a lattice"))
    };
    weights.iter().enumerate().map(one).collect()
}

/// The candidate that each lattice takes next; their errors are those with it afterwards.
fn choose(
    levels: &Levels,
    lattices: &mut [Growing],
    (first, embedded): (usize, Option<usize>),
    weight: f64,
) -> Vec<usize> {
    let (mut chosen, mut worst) = (vec![0; lattices.len()], vec![]);
    let mut errors = vec![];
    for level in 0..=levels.top() {
        add_sums(levels, level, lattices);
        let Some(at) = level.checked_sub(first) else { continue };
        let size = levels.size(level);
        let best = &mut lattices[at];
        let candidate = least(&best.sums);
        best.errors[level] = best.error(levels, level, weight, candidate);
        chosen[at] = candidate;
        if let Some(last) = embedded {
            let (yardstick, lattice) = (lattices[at].errors[level], &lattices[last]);
            repeat_to(&mut worst, size);
            for (candidate, worst) in worst.iter_mut().enumerate() {
                let ratio = lattice.error(levels, level, weight, candidate) / yardstick;
                *worst = ratio.max(*worst);
            }
            errors.push(lattice.sums.clone());
        }
    }
    if let Some(last) = embedded {
        let candidate = least(&worst);
        for (level, sums) in (first..).zip(errors) {
            let sum = sums[candidate % sums.len()];
            lattices[last].errors[level] += weight * sum / levels.points(level) as f64;
        }
        chosen[last] = candidate;
    }
    chosen
}

/// Adds the sums of a level to all lattices that have it, two at a time.
fn add_sums(levels: &Levels, level: usize, lattices: &mut [Growing]) {
    let mut with: Vec<_> = lattices.iter_mut().filter(|lattice| lattice.top >= level).collect();
    for pair in with.chunks_mut(2) {
        let [first, second] = [0, pair.len() - 1].map(|i| pair[i].products[level].as_slice());
        let sums = levels.correlate(level, [first, second]);
        pair.iter_mut().zip(&sums).for_each(|(lattice, sums)| lattice.add(sums));
    }
}

/// The first of those that are least but for rounding.
fn least(values: &[f64]) -> usize {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    values.iter().position(|value| value - least <= 1e-12 * least.abs()).unwrap_or(0)
}
