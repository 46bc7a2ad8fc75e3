//! Polynomials over the integers modulo a prime: the irreducible ones in order, and the digits of their reciprocals.

/// Coefficients, that of 1 first; the last is 1.
pub(crate) type Monic = Vec<u64>;

/// The first `count` irreducible monic polynomials, by degree, and then by their coefficients read as a number.
pub(crate) fn irreducible(prime: u64, count: usize) -> Vec<Monic> {
    let mut found: Vec<Monic> = Vec::with_capacity(count);
    for degree in 1.. {
        for number in 0..prime.pow(degree) {
            if found.len() == count {
                return found;
            }
            let candidate: Monic = digits(number, prime, degree).chain([1]).collect();
            let factors = found.iter().take_while(|factor| 2 * (factor.len() - 1) <= degree as usize);
            if factors.into_iter().all(|factor| !divides(factor, &candidate, prime)) {
                found.push(candidate);
            }
        }
    }
    unreachable!("there are irreducible polynomials of every degree")
}

/// The digits of a number, the least significant first.
fn digits(number: u64, base: u64, count: u32) -> impl Iterator<Item = u64> {
    (0..count).scan(number, move |rest, _| {
        let digit = *rest % base;
        *rest /= base;
        Some(digit)
    })
}

/// Whether a polynomial divides another.
fn divides(divisor: &Monic, dividend: &Monic, prime: u64) -> bool {
    let degree = divisor.len() - 1;
    let mut rest = dividend.clone();
    while let Some(leading) = rest.pop() {
        if rest.len() < degree {
            return leading == 0 && rest.iter().all(|&coefficient| coefficient == 0);
        }
        let lower = rest.len() - degree;
        for (coefficient, factor) in rest[lower..].iter_mut().zip(divisor) {
            *coefficient = (*coefficient + (prime - leading) * factor) % prime;
        }
    }
    true
}

/// The product of two polynomials.
pub(crate) fn product(a: &Monic, b: &Monic, prime: u64) -> Monic {
    let mut product = vec![0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (coefficient, y) in product[i..].iter_mut().zip(b) {
            *coefficient = (*coefficient + x * y) % prime;
        }
    }
    product
}

/// The coefficients of x^-1, x^-2, … in the reciprocal of a polynomial.
pub(crate) fn reciprocal(polynomial: &Monic, count: usize, prime: u64) -> Vec<u64> {
    let degree = polynomial.len() - 1;
    let mut series: Vec<u64> = Vec::with_capacity(count);
    for place in 0..count {
        // the coefficient of x^(degree - 1 - place) in polynomial · series, which is that of 1
        let earlier = polynomial[..degree].iter().rev().zip(series.iter().rev());
        let sum = earlier.map(|(x, y)| x * y).sum::<u64>() % prime;
        series.push((u64::from(place + 1 == degree) + prime - sum) % prime);
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;

    /// C. F. Gauss: the monic polynomials of degree n that are irreducible number (1 / n) Σ μ(n / k) p^k over the divisors k of n.
    #[test]
    fn there_are_as_many_irreducible_polynomials_as_known() {
        for (prime, known) in [(2, &[2, 1, 2, 3, 6, 9, 18][..]), (3, &[3, 3, 8, 18, 48]), (7, &[7, 21, 112])]
        {
            let total: usize = known.iter().sum();
            let found = irreducible(prime, total + 1);
            for (degree, &count) in (2..).zip(known) {
                assert_eq!(
                    found.iter().filter(|polynomial| polynomial.len() == degree).count(),
                    count,
                    "{prime}"
                );
            }
            assert_eq!(found.last().map(Vec::len), Some(known.len() + 2));
        }
        assert_eq!(irreducible(2, 4)[2..], [vec![1, 1, 1], vec![1, 1, 0, 1]]);
    }

    #[test]
    fn a_polynomial_times_its_reciprocal_is_one() {
        for (prime, polynomial) in [(2, vec![1, 1, 0, 1]), (5, vec![3, 1]), (7, vec![1, 2, 3, 4, 1])] {
            let series = reciprocal(&polynomial, 40, prime);
            for power in 0..30 {
                // of x^(degree - 1 - power)
                let degree = polynomial.len() - 1;
                let terms = (0..=degree.min(power)).map(|i| polynomial[degree - i] * series[power - i]);
                assert_eq!(terms.sum::<u64>() % prime, u64::from(power + 1 == degree), "{prime}, {power}");
            }
        }
    }
}
