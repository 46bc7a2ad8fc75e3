//! Measured spectra as linear sRGB colors.
//!
//! This renderer computes in linear sRGB. Tabulated spectra are integrated against the CIE 1931 observer by the rule of
//! Mitsuba's RGB variants (1000 equidistant wavelengths from 360 to 830 nm), so that a file gives the same color in both:
//!
//! * a reflectance, an index of refraction or a coefficient of a medium is weighted by illuminant D65, so that a flat
//!   spectrum is gray;
//! * the radiance of an emitter is weighted by equal energy, so that a flat spectrum is as pink as it is to the eye.

use std::sync::LazyLock;

/// What a spectrum stands for, which decides its white and its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A fraction: white is D65, clamped to the unit cube.
    Reflectance,
    /// An index of refraction or a coefficient: white is D65, no upper bound.
    Unbounded,
    /// Emitted light: white is equal energy, no upper bound.
    Emission,
}

const STEPS: usize = 1000;
const FIRST: f64 = 360.0;
const LAST: f64 = 830.0;
const SPACING: f64 = 5.0;

/// Integral of the y curve: a flat emission of 1 has luminance 1.
const Y_INTEGRAL: f64 = 106.750_259_399_414_06;
/// Integral of the y curve times D65, over that of y: a flat reflectance of 1 has luminance 1.
const D65_MEAN: f64 = 98.997_417_518_762_55;

/// XYZ to linear sRGB (ITU-R BT.709 primaries, D65 white).
const TO_SRGB: [[f64; 3]; 3] =
    [[3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556], [0.055648, -0.204043, 1.057311]];

/// Rows of x, y, z and D65 every 5 nm.
static CURVES: LazyLock<Vec<[f64; 4]>> = LazyLock::new(|| {
    let file = include_str!("../../data/cie_1931_d65_5nm.csv");
    let rows = file.lines().filter(|line| !line.starts_with('#'));
    rows.map(|row| {
        let mut numbers = row.split(',').skip(1).map(|x| x.parse().expect("the table holds numbers"));
        std::array::from_fn(|_| numbers.next().expect("the table has five columns"))
    })
    .collect()
});

fn curves(wavelength: f64) -> [f64; 4] {
    let t = (wavelength - FIRST) / SPACING;
    let i = (t as usize).min(CURVES.len() - 2);
    let t = t - i as f64;
    std::array::from_fn(|c| CURVES[i][c] * (1.0 - t) + CURVES[i + 1][c] * t)
}

/// The color of a tabulated spectrum: increasing wavelengths in nm (at least two) with their values, linear in between,
/// zero outside. Colors out of gamut are clamped.
pub fn tabulated(wavelengths: &[f64], values: &[f64], role: Role) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    let mut upper = 1;
    for step in 0..STEPS {
        let x = FIRST + step as f64 / (STEPS - 1) as f64 * (LAST - FIRST);
        if x < wavelengths[0] || x > wavelengths[wavelengths.len() - 1] {
            continue;
        }
        while wavelengths[upper] < x {
            upper += 1;
        }
        let t = (x - wavelengths[upper - 1]) / (wavelengths[upper] - wavelengths[upper - 1]);
        let value = values[upper - 1] * (1.0 - t) + values[upper] * t;
        let [bar_x, bar_y, bar_z, d65] = curves(x);
        let white = if role == Role::Emission { 1.0 } else { d65 / D65_MEAN };
        for (sum, curve) in xyz.iter_mut().zip([bar_x, bar_y, bar_z]) {
            *sum += curve * white * value;
        }
    }
    let scale = (LAST - FIRST) / STEPS as f64 / Y_INTEGRAL;
    let color = srgb(xyz.map(|sum| sum * scale));
    let most = if role == Role::Reflectance { 1.0 } else { f64::MAX };
    color.map(|c| c.clamp(0.0, most))
}

/// The color of the same value at all wavelengths.
pub fn uniform(value: f64, role: Role) -> [f64; 3] {
    if role == Role::Emission { srgb([value; 3]) } else { [value; 3] }
}

fn srgb(xyz: [f64; 3]) -> [f64; 3] {
    TO_SRGB.map(|row| row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(ours: [f64; 3], mitsuba: [f64; 3]) {
        for (a, b) in ours.iter().zip(mitsuba) {
            assert!((a - b).abs() < 1e-5 * (1.0 + b), "{ours:?} against {mitsuba:?}");
        }
    }

    /// The values Mitsuba 3.9.1 gives in its `scalar_rgb` variant.
    #[test]
    fn colors_are_those_of_mitsuba() {
        let (w, v) = ([400.0, 500.0, 600.0, 700.0], [0.1, 0.6, 0.9, 1.0]);
        close(tabulated(&w, &v, Role::Reflectance), [0.974706, 0.739609, 0.318301]);
        close(tabulated(&w, &v, Role::Emission), [1.15019, 0.705721, 0.276247]);
        let (w, v) = ([500.0, 600.0], [5.0, 9.0]);
        close(tabulated(&w, &v, Role::Reflectance), [1.0, 1.0, 0.0]);
        close(tabulated(&w, &v, Role::Unbounded), [2.62775, 6.89586, 0.0]);
        close(tabulated(&w, &v, Role::Emission), [3.10231, 6.69789, 0.0]);
        close(tabulated(&[300.0, 900.0], &[1.0, 1.0], Role::Reflectance), [0.998985, 0.998874, 0.998802]);
        close(tabulated(&[5.0, 6.0], &[1.0, 1.0], Role::Emission), [0.0; 3]);
        close(uniform(0.5, Role::Emission), [0.602397, 0.474146, 0.454458]);
        close(uniform(0.5, Role::Unbounded), [0.5; 3]);
    }
}
