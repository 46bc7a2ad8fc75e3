//! A scene file as plain data: a tree of plugins with their parameters, before anything is built.
//!
//! Parameters of the command line (`$name`), includes, transforms and relative paths are already resolved here; references are
//! shared nodes.

use std::sync::Arc;

use glam::DMat4;

use crate::Location;
use crate::scene::folder::Folder;

/// What a plugin is: the name of its XML element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The root.
    Scene,
    /// How light transport is solved.
    Integrator,
    /// A camera.
    Sensor,
    /// What a camera records.
    Film,
    /// A pixel reconstruction filter.
    ReconstructionFilter,
    /// Where random numbers come from.
    Sampler,
    /// Geometry.
    Shape,
    /// Scattering at a surface.
    Bsdf,
    /// A source of light.
    Emitter,
    /// A color that varies.
    Texture,
    /// A participating medium.
    Medium,
    /// A phase function of a medium.
    PhaseFunction,
    /// A field over a volume.
    Volume,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 13] = [
        Self::Scene,
        Self::Integrator,
        Self::Sensor,
        Self::Film,
        Self::ReconstructionFilter,
        Self::Sampler,
        Self::Shape,
        Self::Bsdf,
        Self::Emitter,
        Self::Texture,
        Self::Medium,
        Self::PhaseFunction,
        Self::Volume,
    ];

    /// The XML element that introduces this kind.
    pub fn element(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Integrator => "integrator",
            Self::Sensor => "sensor",
            Self::Film => "film",
            Self::ReconstructionFilter => "rfilter",
            Self::Sampler => "sampler",
            Self::Shape => "shape",
            Self::Bsdf => "bsdf",
            Self::Emitter => "emitter",
            Self::Texture => "texture",
            Self::Medium => "medium",
            Self::PhaseFunction => "phase",
            Self::Volume => "volume",
        }
    }
}

/// The value of one parameter.
#[derive(Clone, Debug)]
pub enum Value {
    /// `<boolean>`
    Boolean(bool),
    /// `<integer>`
    Integer(i64),
    /// `<float>`
    Float(f64),
    /// `<string>`
    String(String),
    /// `<point>`, `<vector>`
    Vector([f64; 3]),
    /// `<transform>`: finite, column vectors.
    Transform(DMat4),
    /// `<rgb>` and uniform or tabulated `<spectrum>`, already linear sRGB.
    Rgb([f64; 3]),
}

impl Value {
    /// The XML element that gives such a value.
    pub fn element(&self) -> &'static str {
        match self {
            Self::Boolean(_) => "a boolean",
            Self::Integer(_) => "an integer",
            Self::Float(_) => "a float",
            Self::String(_) => "a string",
            Self::Vector(_) => "a point or vector",
            Self::Transform(_) => "a transform",
            Self::Rgb(_) => "a color",
        }
    }
}

/// A named parameter of a plugin.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name, unique within the plugin.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// Where it stands.
    pub location: Location,
}

/// A nested or referenced plugin.
#[derive(Clone, Debug)]
pub struct Child {
    /// The name it was given by its parent, if any (`_arg_…` counts as none).
    pub name: Option<String>,
    /// The plugin; shared between all that refer to it.
    pub node: Arc<Node>,
    /// Where it is nested or referred to.
    pub location: Location,
}

/// A plugin with its parameters.
#[derive(Clone, Debug)]
pub struct Node {
    /// What it is.
    pub kind: Kind,
    /// Its `type` attribute; empty for the scene itself.
    pub plugin: String,
    /// Its `id` attribute, if any.
    pub id: Option<String>,
    /// Where it stands.
    pub location: Location,
    /// Its parameters, in file order.
    pub parameters: Vec<Parameter>,
    /// Its nested and referenced plugins, in file order.
    pub children: Vec<Child>,
    /// Where its files are looked up and, unless allowed, must be.
    pub folder: Arc<Folder>,
}

impl Node {
    /// A plugin with nothing but defaults.
    pub fn empty(kind: Kind, plugin: &str) -> Self {
        Self {
            kind,
            plugin: plugin.to_owned(),
            id: None,
            location: Location::default(),
            parameters: Vec::new(),
            children: Vec::new(),
            folder: Arc::default(),
        }
    }
}
