//! Optical constants of named materials.

/// Refractive index of a named dielectric.
pub fn dielectric_ior(name: &str) -> Option<f32> {
    Some(match name {
        "vacuum" => 1.0,
        "air" => 1.000277,
        "water" => 1.3330,
        "polypropylene" => 1.49,
        "bk7" => 1.5046,
        "diamond" => 2.419,
        _ => return None,
    })
}

/// Complex refractive index (`eta`, `k`) of a named conductor in linear RGB; `none` reflects everything.
pub fn conductor(name: &str) -> Option<([f32; 3], [f32; 3])> {
    Some(match name {
        "none" => ([0.0; 3], [1.0; 3]),
        "Au" => ([0.143036, 0.375307, 1.44205], [3.983, 2.38556, 1.60336]),
        "Cu" => ([0.200438, 0.924033, 1.102212], [3.912949, 2.452848, 2.142188]),
        "Al" => ([1.65746, 0.880369, 0.521229], [9.223869, 6.269523, 4.837001]),
        _ => return None,
    })
}
