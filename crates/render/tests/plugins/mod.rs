//! Plugins from short pieces of XML, and the surface they are tried on.

#![allow(dead_code, reason = "each test takes what it needs")]

use std::sync::Arc;

use evenlight_render::geometry::{Frame, Surface, Vec2, Vec3};
use evenlight_render::scene::build::Builder;
use evenlight_render::scene::folder::Folder;
use evenlight_render::scene::node::{Child, Kind, Node, Parameter, Value};
use evenlight_render::{Location, Result, bsdf::Bsdf, texture::Texture};
use glam::{DMat4, DVec3};
use roxmltree::Node as Element;

/// Where the files of these tests are.
pub(crate) const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");

/// Build a BSDF from XML.
pub(crate) fn bsdf(xml: &str) -> Result<Arc<dyn Bsdf>> {
    Builder::default().bsdf(&Arc::new(parse(xml)))
}

/// Build a texture from XML.
pub(crate) fn texture(xml: &str) -> Result<Arc<dyn Texture>> {
    Builder::default().texture_node(&Arc::new(parse(xml)))
}

fn parse(xml: &str) -> Node {
    node(roxmltree::Document::parse(xml).expect("the XML of a test").root_element())
}

fn node(element: Element<'_, '_>) -> Node {
    let inside = || element.children().filter(Element::is_element);
    let children = inside().filter(|child| matches!(child.tag_name().name(), "bsdf" | "texture"));
    Node {
        kind: if element.tag_name().name() == "bsdf" { Kind::Bsdf } else { Kind::Texture },
        plugin: element.attribute("type").expect("a type").to_owned(),
        id: None,
        location: Location::default(),
        parameters: inside().filter_map(parameter).collect(),
        children: children
            .map(|child| Child {
                name: child.attribute("name").map(ToOwned::to_owned),
                node: Arc::new(node(child)),
                location: Location::default(),
            })
            .collect(),
        folder: Arc::new(Folder::new(DATA, false)),
    }
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|x| x.parse().expect("a number")).collect()
}

fn parameter(element: Element<'_, '_>) -> Option<Parameter> {
    let text = element.attribute("value").unwrap_or_default();
    let value = match element.tag_name().name() {
        "boolean" => Value::Boolean(text == "true"),
        "float" => Value::Float(text.parse().expect("a float")),
        "string" => Value::String(text.to_owned()),
        "rgb" => Value::Rgb(numbers(text).try_into().expect("three numbers")),
        "transform" => Value::Transform(transform(element)),
        _ => return None,
    };
    let name = element.attribute("name").expect("a name").to_owned();
    Some(Parameter { name, value, location: Location::default() })
}

fn transform(element: Element<'_, '_>) -> DMat4 {
    element.children().filter(Element::is_element).fold(DMat4::IDENTITY, |matrix, step| {
        let get = |name, default| step.attribute(name).map_or(default, |x| numbers(x)[0]);
        let next = match step.tag_name().name() {
            "scale" => DMat4::from_scale(DVec3::new(get("x", 1.0), get("y", 1.0), 1.0)),
            "rotate" => DMat4::from_rotation_z(get("angle", 0.0).to_radians()),
            _ => DMat4::from_translation(DVec3::new(get("x", 0.0), get("y", 0.0), 0.0)),
        };
        next * matrix
    })
}

/// The surface of the reference values: its shading normal is not its geometric one, and its tangents are not orthogonal.
pub(crate) fn surface(uv: Vec2) -> Surface {
    let (dp_du, dp_dv) = (Vec3::new(1.1, 0.2, 0.1), Vec3::new(-0.1, 0.9, 0.3));
    let n = Vec3::new(0.1, -0.05, 1.0).normalize();
    Surface {
        position: Vec3::ZERO,
        geometric_normal: dp_du.cross(dp_dv).normalize(),
        shading: Frame::from_normal_and_tangent(n, dp_du),
        uv,
        dp_du,
        dp_dv,
    }
}
