//! Random numbers for tests and benchmarks.
#![allow(dead_code, unreachable_pub, reason = "everyone who shares it uses a part of it")]

use std::f32::consts::TAU;

use glam::Vec3A as Vec3;

/// `SplitMix64` (Steele, Lea & Flood 2014): plenty for tests.
pub struct Random(pub u64);

impl Random {
    /// 24 bits in [0, 1).
    pub fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e3779b97f4a7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58476d1ce4e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d049bb133111eb);
        ((x ^ (x >> 31)) >> 40) as f32 / (1 << 24) as f32
    }

    pub fn pair(&mut self) -> [f32; 2] {
        [self.next(), self.next()]
    }

    /// In the cube [0, 1)³.
    pub fn point(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }

    /// On the unit sphere.
    pub fn direction(&mut self) -> Vec3 {
        from_angles(2.0 * self.next() - 1.0, TAU * self.next())
    }
}

/// A unit vector from its z and its azimuth.
pub fn from_angles(z: f32, phi: f32) -> Vec3 {
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(radius * phi.cos(), radius * phi.sin(), z)
}
