//! Leaves: up to eight triangles in structure-of-arrays layout, tested all at once.
#![allow(unsafe_code)] // loads from raw lanes; CPU features are promised by the caller

use super::lanes::{Lanes, WIDTH};
use super::triangle::{Meeting, Shear};

/// Up to [`WIDTH`] triangles. Empty lanes are NaN, which no comparison lets through.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Leaf {
    /// `coordinates[axis][vertex][lane]`: the axis comes first because a ray permutes the axes.
    coordinates: [[[f32; WIDTH]; 3]; 3],
    /// Indices into the list of triangles.
    pub(super) triangles: [u32; WIDTH],
}

impl Leaf {
    /// At most [`WIDTH`] triangles: index and vertices.
    pub(super) fn new(triangles: impl Iterator<Item = (u32, [[f32; 3]; 3])>) -> Self {
        let mut leaf = Self { coordinates: [[[f32::NAN; WIDTH]; 3]; 3], triangles: [u32::MAX; WIDTH] };
        for (lane, (index, vertices)) in triangles.enumerate() {
            leaf.triangles[lane] = index;
            for (vertex, position) in vertices.iter().enumerate() {
                for (axis, &coordinate) in position.iter().enumerate() {
                    leaf.coordinates[axis][vertex][lane] = coordinate;
                }
            }
        }
        leaf
    }

    /// The vertices of one triangle.
    pub(super) fn vertices(&self, lane: usize) -> [[f32; 3]; 3] {
        let [x, y, z] = &self.coordinates;
        [
            [x[0][lane], y[0][lane], z[0][lane]],
            [x[1][lane], y[1][lane], z[1][lane]],
            [x[2][lane], y[2][lane], z[2][lane]],
        ]
    }
}

impl Shear {
    /// One vertex of all lanes, as the scalar form does it.
    ///
    /// # Safety
    /// The CPU must support `L`.
    #[inline(always)]
    unsafe fn apply_lanes<L: Lanes>(&self, leaf: &Leaf, vertex: usize) -> [L; 3] {
        let [kx, ky, kz] = self.axes;
        // SAFETY: axes are below 3 and `vertex` too; the caller promises the CPU.
        unsafe {
            let relative = |axis: usize, origin: f32| {
                let row = leaf.coordinates.get_unchecked(axis).get_unchecked(vertex);
                L::load(row.as_ptr()).sub(L::splat(origin))
            };
            let z = relative(kz, self.origin[2]);
            let x = relative(kx, self.origin[0]).sub(L::splat(self.scale[0]).mul(z));
            let y = relative(ky, self.origin[1]).sub(L::splat(self.scale[1]).mul(z));
            [x, y, z]
        }
    }

    /// The lanes hit at `0 < t <= t_max`.
    ///
    /// # Safety
    /// The CPU must support `L`.
    #[inline(always)]
    pub(super) unsafe fn test<L: Lanes>(&self, leaf: &Leaf, t_max: f32) -> LaneHits<L> {
        // SAFETY: the caller promises the CPU.
        let ([a, b, c], zero, t_max, scale) = unsafe {
            let vertices =
                [self.apply_lanes(leaf, 0), self.apply_lanes(leaf, 1), self.apply_lanes::<L>(leaf, 2)];
            (vertices, L::splat(0.0), L::splat(t_max), L::splat(self.scale[2]))
        };
        let u = c[0].mul(b[1]).sub(c[1].mul(b[0]));
        let v = a[0].mul(c[1]).sub(a[1].mul(c[0]));
        let w = b[0].mul(a[1]).sub(b[1].mul(a[0]));
        // Edges are inclusive. A zero may stand for a tiny value of either sign, but a lane that fails here has two edge
        // functions of certainly opposite sign, so only lanes that pass need the exact test.
        let lowest = u.min(v).min(w);
        let highest = u.max(v).max(w);
        let inside = zero.le(lowest) | highest.le(zero);
        if inside == 0 {
            return LaneHits { mask: 0, t: u, v, w, determinant: u };
        }
        let zeros = u.eq(zero) | v.eq(zero) | w.eq(zero);
        if inside & zeros != 0 {
            // SAFETY: the caller promises the CPU.
            return unsafe { self.exact(leaf, inside, t_max) };
        }
        let determinant = u.add(v).add(w);
        let depth = u.mul(scale.mul(a[2])).add(v.mul(scale.mul(b[2]))).add(w.mul(scale.mul(c[2])));
        let t = depth.div(determinant);
        LaneHits { mask: inside & t.gt(zero) & t.le(t_max), t, v, w, determinant }
    }

    /// The same, one triangle at a time with exact signs.
    ///
    /// # Safety
    /// The CPU must support `L`.
    #[cold]
    #[inline(never)]
    unsafe fn exact<L: Lanes>(&self, leaf: &Leaf, lanes: u32, t_max: L) -> LaneHits<L> {
        let (mut mask, mut rows) = (0, [[0.0; WIDTH]; 4]);
        let t_max = t_max.to_array()[0];
        for lane in 0..WIDTH {
            if lanes >> lane & 1 == 1
                && let Some(meeting) = self.meet(leaf.vertices(lane))
                && meeting.t > 0.0
                && meeting.t <= t_max
            {
                mask |= 1 << lane;
                let Meeting { t, v, w, determinant } = meeting;
                for (row, x) in rows.iter_mut().zip([t, v, w, determinant]) {
                    row[lane] = x;
                }
            }
        }
        // SAFETY: the caller promises the CPU; each row has all lanes.
        let load = |row: &[f32; WIDTH]| unsafe { L::load(row.as_ptr()) };
        let [t, v, w, determinant] = [load(&rows[0]), load(&rows[1]), load(&rows[2]), load(&rows[3])];
        LaneHits { mask, t, v, w, determinant }
    }
}

/// What a leaf test finds, lane by lane; only the lanes of `mask` mean anything.
pub(super) struct LaneHits<L> {
    pub(super) mask: u32,
    /// Ray parameter.
    pub(super) t: L,
    /// Edge functions: barycentric weights of the second and third vertex, times the determinant.
    pub(super) v: L,
    pub(super) w: L,
    pub(super) determinant: L,
}
