//! Named materials: indices of refraction of dielectrics and of conductors.
//!
//! Names and figures are those of Mitsuba 3's documentation, so that a scene means the same in both renderers.
//! Dielectrics: Hecht, "Optics", 4th edition, measured at 0–20 °C and about 589 nm. Conductors: the Luxpop database
//! (Palik; CXRO and LLNL), integrated by `data/make_conductors.py`; several measurements of one material have several
//! names.

/// Names and indices of refraction of dielectrics.
pub const DIELECTRICS: &[(&str, f32)] = &[
    ("vacuum", 1.0),
    ("helium", 1.000036),
    ("hydrogen", 1.000132),
    ("air", 1.000277),
    ("carbon dioxide", 1.00045),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.52045),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.575),
    ("diamond", 2.419),
];

static CONDUCTORS: &str = include_str!("../../data/conductors.csv");

/// Index of refraction of a dielectric; upper and lower case are the same.
pub fn dielectric_ior(name: &str) -> Option<f32> {
    DIELECTRICS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, ior)| *ior)
}

/// Real and imaginary index of refraction of a conductor in linear sRGB. `none` reflects all light: eta 0, k 1.
pub fn conductor(name: &str) -> Option<([f32; 3], [f32; 3])> {
    if name == "none" {
        return Some(([0.0; 3], [1.0; 3]));
    }
    let row = rows().find(|row| row.split(',').next() == Some(name))?;
    let numbers: Vec<f32> = row.split(',').skip(1).filter_map(|number| number.parse().ok()).collect();
    let [r, g, b, k_r, k_g, k_b] = numbers[..] else { return None };
    Some(([r, g, b], [k_r, k_g, k_b]))
}

/// Names of all conductors.
pub fn conductors() -> impl Iterator<Item = &'static str> {
    std::iter::once("none").chain(rows().filter_map(|row| row.split(',').next()))
}

fn rows() -> impl Iterator<Item = &'static str> {
    CONDUCTORS.lines().filter(|line| !line.starts_with('#'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_material_is_found() {
        assert!(DIELECTRICS.iter().all(|(name, ior)| dielectric_ior(name) == Some(*ior)));
        assert_eq!(dielectric_ior("Water"), Some(1.333));
        assert_eq!(dielectric_ior("unobtainium"), None);
        assert!(conductors().all(|name| conductor(name).is_some()));
        assert_eq!(conductors().count(), 72);
        assert_eq!(conductor("unobtainium"), None);
    }

    /// The values Mitsuba 3.9.1 gives in its `scalar_rgb` variant.
    #[test]
    fn conductors_are_those_of_mitsuba() {
        let gold = ([0.143036, 0.375307, 1.442045], [3.982997, 2.385556, 1.603359]);
        let copper = ([0.201005, 0.923750, 1.102215], [3.913262, 2.453045, 2.14209]);
        let aluminium = ([1.657501, 0.880405, 0.521244], [9.223811, 6.269502, 4.837004]);
        for (name, (eta, k)) in [("Au", gold), ("Cu", copper), ("Al", aluminium)] {
            let (ours, ours_k) = conductor(name).expect(name);
            for (a, b) in ours.iter().chain(&ours_k).zip(eta.iter().chain(&k)) {
                assert!((a - b).abs() < 1e-5 * b, "{name}: {a} against {b}");
            }
        }
    }
}
