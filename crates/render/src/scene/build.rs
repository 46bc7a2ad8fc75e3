//! From the tree of plugins to objects: what the builders of all families share.
//!
//! Nodes that are referred to many times are built once; an unknown plugin or parameter is an error, or, when loading
//! leniently, a warning and a stated substitute.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use crate::bsdf::{self, Bsdf};
use crate::geometry::Rgb;
use crate::scene::node::{Kind, Node};
use crate::scene::properties::Properties;
use crate::texture::{self, Texture, image::Image};
use crate::{Error, Result};

/// One line of a family's registry: a plugin name and how to build it.
pub struct Entry<T: ?Sized> {
    /// Name of the Mitsuba 3 plugin.
    pub name: &'static str,
    /// Read the parameters and build. The caller then insists that nothing is left over.
    pub build: fn(&Properties<'_>, &mut Builder) -> Result<Arc<T>>,
}

/// What is shared while a scene is being built.
#[derive(Default)]
pub struct Builder {
    /// Unknown plugins and parameters become warnings.
    pub lenient: bool,
    /// What was found wrong and replaced, when lenient.
    pub warnings: Vec<String>,
    images: HashMap<(PathBuf, bool), Arc<Image>>,
    bsdfs: HashMap<*const Node, Arc<dyn Bsdf>>,
    textures: HashMap<*const Node, Arc<dyn Texture>>,
}

impl Builder {
    /// Nothing built yet.
    pub fn new(lenient: bool) -> Self {
        Self { lenient, ..Self::default() }
    }

    /// What was found wrong; decoded images and all else that was only shared while building is let go.
    pub fn into_warnings(self) -> Vec<String> {
        self.warnings
    }

    /// Build a node by its family's registry and insist that nothing is left over.
    /// An unknown plugin gives `substitute()` with a warning when lenient.
    pub fn from_registry<T: ?Sized>(
        &mut self,
        node: &Node,
        registry: &[Entry<T>],
        substitute: (&str, &dyn Fn() -> Arc<T>),
    ) -> Result<Arc<T>> {
        let properties = Properties::new(node);
        let Some(entry) = registry.iter().find(|entry| entry.name == node.plugin) else {
            self.unknown_plugin(node, registry.iter().map(|entry| entry.name), substitute.0)?;
            return Ok(substitute.1());
        };
        let built = (entry.build)(&properties, self)?;
        self.finish(&properties)?;
        Ok(built)
    }

    /// Complain about a plugin that is not among those of its family.
    pub fn unknown_plugin(
        &mut self,
        node: &Node,
        known: impl Iterator<Item = &'static str>,
        substitute: &str,
    ) -> Result<()> {
        let known = known.collect::<Vec<_>>().join(", ");
        let message = format!("unknown {} '{}'; known: {known}", node.kind.element(), node.plugin);
        self.forgive(Error::Scene { location: node.location.clone(), message }, substitute)
    }

    /// Insist that nothing is left over; when lenient, ignore it with a warning.
    pub fn finish(&mut self, properties: &Properties<'_>) -> Result<()> {
        properties.leftovers().into_iter().try_for_each(|error| self.forgive(error, "ignored"))
    }

    /// Strictly: the error. Leniently: a warning that states the substitute.
    pub fn forgive(&mut self, error: Error, substitute: &str) -> Result<()> {
        if !self.lenient {
            return Err(error);
        }
        self.warnings.push(format!("{error} ({substitute})"));
        Ok(())
    }

    /// A scattering function; nodes referred to many times are built once.
    pub fn bsdf(&mut self, node: &Arc<Node>) -> Result<Arc<dyn Bsdf>> {
        if let Some(built) = self.bsdfs.get(&Arc::as_ptr(node)) {
            return Ok(built.clone());
        }
        let substitute: (&str, &dyn Fn() -> Arc<dyn Bsdf>) =
            ("replaced by a gray diffuse surface", &|| Arc::new(bsdf::diffuse::Diffuse::gray(0.5)));
        let built = self.from_registry(node, bsdf::ALL, substitute)?;
        self.bsdfs.insert(Arc::as_ptr(node), built.clone());
        Ok(built)
    }

    /// The only nested BSDF of a plugin that needs exactly one.
    pub fn only_bsdf(&mut self, properties: &Properties<'_>) -> Result<Arc<dyn Bsdf>> {
        match properties.children(Kind::Bsdf)[..] {
            [child] => self.bsdf(&child.node),
            ref all => {
                Err(properties.error(format_args!("needs exactly one nested bsdf, has {}", all.len())))
            }
        }
    }

    /// A color that may vary: a nested texture, a color or a number, else `default`.
    pub fn texture(
        &mut self,
        properties: &Properties<'_>,
        name: &str,
        default: Rgb,
    ) -> Result<Arc<dyn Texture>> {
        if let Some(node) = properties.child(Kind::Texture, name) {
            return self.texture_node(node);
        }
        let color = properties.optional_rgb(name)?.unwrap_or(default);
        Ok(Arc::new(texture::constant::Constant(color)))
    }

    /// A texture plugin; nodes referred to many times are built once.
    pub fn texture_node(&mut self, node: &Arc<Node>) -> Result<Arc<dyn Texture>> {
        if let Some(built) = self.textures.get(&Arc::as_ptr(node)) {
            return Ok(built.clone());
        }
        let substitute: (&str, &dyn Fn() -> Arc<dyn Texture>) =
            ("replaced by gray 0.5", &|| Arc::new(texture::constant::Constant(Rgb::splat(0.5))));
        let built = self.from_registry(node, texture::ALL, substitute)?;
        self.textures.insert(Arc::as_ptr(node), built.clone());
        Ok(built)
    }

    /// An image file, decoded once; `raw` keeps 8-bit values as they are, else sRGB becomes linear.
    pub fn image(&mut self, path: PathBuf, raw: bool) -> Result<Arc<Image>> {
        let key = (path, raw);
        if let Some(image) = self.images.get(&key) {
            return Ok(image.clone());
        }
        let image = Arc::new(Image::read(&key.0, raw)?);
        self.images.insert(key, image.clone());
        Ok(image)
    }
}
