//! Digits in base 4 to a point of a triangle and back, exactly.
//!
//! Digit 0 chooses the triangle of the midpoints, digits 1, 2, 3 those at the corners. A corner's triangle is moved towards the
//! corner, by half of the current size, and the central one is turned over where it is. So the center of the last triangle is
//! the centroid plus Σ ± 2⁻ʲ (corner of digit j − centroid) over the digits that are not 0, with one change of sign for
//! each 0 before. The sums are whole numbers of 2⁻³²; the only rounding is that of the result.

/// What four digits do: steps towards the three corners, in sixteenths of the current size, and the sign of what follows.
#[derive(Clone, Copy)]
struct Step {
    corners: [i8; 3],
    sign: i8,
}

/// One step for each byte, that is for each four digits.
static STEPS: [Step; 256] = steps();

const fn steps() -> [Step; 256] {
    let mut steps = [Step { corners: [0; 3], sign: 1 }; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut place = 0;
        while place < 4 {
            let digit = byte >> (6 - 2 * place) & 3;
            if digit == 0 {
                steps[byte].sign = -steps[byte].sign;
            } else {
                steps[byte].corners[digit - 1] += steps[byte].sign * (8 >> place);
            }
            place += 1;
        }
        byte += 1;
    }
    steps
}

/// The barycentric coordinates of the center of the triangle that 32 digits choose; the first digit is the most significant.
///
/// ```
/// use evenlight_points::warp::triangle::digits::barycentric;
/// assert_eq!(barycentric(0), [1.0 / 3.0; 3]);
/// assert_eq!(barycentric(1 << 62), [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0]); // digit 1, then zeros
/// ```
#[inline]
pub fn barycentric(mut word: u64) -> [f64; 3] {
    const WHOLE: f64 = 3.0 * (1_u64 << 32) as f64;
    let (mut steps, mut sign, mut place) = ([0_i64; 3], 1, 28);
    while word != 0 {
        let step = STEPS[(word >> 56) as usize];
        for (sum, &corner) in steps.iter_mut().zip(&step.corners) {
            *sum += (sign * i64::from(corner)) << place;
        }
        sign *= i64::from(step.sign);
        (word, place) = (word << 8, place - 4);
    }
    let rest = (1 << 32) - steps.iter().sum::<i64>();
    steps.map(|step| (rest + 3 * step) as f64 / WHOLE)
}

/// The first `count` digits of the triangles that a point is in, zeros after them.
#[inline]
pub fn word(mut point: [f64; 3], count: u32) -> u64 {
    let mut word = 0;
    for _ in 0..count {
        let corner = (0..3).find(|&corner| point[corner] > 0.5);
        word = word << 2 | corner.map_or(0, |corner| corner as u64 + 1);
        point = match corner {
            Some(corner) => std::array::from_fn(|k| 2.0 * point[k] - f64::from(u8::from(k == corner))),
            None => point.map(|x| 1.0 - 2.0 * x),
        };
    }
    word << (64 - 2 * count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition: corners replaced, digit by digit.
    fn by_corners(word: u64) -> [f64; 3] {
        let middle = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| f64::midpoint(a[k], b[k]));
        let mut corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for place in 0..32 {
            let [a, b, c] = corners;
            let (ab, ac, bc) = (middle(a, b), middle(a, c), middle(b, c));
            corners = match word >> (62 - 2 * place) & 3 {
                0 => [bc, ac, ab],
                1 => [a, ab, ac],
                2 => [ab, b, bc],
                _ => [ac, bc, c],
            };
        }
        std::array::from_fn(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0)
    }

    #[test]
    fn sums_of_steps_are_the_recursion_and_can_be_undone() {
        for i in 0..10_000 {
            let digits = crate::seed::mix(i);
            let (sum, recursion) = (barycentric(digits), by_corners(digits));
            for (a, b) in sum.into_iter().zip(recursion) {
                assert!((a - b).abs() < 4e-16, "{digits:x}: {sum:?} {recursion:?}");
            }
            let cut = digits >> 10 << 10;
            assert_eq!(word(barycentric(cut), 27), cut, "{digits:x}");
        }
    }
}
