//! The engine of sequences in any base: generating matrices or radical inverses in, randomized points out.
//!
//! An index is split into `high · rows + low`, where `rows` is a power of the base, at most 4096. In a block of rows with the
//! same high digits the first digits of a coordinate run through all their values, of which each axis has a table: already
//! randomized, since no digit is randomized according to later ones. What remains for a block are the high digits, which
//! are the same for all of its rows:
//!
//! * `digitwise`: one addend;
//! * `linear`: one comparison for each digit;
//! * `nested`: two hashes for each high digit that is not 0.
//!
//! Coordinates are made along the axes, in vectors, and then brought to their rows. All arithmetic is that of integers, so
//! one coordinate alone has the same bits. The digital nets of base 2 have [`digital_net`](crate::digital_net).

mod axis;
mod digitwise;
mod generator;
mod linear;
mod nested;
mod permutations;
mod places;
mod prefixes;
mod rows;

use std::ops::Range;
use std::sync::Arc;

pub(crate) use self::axis::Coordinate;
use self::axis::{Axis, Scratch, Walk};
use self::generator::Generator;
use self::places::Places;
use self::rows::{AXES, interleave, past_caches};
use crate::convert::unit_f64;
use crate::point_set::check_length;
use crate::scramble::Randomization;
use crate::streaming::{self, Stream};
use crate::{PointSet, Seed};

/// Rows that are made at a time.
const LANES: usize = 64;

/// Coordinates of rows that wait to be written past the caches: half of a first-level cache.
const WAITING: usize = 2048;

impl Coordinate {
    /// The radical inverse in a base from 2 to 2^16.
    pub(crate) fn radical_inverse(base: u64) -> Arc<Self> {
        Arc::new(Self { places: Places::new(base, 1), generator: Generator::Identity })
    }

    /// A generating matrix over the integers modulo a prime below 2^16, by its entries (row, column), in which no row depends
    /// on columns before the last multiple of `group` up to its number.
    pub(crate) fn matrix(base: u64, group: usize, entry: impl FnMut(usize, usize) -> u64) -> Arc<Self> {
        let places = Places::new(base, group);
        let generator = Generator::from_entries(&places, entry);
        Arc::new(Self { places, generator })
    }
}

/// The coordinate i / n of a finite set, scrambled in base 2.
#[derive(Clone, Debug)]
struct Even {
    n: u64,
    /// 2^128 / n, rounded up.
    step: u128,
    apply: fn(u64, Seed) -> u64,
    key: Seed,
}

impl Even {
    fn new(n: u64, randomization: Randomization, key: Seed) -> Self {
        Self {
            n,
            step: (u128::MAX / u128::from(n)).saturating_add(1),
            apply: randomization.entry().apply,
            key,
        }
    }

    fn coord(&self, index: u64) -> f64 {
        // Rounding `step` up adds less than n^2 / 2^64 · (1 / n), too little to reach the next multiple.
        unit_f64((self.apply)(((u128::from(index) * self.step) >> 64) as u64, self.key))
    }
}

/// A sequence in any base, randomized.
#[derive(Debug)]
pub(crate) struct RadixNet {
    randomization: Randomization,
    /// The base in whose powers points are balanced, if it is one.
    base: Option<u64>,
    /// The coordinate before those of the axes, for finite sets.
    even: Option<Even>,
    axes: Vec<Axis>,
}

impl RadixNet {
    /// The sequence of these coordinates.
    pub(crate) fn new(coordinates: &[Arc<Coordinate>], randomization: Randomization, seed: Seed) -> Self {
        let keyed = coordinates.iter().zip(0..);
        let axis = |(coordinate, dim): (&Arc<_>, _)| {
            Axis::new(Arc::clone(coordinate), randomization, seed.dimension(dim))
        };
        Self { randomization, base: None, even: None, axes: keyed.map(axis).collect() }
    }

    /// The same, with the base in whose powers its points are balanced.
    pub(crate) fn balanced_in(self, base: u64) -> Self {
        Self { base: Some(base), ..self }
    }

