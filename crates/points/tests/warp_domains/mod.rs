//! An example of every warp with the domain it leads to, in coordinates that have nothing to do with the warp.

use evenlight_points::warp::{self, Options};

/// Coordinates of a domain: a cube, the points of its places and their Jacobian, and back.
pub(crate) struct Domain {
    pub(crate) dims: usize,
    pub(crate) point: fn(&[f64]) -> (Vec<f64>, f64),
    pub(crate) place: fn(&[f64]) -> Vec<f64>,
}

/// The options and domains that a warp is tried with.
pub(crate) fn examples(name: &str) -> Vec<(Options, Domain)> {
    let plain = |domain| vec![(Options::default(), domain)];
    match name {
        _ if name.starts_with("triangle_") => plain(TRIANGLE),
        "hilbert" | "morton" | "gray" => vec![in_dims(2, CUBE_2), in_dims(3, CUBE_3)],
        _ => panic!("the warp '{name}' has no example here"),
    }
}

fn in_dims(dims: usize, domain: Domain) -> (Options, Domain) {
    (Options { dims: Some(dims), ..Options::default() }, domain)
}

const CUBE_2: Domain = Domain { dims: 2, ..CUBE_3 };

const CUBE_3: Domain = Domain { dims: 3, point: |s| (s.to_vec(), 1.0), place: |x| x.to_vec() };

/// Barycentric coordinates, measured by the second and the third.
const TRIANGLE: Domain = Domain {
    dims: 2,
    point: |s| {
        let (b, c) = (s[0], s[1] * (1.0 - s[0]));
        (vec![1.0 - b - c, b, c], 1.0 - s[0])
    },
    place: |x| vec![x[1], x[2] / (x[0] + x[2]).max(1e-300)],
};

/// All warps with their examples.
pub(crate) fn all() -> impl Iterator<Item = (&'static warp::Entry, Options, Domain)> {
    warp::ALL.iter().flat_map(|&entry| {
        examples(entry.name).into_iter().map(move |(options, domain)| (entry, options, domain))
    })
}
