//! The numbers that drive a light path: a point in a hypercube of unbounded dimension.
//!
//! Every number is a pure function of (seed, replicate, pixel, sample index, dimension). A path reads them by the vertex
//! ([`BounceNumbers`]); they are computed sixteen dimensions at a time, because one by one they would cost a fifth of a frame.
//!
//! Each replicate is an independent randomization of the same construction, and each has its own small set of
//! sample indices `0..spp/replicates`: the spread of replicate means is an honest error, while the spread of single samples
//! is not, as they are correlated on purpose.

use evenlight_points::Seed;

use crate::{Error, Result};

pub mod halton;
pub mod independent;
pub mod sobol;
pub mod zsobol;

/// How many dimensions are computed at a time.
pub const BLOCK: usize = 16;

/// Dimensions of one path vertex. The first four are the pair that leaves the vertex and the pair that chooses the point on a light as seen
/// from the next one: what is lit depends on both at once. Then come its other needs.
const VERTEX: usize = 8;

/// One sampler of the registry.
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// Where it was published.
    pub cite: &'static str,
    /// The number of samples per pixel and replicate should be a multiple of a power of this number.
    pub base: Option<u32>,
    /// What has a randomization of its own.
    pub sharing: Sharing,
    /// Dimensions `block * BLOCK ..` of sample `index`; `key` stands for seed, replicate and, unless shared, pixel.
    pub fill: fn(key: Seed, index: u32, block: u32, out: &mut [f32; BLOCK]),
}

/// What has a randomization of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Every pixel: what is random in one tells nothing of the others.
    Pixel,
    /// Every replicate of the image: its pixels have parts of one sequence, in the order of the Morton curve.
    Image,
}

impl Entry {
    /// The key and the index of the first of a pixel's samples.
    #[inline]
    pub fn pixel(&self, replicate: Seed, [x, y]: [u32; 2], samples: u32) -> (Seed, u32) {
        match self.sharing {
            Sharing::Pixel => (replicate.pixel(x, y), 0),
            Sharing::Image => {
                let place = u64::from(spaced(x)) | u64::from(spaced(y)) << 1;
                (replicate, (place * u64::from(samples.next_power_of_two())) as u32)
            }
        }
    }

    /// An error if the pixels of a film would share samples that are to be different.
    pub fn check(&self, size: [u32; 2], samples: u32) -> Result<()> {
        let side = u64::from(size[0].max(size[1]).next_power_of_two());
        let needed = side * side * u64::from(samples.next_power_of_two());
        if self.sharing == Sharing::Image && needed > 1 << 32 {
            let name = self.name;
            let message = format!(
                "sampler '{name}' has 2^32 samples for a square of pixels whose side is a power of 2; {} x {} pixels \
                 with {samples} samples in each replicate would need {needed}",
                size[0], size[1]
            );
            return Err(Error::Settings(message));
        }
        Ok(())
    }
}

/// The lower half of the bits, with a 0 between any two.
fn spaced(x: u32) -> u32 {
    [(8, 0x00ff_00ff), (4, 0x0f0f_0f0f), (2, 0x3333_3333), (1, 0x5555_5555)]
        .into_iter()
        .fold(x & 0xffff, |x, (shift, mask)| (x | x << shift) & mask)
}

/// The samplers there are.
pub static ALL: &[Entry] = &[independent::ENTRY, sobol::ENTRY, halton::ENTRY, zsobol::ENTRY];

/// A sampler by name.
pub fn by_name(name: &str) -> Result<&'static Entry> {
    ALL.iter().find(|entry| entry.name == name).ok_or_else(|| {
        let known = ALL.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ");
        Error::Settings(format!("unknown sampler '{name}'; known: {known}"))
    })
}

/// Increment and finalizer of `SplitMix64` (Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators").
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

#[inline]
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// 24 random bits as a number in [0, 1).
#[inline(always)]
pub(crate) fn unit_f32(word: u32) -> f32 {
    (word >> 8) as i32 as f32 * (1.0 / 16_777_216.0)
}

/// What the camera needs.
#[derive(Clone, Copy, Debug)]
pub struct CameraNumbers {
    /// The point within the pixel's filter.
    pub film: [f32; 2],
    /// The point on the lens.
    pub lens: [f32; 2],
}

/// What one vertex of a path needs.
#[derive(Clone, Copy, Debug)]
pub struct BounceNumbers {
    /// The scattered direction.
    pub bsdf: [f32; 2],
    /// The point on the chosen light.
    pub light: [f32; 2],
    /// Which light.
    pub light_choice: f32,
    /// Which lobe of the BSDF.
    pub lobe: f32,
    /// Whether the path survives.
    pub roulette: f32,
}

/// All numbers of one light path; a small cache is its only state.
pub struct PathNumbers {
    fill: fn(Seed, u32, u32, &mut [f32; BLOCK]),
    key: Seed,
    index: u32,
    block: u32,
    numbers: [f32; BLOCK],
}

impl PathNumbers {
    /// The numbers of sample 0 of the pixel that `key` stands for.
    pub fn new(sampler: &Entry, key: Seed) -> Self {
        Self { fill: sampler.fill, key, index: 0, block: u32::MAX, numbers: [0.0; BLOCK] }
    }

    /// Go to another sample of the pixel.
    pub fn start(&mut self, index: u32) {
        self.index = index;
        self.block = u32::MAX;
    }

    /// Eight numbers of a vertex; vertex 0 is the camera.
    #[inline]
    fn vertex(&mut self, vertex: u32) -> &[f32; VERTEX] {
        let block = vertex / (BLOCK / VERTEX) as u32;
        if block != self.block {
            (self.fill)(self.key, self.index, block, &mut self.numbers);
            self.block = block;
        }
        let halves = self.numbers.as_chunks::<VERTEX>().0;
        &halves[vertex as usize % (BLOCK / VERTEX)]
    }

    /// The numbers of the camera.
    #[inline]
    pub fn camera(&mut self) -> CameraNumbers {
        let n = self.vertex(0);
        CameraNumbers { film: [n[0], n[1]], lens: [n[4], n[5]] }
    }

    /// The numbers of a surface vertex; `depth` 0 is the first.
    #[inline]
    pub fn bounce(&mut self, depth: u32) -> BounceNumbers {
        let n = self.vertex(depth);
        let (light, light_choice) = ([n[2], n[3]], n[6]);
        let n = self.vertex(depth + 1);
        BounceNumbers { bsdf: [n[0], n[1]], light, light_choice, lobe: n[4], roulette: n[5] }
    }
}
