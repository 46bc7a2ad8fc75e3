//! Fine relief from a height texture, without moving the surface (Blinn 1978, "Simulation of Wrinkled Surfaces").
//!
//! Heights are in world units when `scale` is 1.

use std::sync::Arc;

use crate::Result;
use crate::bsdf::Bsdf;
use crate::bsdf::perturbed::{Normals, Perturbed};
use crate::geometry::{Surface, Vec3};
use crate::scene::build::{Builder, Entry};
use crate::scene::node::Kind;
use crate::scene::properties::Properties;
use crate::texture::Texture;

pub(crate) const ENTRY: Entry<dyn Bsdf> = Entry { name: "bumpmap", build };

/// The relief of a surface that looks displaced.
struct BumpMap {
    height: Arc<dyn Texture>,
    scale: f32,
}

fn build(properties: &Properties<'_>, builder: &mut Builder) -> Result<Arc<dyn Bsdf>> {
    let height = match properties.children(Kind::Texture)[..] {
        [child] => builder.texture_node(&child.node)?,
        ref all => {
            return Err(properties.error(format_args!("needs exactly one nested texture, has {}", all.len())));
        }
    };
    let scale = properties.float("scale", 1.0)?;
    Ok(Arc::new(Perturbed::build(BumpMap { height, scale }, properties, builder)?))
}

impl Normals for BumpMap {
    /// The displaced surface's normal, in the shading frame and on the geometric normal's side.
    #[inline]
    fn normal(&self, surface: &Surface) -> Vec3 {
        let gradient = self.scale * self.height.gradient(surface.uv);
        let n = surface.shading.n;
        let dp_du = surface.dp_du + n * (gradient.x - n.dot(surface.dp_du));
        let dp_dv = surface.dp_dv + n * (gradient.y - n.dot(surface.dp_dv));
        let bumped = dp_du.cross(dp_dv).normalize_or(n);
        let side = 1.0_f32.copysign(bumped.dot(surface.geometric_normal));
        surface.shading.to_local(bumped * side)
    }
}