    /// The first n rows of `sequence` after a coordinate i / n.
    pub(crate) fn finite(
        n: u64,
        coordinates: &[Arc<Coordinate>],
        randomization: Randomization,
        seed: Seed,
    ) -> Self {
        let even = Even::new(n, randomization, seed.dimension(0));
        let keyed = coordinates.iter().zip(1..);
        let axis = |(coordinate, dim): (&Arc<_>, _)| {
            Axis::new(Arc::clone(coordinate), randomization, seed.dimension(dim))
        };
        Self { randomization, base: None, even: Some(even), axes: keyed.map(axis).collect() }
    }

    /// Rows that are made together.
    fn height(&self) -> usize {
        (WAITING / self.dims()).clamp(8, LANES)
    }

    /// Makes rows a part at a time.
    fn for_each_part(&self, rows: Range<u64>, mut write: impl FnMut(&mut Maker<'_>, Range<u64>)) {
        let count = rows.end.saturating_sub(rows.start);
        let mut maker = Maker {
            even: self.even.as_ref(),
            walks: self.axes.iter().map(|axis| axis.walk(rows.start, count)).collect(),
            scratch: Scratch::of(LANES),
            columns: Box::new([[0.0; LANES]; AXES]),
        };
        let mut start = rows.start;
        while start < rows.end {
            let end = rows.end.min(start.saturating_add(self.height() as u64));
            write(&mut maker, start..end);
            start = end;
        }
    }
}

/// Walks along all axes.
struct Maker<'a> {
    even: Option<&'a Even>,
    walks: Vec<Walk<'a>>,
    scratch: Scratch,
    columns: Box<rows::Columns>,
}

impl Maker<'_> {
    /// Writes the next rows.
    fn write(&mut self, rows: Range<u64>, out: &mut [f64]) {
        let (count, mut first) = ((rows.end - rows.start) as usize, 0);
        let dims = out.len() / count;
        let Self { even, walks, scratch, columns } = self;
        let mut walks = walks.iter_mut();
        while first < dims {
            for (axis, column) in columns.iter_mut().enumerate().take(dims - first) {
                let column = &mut column[..count];
                match even {
                    Some(even) if first + axis == 0 => {
                        column.iter_mut().zip(rows.clone()).for_each(|(x, index)| *x = even.coord(index));
                    }
                    _ => walks.next().expect("one for each other axis").write(scratch, column),
                }
            }
            interleave(columns, first, dims, out);
            first += AXES;
        }
    }
}

impl PointSet for RadixNet {
    fn dims(&self) -> usize {
        self.axes.len() + usize::from(self.even.is_some())
    }

    fn len(&self) -> Option<u64> {
        self.even.as_ref().map(|even| even.n)
    }

    fn base(&self) -> Option<u64> {
        self.base
    }

    fn reseeded(&self, seed: Seed) -> Box<dyn PointSet> {
        let even = self.even.as_ref().map(|even| Even::new(even.n, self.randomization, seed.dimension(0)));
        let keys = (even.iter().count() as u64..).map(|dim| seed.dimension(dim));
        let axes =
            self.axes.iter().zip(keys).map(|(axis, key)| axis.reseeded(self.randomization, key)).collect();
        Box::new(Self { even, axes, ..*self })
    }

    fn coord(&self, index: u64, dim: usize) -> f64 {
        match &self.even {
            Some(even) if dim == 0 => even.coord(index),
            Some(_) => self.axes[dim - 1].coord(index),
            None => self.axes[dim].coord(index),
        }
    }

    fn fill(&self, rows: Range<u64>, out: &mut [f64]) {
        let dims = self.dims();
        check_length(&rows, dims, out.len());
        if streaming::pays(out) {
            let mut out = Stream::new(out);
            let mut waiting = vec![0.0; self.height() * dims];
            self.for_each_part(rows, |maker, rows| {
                let waiting = &mut waiting[..(rows.end - rows.start) as usize * dims];
                maker.write(rows, waiting);
                past_caches(waiting, &mut out);
            });
        } else {
            let mut rest = out;
            self.for_each_part(rows, |maker, rows| {
                let places = (rows.end - rows.start) as usize * dims;
                let (part, later) = std::mem::take(&mut rest).split_at_mut(places);
                maker.write(rows, part);
                rest = later;
            });
        }
    }
}
