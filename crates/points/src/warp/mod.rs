//! Warps: uniform numbers to where light needs them. One file, one warp, and their registry.
//!
//! A warp comes with its density and its inverse, so that laws can check it: `invert` undoes `map`, the density integrates to 1, and
//! mapped uniform numbers have that density. The renderer uses the types, in single precision; [`build`] makes them from plain
//! values, for arrays. What more than single points need is in [`triangle`] and [`curve`].
//!
//! To add one, write its file with an `ENTRY`, declare it here, put it in [`ALL`], and give `tests/warps` its domain.

pub mod ball;
pub mod cap;
pub mod curve;
pub mod cylinder;
pub mod discrete;
pub mod discrete_alias;
pub mod disk_concentric;
pub mod disk_polar;
pub mod gaussian;
mod gray;
pub mod hemisphere_cosine;
pub mod hemisphere_uniform;
mod hilbert;
pub mod image;
mod morton;
mod options;
pub mod piecewise_constant;
pub mod piecewise_linear;
mod quantile;
mod real;
mod round;
pub mod rows;
mod simplex;
pub mod sphere;
pub mod spherical_rectangle;
pub mod spherical_triangle;
mod steps;
pub mod torus;
pub mod triangle;
pub mod triangle_heitz;
pub mod triangle_mirror;
pub mod triangle_quaternary;
pub mod triangle_root;
pub mod triangle_sort;

pub use options::{Error, Options};
pub use real::{Real, sin_cos_turns};

use rows::{AnyRows, Fixed};

/// A map of `N` uniform numbers to points with a known density.
pub trait Warp<T: Real, const N: usize>: Send + Sync {
    /// Where it leads.
    type Point;

    /// The point of `N` numbers in [0, 1).
    fn map(&self, u: [T; N]) -> Self::Point;

    /// The density of mapped uniform numbers at a point: 0 where there are none.
    fn density(&self, x: &Self::Point) -> T;

    /// The numbers that lead to a point; where several do, some of them.
    fn invert(&self, x: &Self::Point) -> [T; N];
}

/// What a warp says about itself.
#[derive(Debug)]
pub struct Entry {
    /// Its name everywhere.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// The options it takes, by their names in [`Options`].
    pub takes: &'static [&'static str],
    /// Whether several places of the cube lead to one point, so that `invert` has to choose.
    pub folds: bool,
    /// Builds it, once [`build`] has checked what the registry can check.
    pub build: fn(&Options) -> Result<Box<dyn AnyRows>, Error>,
}

/// All warps.
pub static ALL: &[&Entry] = &[
    &triangle_root::ENTRY,
    &triangle_heitz::ENTRY,
    &triangle_mirror::ENTRY,
    &triangle_sort::ENTRY,
    &triangle_quaternary::ENTRY,
    &hilbert::ENTRY,
    &morton::ENTRY,
    &gray::ENTRY,
    &disk_polar::ENTRY,
    &disk_concentric::ENTRY,
    &hemisphere_uniform::ENTRY,
    &hemisphere_cosine::ENTRY,
    &sphere::ENTRY,
    &cap::ENTRY,
    &ball::ENTRY,
    &simplex::ENTRY,
    &cylinder::ENTRY,
    &torus::ENTRY,
    &spherical_triangle::ENTRY,
    &spherical_rectangle::ENTRY,
    &gaussian::ENTRY,
    &piecewise_linear::ENTRY,
    &piecewise_constant::ENTRY,
    &discrete::ENTRY,
    &discrete_alias::ENTRY,
    &image::ENTRY,
];

/// Builds a warp from plain values.
///
/// ```
/// use evenlight_points::warp::{self, Options};
/// let heitz = warp::build("triangle_heitz", &Options::default())?;
/// let mut x = [0.0; 3];
/// heitz.map(&[0.25, 0.75], &mut x);
/// assert_eq!(x, [0.125, 0.625, 0.25]);
/// # Ok::<(), warp::Error>(())
/// ```
///
/// # Errors
/// If the name is unknown, or an option is not taken or impossible.
pub fn build(name: &str, options: &Options) -> Result<Box<dyn AnyRows>, Error> {
    let entry = ALL.iter().find(|entry| entry.name == name).ok_or_else(|| Error::Unknown(name.into()))?;
    if let Some(option) = options.given().find(|option| !entry.takes.contains(option)) {
        return Err(Error::NotTaken { warp: entry.name, option, takes: entry.takes });
    }
    (entry.build)(options)
}
