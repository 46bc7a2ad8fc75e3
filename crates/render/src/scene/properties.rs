//! How a plugin reads its parameters: typed, with defaults, and nothing left over.
//!
//! Every plugin takes what it knows from a [`Properties`]; [`Properties::leftovers`] then names whatever nobody asked for,
//! together with everything that was asked for, so that a plugin's known parameters are never listed twice.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use glam::{DMat3, DMat4};

use crate::geometry::Rgb;
use crate::scene::node::{Child, Kind, Node, Parameter, Value};
use crate::{Error, Location, Result};

/// The parameters and nested plugins of one node, taken one by one.
pub struct Properties<'a> {
    node: &'a Node,
    asked: RefCell<BTreeSet<String>>,
    taken_children: RefCell<BTreeSet<usize>>,
}

impl<'a> Properties<'a> {
    /// Read `node`.
    pub fn new(node: &'a Node) -> Self {
        Self { node, asked: RefCell::default(), taken_children: RefCell::default() }
    }

    /// The plugin's name.
    pub fn plugin(&self) -> &'a str {
        &self.node.plugin
    }

    /// Where the plugin stands.
    pub fn location(&self) -> &'a Location {
        &self.node.location
    }

    /// An error at this plugin.
    pub fn error(&self, message: impl std::fmt::Display) -> Error {
        Error::Scene {
            location: self.node.location.clone(),
            message: format!("{} '{}': {message}", self.node.kind.element(), self.node.plugin),
        }
    }

    fn parameter(&self, name: &str) -> Option<&'a Parameter> {
        self.asked.borrow_mut().insert(name.to_owned());
        self.node.parameters.iter().find(|parameter| parameter.name == name)
    }

    fn mismatch<T>(&self, parameter: &Parameter, expected: &str) -> Result<T> {
        Err(Error::Scene {
            location: parameter.location.clone(),
            message: format!(
                "{} '{}': parameter '{}' must be {expected}, not {}",
                self.node.kind.element(),
                self.node.plugin,
                parameter.name,
                parameter.value.element()
            ),
        })
    }

    /// Whether a parameter or a nested plugin of this name is given (it still has to be taken).
    pub fn has(&self, name: &str) -> bool {
        self.asked.borrow_mut().insert(name.to_owned());
        self.node.parameters.iter().any(|parameter| parameter.name == name)
            || self.node.children.iter().any(|child| child.name.as_deref() == Some(name))
    }

    /// A number; integers are numbers too.
    pub fn optional_float(&self, name: &str) -> Result<Option<f32>> {
        match self.parameter(name) {
            None => Ok(None),
            Some(Parameter { value: Value::Float(x), .. }) => Ok(Some(*x as f32)),
            Some(Parameter { value: Value::Integer(x), .. }) => Ok(Some(*x as f32)),
            Some(other) => self.mismatch(other, "a float"),
        }
    }

    /// A number with a default.
    pub fn float(&self, name: &str, default: f32) -> Result<f32> {
        Ok(self.optional_float(name)?.unwrap_or(default))
    }

    /// A finite number above 0, with a default.
    pub fn positive_float(&self, name: &str, default: f32) -> Result<f32> {
        let value = self.float(name, default)?;
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(self.error(format_args!("{name} must be positive, not {value}")))
    }

    /// A whole number, if given.
    pub fn optional_integer(&self, name: &str) -> Result<Option<i64>> {
        match self.parameter(name) {
            None => Ok(None),
            Some(Parameter { value: Value::Integer(x), .. }) => Ok(Some(*x)),
            Some(other) => self.mismatch(other, "an integer"),
        }
    }

    /// A truth value with a default.
    pub fn boolean(&self, name: &str, default: bool) -> Result<bool> {
        match self.parameter(name) {
            None => Ok(default),
            Some(Parameter { value: Value::Boolean(x), .. }) => Ok(*x),
            Some(other) => self.mismatch(other, "a boolean"),
        }
    }

    /// A string, if given.
    pub fn optional_string(&self, name: &str) -> Result<Option<&'a str>> {
        match self.parameter(name) {
            None => Ok(None),
            Some(Parameter { value: Value::String(x), .. }) => Ok(Some(x)),
            Some(other) => self.mismatch(other, "a string"),
        }
    }

    /// One of a list of names; the first is the default. Gives its position in the list.
    pub fn choice(&self, name: &str, allowed: &[&str]) -> Result<usize> {
        let Some(given) = self.optional_string(name)? else { return Ok(0) };
        allowed.iter().position(|candidate| *candidate == given).ok_or_else(|| {
            let known = allowed.join(", ");
            self.error(format_args!("unknown {name} '{given}'; known: {known}"))
        })
    }

    /// A point or vector, if given.
    pub fn optional_vector(&self, name: &str) -> Result<Option<[f64; 3]>> {
        match self.parameter(name) {
            None => Ok(None),
            Some(Parameter { value: Value::Vector(x), .. }) => Ok(Some(*x)),
            Some(other) => self.mismatch(other, "a point or vector"),
        }
    }

    /// A 4×4 transform; the identity by default.
    pub fn transform(&self, name: &str) -> Result<DMat4> {
        match self.parameter(name) {
            None => Ok(DMat4::IDENTITY),
            Some(Parameter { value: Value::Transform(x), .. }) => Ok(*x),
            Some(other) => self.mismatch(other, "a transform"),
        }
    }

    /// A transform of texture coordinates: the x, y part of a 4×4 transform; the identity by default.
    pub fn uv_transform(&self, name: &str) -> Result<DMat3> {
        let m = self.transform(name)?;
        Ok(DMat3::from_cols(
            glam::DVec3::new(m.x_axis.x, m.x_axis.y, 0.0),
            glam::DVec3::new(m.y_axis.x, m.y_axis.y, 0.0),
            glam::DVec3::new(m.w_axis.x, m.w_axis.y, 1.0),
        ))
    }

    /// A color, if given; a number is gray.
    pub fn optional_rgb(&self, name: &str) -> Result<Option<Rgb>> {
        match self.parameter(name) {
            None => Ok(None),
            Some(Parameter { value: Value::Rgb(c), .. }) => {
                Ok(Some(Rgb::new(c[0] as f32, c[1] as f32, c[2] as f32)))
            }
            Some(Parameter { value: Value::Float(x), .. }) => Ok(Some(Rgb::splat(*x as f32))),
            Some(Parameter { value: Value::Integer(x), .. }) => Ok(Some(Rgb::splat(*x as f32))),
            Some(other) => self.mismatch(other, "a color"),
        }
    }

    /// A file name, resolved in the scene's folder. The file need not exist, but must not lie outside unless allowed.
    pub fn path(&self, name: &str) -> Result<Option<PathBuf>> {
        let Some(parameter) = self.parameter(name) else { return Ok(None) };
        let Value::String(given) = &parameter.value else { return self.mismatch(parameter, "a file name") };
        let resolved = self.node.folder.resolve(given);
        resolved.map(Some).map_err(|message| Error::Scene { location: parameter.location.clone(), message })
    }

    /// [`Properties::path`] of a parameter that must be given.
    pub fn required_path(&self, name: &str) -> Result<PathBuf> {
        self.path(name)?.ok_or_else(|| self.error(format_args!("needs a '{name}'")))
    }

    /// The nested plugin of this kind under this name, if any.
    pub fn child(&self, kind: Kind, name: &str) -> Option<&'a Arc<Node>> {
        self.asked.borrow_mut().insert(name.to_owned());
        let (position, child) = self
            .node
            .children
            .iter()
            .enumerate()
            .find(|(_, child)| child.node.kind == kind && child.name.as_deref() == Some(name))?;
        self.taken_children.borrow_mut().insert(position);
        Some(&child.node)
    }

    /// All nested plugins of this kind that nobody took yet, named or not, in file order.
    pub fn children(&self, kind: Kind) -> Vec<&'a Child> {
        let mut taken = self.taken_children.borrow_mut();
        let all = self.node.children.iter().enumerate();
        all.filter(|(position, child)| child.node.kind == kind && taken.insert(*position))
            .map(|(_, child)| child)
            .collect()
    }

    /// Complaints about all parameters and nested plugins that nobody asked for.
    pub fn leftovers(&self) -> Vec<Error> {
        let asked = self.asked.borrow();
        let taken = self.taken_children.borrow();
        let known = asked.iter().cloned().collect::<Vec<_>>().join(", ");
        let complain = |location: &Location, what: String| Error::Scene {
            location: location.clone(),
            message: format!("{} '{}': {what}; known: {known}", self.node.kind.element(), self.node.plugin),
        };
        let unknown = self.node.parameters.iter().filter(|parameter| !asked.contains(&parameter.name));
        let parameters = unknown.map(|p| complain(&p.location, format!("unknown parameter '{}'", p.name)));
        let children = self.node.children.iter().enumerate();
        let untaken = children.filter(|(position, _)| !taken.contains(position)).map(|(_, child)| {
            let name = child.name.as_ref().map(|name| format!(" named '{name}'")).unwrap_or_default();
            complain(&child.location, format!("takes no nested {}{name}", child.node.kind.element()))
        });
        parameters.chain(untaken).collect()
    }
}
