//! Leaves: up to eight triangles in structure-of-arrays layout, tested all at once.
#![allow(unsafe_code)] // loads from raw lanes; CPU features are promised by the caller

use super::lanes::{Lanes, WIDTH, splat3};
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
    #[inline(always)]
    pub(super) fn vertices(&self, lane: usize) -> [[f32; 3]; 3] {
        let [x, y, z] = &self.coordinates;
        [
            [x[0][lane], y[0][lane], z[0][lane]],
            [x[1][lane], y[1][lane], z[1][lane]],
            [x[2][lane], y[2][lane], z[2][lane]],
        ]
    }
}

/// A sheared ray, one copy per lane.
pub(super) struct LeafRay<L> {
    shear: Shear,
    scale: [L; 3],
    origin: [L; 3],
    zero: L,
}

impl<L: Lanes> LeafRay<L> {
    /// # Safety
    /// The CPU must support `L`.
    #[inline(always)]
    pub(super) unsafe fn new(shear: Shear) -> Self {
        // SAFETY: the caller promises the CPU.
        unsafe {
            Self { scale: splat3(shear.scale), origin: splat3(shear.origin), zero: L::splat(0.0), shear }
        }
    }

    /// One vertex of all lanes: sheared x and y, scaled z.
    #[inline(always)]
    fn apply(&self, leaf: &Leaf, vertex: usize) -> [L; 3] {
        let [kx, ky, kz] = self.shear.axes;
        // SAFETY: axes are below 3 and `vertex` too; `self` holds values of `L`, which prove the CPU.
        let load = |axis: usize| unsafe {
            L::load(leaf.coordinates.get_unchecked(axis).get_unchecked(vertex).as_ptr())
        };
        let z = load(kz).sub(self.origin[2]);
        let x = load(kx).sub(self.origin[0]).sub(self.scale[0].mul(z));
        let y = load(ky).sub(self.origin[1]).sub(self.scale[1].mul(z));
        [x, y, z]
    }

    /// The lanes hit at `0 < t <= t_max`.
    #[inline(always)]
    pub(super) fn test(&self, leaf: &Leaf, t_max: L) -> LaneHits<L> {
        let a = self.apply(leaf, 0);
        let b = self.apply(leaf, 1);
        let c = self.apply(leaf, 2);
        let u = c[0].mul(b[1]).sub(c[1].mul(b[0]));
        let v = a[0].mul(c[1]).sub(a[1].mul(c[0]));
        let w = b[0].mul(a[1]).sub(b[1].mul(a[0]));
        // Edges are inclusive. A zero may stand for a tiny value of either sign, but a lane that fails here has two edge
        // functions of certainly opposite sign, so only lanes that pass need the exact test.
        let lowest = u.min(v).min(w);
        let highest = u.max(v).max(w);
        let inside = self.zero.le(lowest) | highest.le(self.zero);
        if inside == 0 {
            return LaneHits { mask: 0, t: u, v, w, determinant: u };
        }
        let zeros = u.eq(self.zero) | v.eq(self.zero) | w.eq(self.zero);
        if inside & zeros != 0 {
            return self.exact(leaf, inside, t_max);
        }
        let scale = self.scale[2];
        let determinant = u.add(v).add(w);
        let depth = u.mul(scale.mul(a[2])).add(v.mul(scale.mul(b[2]))).add(w.mul(scale.mul(c[2])));
        let t = depth.div(determinant);
        LaneHits { mask: inside & t.gt(self.zero) & t.le(t_max), t, v, w, determinant }
    }

    /// The same, one triangle at a time with exact signs.
    #[cold]
    #[inline(never)]
    fn exact(&self, leaf: &Leaf, lanes: u32, t_max: L) -> LaneHits<L> {
        let (mut mask, mut rows) = (0, [[0.0; WIDTH]; 4]);
        let t_max = t_max.to_array()[0];
        for lane in 0..WIDTH {
            if lanes >> lane & 1 == 1
                && let Some(meeting) = self.shear.meet(leaf.vertices(lane))
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
        // SAFETY: `self` holds values of `L`, which prove the CPU; each row has all lanes.
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
