//! Blue noise: points that keep their distance without any grid, and what images are dithered with.
//!
//! The members of the family make points of the torus [0, 1)^d, for use at once or as a sequence: of a *progressive* one every
//! beginning is as well spread as a set of its own. Each says what its effort is counted in. Besides the family there are
//!
//! * [`void_and_cluster`]: dither masks, which are orders of the pixels of a torus;
//! * [`vector_mask`]: masks of several channels, for what depends on all of them together;
//! * [`pixel_order`]: the places of pixels in one sequence for a whole image, so that errors are blue on the screen.
//!
//! All is a function of the seed: the same bits with any number of threads.
//!
//! To add one, write its file with an `ENTRY`, declare it here and put it in [`ALL`].

mod decay;
pub mod gaussian;
pub mod pixel_order;
pub mod poisson_disk;
pub mod sample_elimination;
mod torus;
pub mod vector_mask;
pub mod void_and_cluster;

use std::num::NonZeroUsize;

use crate::convert::unit_f64;
use crate::seed::counted;
use crate::warp::curve::sort::{Frame, order};
use crate::warp::curve::{Grid, named};
use crate::{Error, Seed};

/// The most dimensions.
pub const MOST_DIMS: usize = 8;

/// The most points, tried ones included.
pub const MOST_POINTS: u64 = 1 << 31;

/// Points that are asked for.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// How many.
    pub n: usize,
    /// The coordinates of each, 1 to [`MOST_DIMS`].
    pub dims: usize,
    /// How much work is spent on each, in the unit of the member; at least 1.
    pub effort: u32,
    /// What they are a function of.
    pub seed: Seed,
    /// Threads at most, where threads help.
    pub workers: NonZeroUsize,
}

/// What a member says about itself.
#[derive(Debug)]
pub struct Entry {
    /// Its name everywhere.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// Whether every beginning of the list is well spread.
    pub progressive: bool,
    /// What effort is counted in, and how much is usual.
    pub effort: (&'static str, u32),
    /// Row-major points.
    points: fn(&Request) -> Vec<f64>,
}

/// All members.
pub static ALL: &[&Entry] = &[&poisson_disk::ENTRY, &sample_elimination::ENTRY, &gaussian::ENTRY];

/// Makes points, row by row.
///
/// ```
/// use evenlight_points::{Seed, blue_noise::{self, Request}};
/// let request = Request { n: 100, dims: 2, effort: 16, seed: Seed::new(7), workers: std::num::NonZero::<usize>::MIN };
/// let points = blue_noise::points("poisson_disk", &request)?;
/// let ten = blue_noise::points("poisson_disk", &Request { n: 10, ..request })?;
/// assert_eq!(points[..20], ten);
/// # Ok::<(), evenlight_points::Error>(())
/// ```
///
/// # Errors
/// If the name is unknown, or the request not as its fields say.
pub fn points(name: &str, request: &Request) -> Result<Vec<f64>, Error> {
    let entry = ALL.iter().find(|entry| entry.name == name).ok_or_else(|| {
        let known = ALL.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ");
        Error::BlueNoise(format!("unknown blue noise '{name}'; known: {known}"))
    })?;
    if !(1..=MOST_DIMS).contains(&request.dims) {
        let asked = request.dims;
        return Err(Error::BlueNoise(format!("blue noise has 1 to {MOST_DIMS} dimensions, not {asked}")));
    }
    if request.effort == 0 {
        return Err(Error::BlueNoise(format!("{} must be at least 1, not 0", entry.effort.0)));
    }
    if request.n as u64 > MOST_POINTS / u64::from(request.effort) {
        let (unit, effort) = (entry.effort.0, request.effort);
        return Err(Error::BlueNoise(format!(
            "points times {unit} must be at most {MOST_POINTS}, not {} times {effort}",
            request.n
        )));
    }
    Ok((entry.points)(request))
}

/// Independent points along the Morton curve, so that those near each other are near in memory.
fn cloud(request: &Request, count: usize) -> Vec<f64> {
    let dims = request.dims;
    let x: Vec<f64> = uniform(request.seed, 0..(count * dims) as u64).collect();
    let (curve, grid) = (named("morton").expect("a curve"), Grid::finest(dims));
    let frame = Frame::new(grid, &vec![0.0; dims], &vec![1.0; dims]);
    let places = order(curve, grid, &frame, &x, request.workers);
    places.into_iter().flat_map(|place| &x[place as usize * dims..][..dims]).copied().collect()
}

/// Independent uniform numbers, each a function of its place.
fn uniform(seed: Seed, places: std::ops::Range<u64>) -> impl Iterator<Item = f64> {
    let keys = [seed.split(0, 0).bits64(), seed.split(0, 1).bits64()];
    places.map(move |place| unit_f64(counted(place, keys[0], keys[1])))
}
