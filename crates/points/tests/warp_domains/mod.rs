//! An example of every warp with the domain it leads to, in coordinates that have nothing to do with the warp.

use std::f64::consts::PI;

use evenlight_points::warp::{self, Options};

/// Coordinates of a domain: a cube, the points of its places and their Jacobian, and back.
pub(crate) struct Domain {
    pub(crate) dims: usize,
    pub(crate) point: fn(&[f64]) -> (Vec<f64>, f64),
    pub(crate) place: fn(&[f64]) -> Vec<f64>,
}

/// The options and domains that a warp is tried with.
pub(crate) fn examples(name: &str) -> Vec<(Options, Domain)> {
    let none = Options::default;
    let plain = |domain| vec![(Options::default(), domain)];
    let in_dims = |dims, domain| (Options { dims: Some(dims), ..none() }, domain);
    let values = |values: &[f64]| Options { values: Some(values.to_vec()), ..none() };
    match name {
        _ if name.starts_with("triangle_") => plain(TRIANGLE),
        "hilbert" | "morton" | "gray" => vec![in_dims(2, CUBE_2), in_dims(3, CUBE_3)],
        "disk_polar" | "disk_concentric" => plain(DISK),
        "hemisphere_uniform" | "hemisphere_cosine" => plain(HEMISPHERE),
        "sphere" => plain(SPHERE),
        "cap" => vec![
            (Options { angle: Some(0.8), ..none() }, CAP),
            (Options { angle: Some(PI), ..none() }, SPHERE),
        ],
        "ball" => plain(BALL),
        "simplex" => vec![in_dims(1, SEGMENT), in_dims(2, TRIANGLE), in_dims(3, TETRAHEDRON)],
        "cylinder" => {
            vec![(Options { radius: Some(2.0), height: Some(3.0), ..none() }, CYLINDER)]
        }
        "torus" => vec![(Options { radius: Some(2.0), tube: Some(0.75), ..none() }, TORUS)],
        "spherical_triangle" => vec![
            (Options { corners: Some(CORNERS.to_vec()), ..none() }, SEEN_TRIANGLE),
            (Options { corners: Some(vec![CORNERS[2], CORNERS[1], CORNERS[0]]), ..none() }, SEEN_TRIANGLE),
        ],
        "spherical_rectangle" => {
            vec![(Options { corners: Some(RECTANGLE.to_vec()), ..none() }, SEEN_RECTANGLE)]
        }
        "gaussian" => plain(LINE),
        "piecewise_linear" => vec![
            (values(&[0.5, 2.0, 1.0, 0.0, 3.0]), CUBE_1),
            (Options { knots: Some(vec![0.0, 0.125, 0.75, 1.0]), ..values(&[1.0, 4.0, 0.5, 0.25]) }, CUBE_1),
        ],
        "piecewise_constant" => vec![
            (values(&[1.0, 0.0, 5.0, 2.0]), CUBE_1),
            (Options { knots: Some(vec![0.0, 0.125, 0.75, 1.0]), ..values(&[1.0, 4.0, 0.5]) }, CUBE_1),
        ],
        "discrete" | "discrete_alias" => vec![(values(&[3.0, 0.0, 1.0, 2.5, 0.25]), CHOICES)],
        "image" => {
            let pixels = [
                0.0, 1.0, 2.0, 0.5, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.25, 1.0, 3.0, 2.0, 0.0, 0.0, 1.0, 1.0,
                1.0, 1.0,
            ];
            vec![(Options { columns: Some(4), ..values(&pixels) }, CUBE_2)]
        }
        _ => panic!("the warp '{name}' has no example here"),
    }
}

const CUBE_1: Domain = Domain { dims: 1, ..CUBE_3 };
const CUBE_2: Domain = Domain { dims: 2, ..CUBE_3 };
const CUBE_3: Domain = Domain { dims: 3, point: |s| (s.to_vec(), 1.0), place: |x| x.to_vec() };

/// Barycentric coordinates, measured by all but the first.
const SEGMENT: Domain = Domain { dims: 1, point: |s| (vec![1.0 - s[0], s[0]], 1.0), place: |x| vec![x[1]] };

const TRIANGLE: Domain = Domain {
    dims: 2,
    point: |s| {
        let (b, c) = (s[0], s[1] * (1.0 - s[0]));
        (vec![1.0 - b - c, b, c], 1.0 - s[0])
    },
    place: |x| vec![x[1], x[2] / (x[0] + x[2]).max(1e-300)],
};

const TETRAHEDRON: Domain = Domain {
    dims: 3,
    point: |s| {
        let (b, c) = (s[0], s[1] * (1.0 - s[0]));
        let d = s[2] * (1.0 - b - c);
        (vec![1.0 - b - c - d, b, c, d], (1.0 - b) * (1.0 - b - c))
    },
    place: |x| vec![x[1], x[2] / (1.0 - x[1]).max(1e-300), x[3] / (x[0] + x[3]).max(1e-300)],
};

fn turns(y: f64, x: f64) -> f64 {
    (y.atan2(x) / (2.0 * PI)).rem_euclid(1.0)
}

/// Radius and angle.
const DISK: Domain = Domain {
    dims: 2,
    point: |s| {
        let (sin, cos) = (2.0 * PI * s[1]).sin_cos();
        (vec![s[0] * cos, s[0] * sin], 2.0 * PI * s[0])
    },
    place: |x| vec![x[0].hypot(x[1]), turns(x[1], x[0])],
};

