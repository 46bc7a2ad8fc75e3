//! Leaves: a few triangles in structure-of-arrays layout, tested all at once.
#![allow(unsafe_code)] // loads from raw lanes; CPU features are promised by the caller

use super::lanes::{Lanes, splat3};
use super::triangle::Shear;

/// Triangles per leaf.
pub(super) const LEAF_WIDTH: usize = 4;

/// Up to [`LEAF_WIDTH`] triangles. Empty lanes are NaN, which no comparison lets through.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Leaf {
    /// `coordinates[axis][vertex][lane]`: the axis comes first because a ray permutes the axes.
    coordinates: [[[f32; LEAF_WIDTH]; 3]; 3],
    /// Indices into the list of triangles.
    pub(super) triangles: [u32; LEAF_WIDTH],
}

impl Leaf {
    /// At most [`LEAF_WIDTH`] triangles: index and vertices.
    pub(super) fn new(triangles: impl Iterator<Item = (u32, [[f32; 3]; 3])>) -> Self {
        let mut leaf =
            Self { coordinates: [[[f32::NAN; LEAF_WIDTH]; 3]; 3], triangles: [u32::MAX; LEAF_WIDTH] };
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
        [0, 1, 2].map(|vertex| [0, 1, 2].map(|axis| self.coordinates[axis][vertex][lane]))
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

    /// The lanes hit at `0 < t <= t_max`, and `t` in those lanes.
    #[inline(always)]
    pub(super) fn test(&self, leaf: &Leaf, t_max: L) -> (u32, L) {
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
            return (0, self.zero);
        }
        let determinant = u.add(v).add(w);
        let scale = self.scale[2];
        let depth = u.mul(scale.mul(a[2])).add(v.mul(scale.mul(b[2]))).add(w.mul(scale.mul(c[2])));
        let t = depth.div(determinant);
        // A zero determinant gives NaN or an infinity, which ends here.
        let hit = inside & t.gt(self.zero) & t.le(t_max);
        let zeros = u.eq(self.zero) | v.eq(self.zero) | w.eq(self.zero);
        if inside & zeros == 0 { (hit, t) } else { self.exact(leaf, inside, t_max) }
    }

    /// The same, one triangle at a time with exact signs.
    #[cold]
    #[inline(never)]
    fn exact(&self, leaf: &Leaf, lanes: u32, t_max: L) -> (u32, L) {
        let (mut hit, mut ts) = (0, [0.0; 8]);
        let t_max = t_max.to_array()[0];
        for lane in 0..L::WIDTH {
            if lanes >> lane & 1 == 1
                && let Some([t, _, _]) = self.shear.meet(leaf.vertices(lane))
                && t > 0.0
                && t <= t_max
            {
                hit |= 1 << lane;
                ts[lane] = t;
            }
        }
        // SAFETY: `self` holds values of `L`, which prove the CPU; the array has 8 floats.
        (hit, unsafe { L::load(ts.as_ptr()) })
    }
}
