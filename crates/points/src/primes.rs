//! Prime numbers: the bases of most sequences.

/// The largest base whose digits have 16 bits.
pub(crate) const MOST_BASE: u64 = 1 << 16;

/// The number of primes below [`MOST_BASE`].
pub(crate) const COUNT: usize = 6_542;

/// The first `count` primes, at most [`COUNT`] of them, by the sieve of Eratosthenes.
pub(crate) fn primes(count: usize) -> Vec<u64> {
    let mut composite = vec![false; MOST_BASE as usize];
    let mut found = Vec::with_capacity(count);
    for candidate in 2..composite.len() {
        if found.len() == count {
            break;
        }
        if !composite[candidate] {
            found.push(candidate as u64);
            composite.iter_mut().skip(candidate * candidate).step_by(candidate).for_each(|c| *c = true);
        }
    }
    found
}

/// Whether a number is a prime, by trial division.
pub(crate) fn is_prime(number: u64) -> bool {
    number > 1 && (2..=number.isqrt()).all(|factor| !number.is_multiple_of(factor))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sieve_finds_what_divides_by_nothing() {
        let found = primes(COUNT);
        assert_eq!((found.len(), found.last()), (COUNT, Some(&65_521)));
        assert!(found.iter().copied().eq((0..MOST_BASE).filter(|&number| is_prime(number))));
    }
}