/// The direction at an angle from the pole, and the Jacobian of both angles.
fn polar(theta: f64, most: f64, around: f64) -> (Vec<f64>, f64) {
    let (sin, cos) = (2.0 * PI * around).sin_cos();
    (vec![theta.sin() * cos, theta.sin() * sin, theta.cos()], 2.0 * PI * most * theta.sin())
}

fn angles(x: &[f64], most: f64) -> Vec<f64> {
    vec![x[0].hypot(x[1]).atan2(x[2]) / most, turns(x[1], x[0])]
}

const SPHERE: Domain = Domain { dims: 2, point: |s| polar(PI * s[0], PI, s[1]), place: |x| angles(x, PI) };
const HEMISPHERE: Domain =
    Domain { dims: 2, point: |s| polar(0.5 * PI * s[0], 0.5 * PI, s[1]), place: |x| angles(x, 0.5 * PI) };
const CAP: Domain = Domain { dims: 2, point: |s| polar(0.8 * s[0], 0.8, s[1]), place: |x| angles(x, 0.8) };

const BALL: Domain = Domain {
    dims: 3,
    point: |s| {
        let (direction, jacobian) = polar(PI * s[1], PI, s[2]);
        (direction.into_iter().map(|x| s[0] * x).collect(), jacobian * s[0] * s[0])
    },
    place: |x| {
        let around = angles(x, PI);
        vec![x[0].hypot(x[1]).hypot(x[2]), around[0], around[1]]
    },
};

const CYLINDER: Domain = Domain {
    dims: 2,
    point: |s| {
        let (sin, cos) = (2.0 * PI * s[0]).sin_cos();
        (vec![2.0 * cos, 2.0 * sin, 3.0 * s[1]], 12.0 * PI)
    },
    place: |x| vec![turns(x[1], x[0]), x[2] / 3.0],
};

const TORUS: Domain = Domain {
    dims: 2,
    point: |s| {
        let ((sin, cos), (rise, out)) = ((2.0 * PI * s[0]).sin_cos(), (2.0 * PI * s[1]).sin_cos());
        let ring = 2.0 + 0.75 * out;
        (vec![ring * cos, ring * sin, 0.75 * rise], 4.0 * PI * PI * 0.75 * ring)
    },
    place: |x| vec![turns(x[1], x[0]), turns(x[2], x[0].hypot(x[1]) - 2.0)],
};

const CORNERS: [[f64; 3]; 3] = [[1.0, 0.2, 0.3], [-0.5, 1.5, 0.4], [0.1, -0.3, 1.0]];
const RECTANGLE: [[f64; 3]; 3] = [[-0.5, 0.25, 0.75], [1.5, 0.25, 0.75], [-0.5, 1.75, 0.75]];

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Of a point of a plane with this area: the direction, and its solid angle for a unit of the coordinates.
fn seen(x: [f64; 3], area: [f64; 3]) -> (Vec<f64>, f64) {
    let distance = dot(x, x).sqrt();
    (x.map(|x| x / distance).to_vec(), dot(x, area).abs() / distance.powi(3))
}

/// Where a ray meets a plane through a corner with two edges, in units of the edges (Cramer's rule).
fn met(x: &[f64], corner: [f64; 3], edges: [[f64; 3]; 2]) -> [f64; 2] {
    let x = [x[0], x[1], x[2]];
    let whole = dot(x, cross(edges[0], edges[1]));
    // corner + s e + t f is parallel to x
    [dot(x, cross(edges[1], corner)) / whole, dot(x, cross(corner, edges[0])) / whole]
}

fn edges(corners: [[f64; 3]; 3]) -> [[f64; 3]; 2] {
    [1, 2].map(|end| std::array::from_fn(|k| corners[end][k] - corners[0][k]))
}

/// The plane triangle through the corners.
const SEEN_TRIANGLE: Domain = Domain {
    dims: 2,
    point: |s| {
        let ([e, f], t) = (edges(CORNERS), s[1] * (1.0 - s[0]));
        let x = std::array::from_fn(|k| CORNERS[0][k] + s[0] * e[k] + t * f[k]);
        let (direction, jacobian) = seen(x, cross(e, f));
        (direction, jacobian * (1.0 - s[0]))
    },
    place: |x| {
        let [s, t] = met(x, CORNERS[0], edges(CORNERS));
        vec![s, t / (1.0 - s).max(1e-300)]
    },
};

const SEEN_RECTANGLE: Domain = Domain {
    dims: 2,
    point: |s| {
        let [e, f] = edges(RECTANGLE);
        seen(std::array::from_fn(|k| RECTANGLE[0][k] + s[0] * e[k] + s[1] * f[k]), cross(e, f))
    },
    place: |x| met(x, RECTANGLE[0], edges(RECTANGLE)).to_vec(),
};

/// All real numbers, by the logistic function.
const LINE: Domain = Domain {
    dims: 1,
    point: |s| (vec![(s[0] / (1.0 - s[0])).ln()], 1.0 / (s[0] * (1.0 - s[0]))),
    place: |x| vec![1.0 / (1.0 + (-x[0]).exp())],
};

/// One of five choices and what is left of a number, which has density 1, end to end.
const CHOICES: Domain = Domain {
    dims: 1,
    point: |s| (vec![(5.0 * s[0]).floor(), (5.0 * s[0]).fract()], 5.0),
    place: |x| vec![(x[0] + x[1]) / 5.0],
};

/// All warps with their examples.
pub(crate) fn all() -> impl Iterator<Item = (&'static warp::Entry, Options, Domain)> {
    warp::ALL.iter().flat_map(|&entry| {
        examples(entry.name).into_iter().map(move |(options, domain)| (entry, options, domain))
    })
}
