//! From the tree of plugins to a scene that can be rendered.

use std::sync::Arc;

use glam::DVec3;

use crate::accel::{self, TriangleSoup};
use crate::emitter::{self, Emitter, SceneSphere, area::Area, selection::Selection};
use crate::film::FilmSettings;
use crate::geometry::Vec3;
use crate::integrator::{Mis, Roulette, Transport};
use crate::memory::use_large_pages;
use crate::scene::analytic::{AnalyticShapes, Numbered};
use crate::scene::build::Builder;
use crate::scene::node::{Kind, Node};
use crate::scene::properties::Properties;
use crate::scene::world::{PlacedShape, ShadingTriangle, World};
use crate::scene::{Environment, Scene, SceneOptions};
use crate::sensor::{self, Sensor};
use crate::shape::rectangle::ParallelogramLight;
use crate::shape::triangles::TriangleLight;
use crate::shape::{Geometry, LightGeometry, Shape};
use crate::{Error, Result};

impl Scene {
    /// Build a scene from its plain data.
    pub fn build(root: &Node, options: &SceneOptions) -> Result<Self> {
        let mut builder = Builder::new(options.lenient);
        let properties = Properties::new(root);

        // What stands alone in the file and is only used by reference.
        for kind in [Kind::Bsdf, Kind::Texture] {
            for child in properties.children(kind) {
                match kind {
                    Kind::Bsdf => drop(builder.bsdf(&child.node)?),
                    _ => drop(builder.texture_node(&child.node)?),
                }
            }
        }
        refuse_media(&properties, &mut builder)?;

        let transport = match properties.children(Kind::Integrator)[..] {
            [] => read_transport(&Node::empty(Kind::Integrator, "path"), &mut builder)?,
            [child] => read_transport(&child.node, &mut builder)?,
            _ => return Err(properties.error("has more than one integrator")),
        };
        let sensors = properties.children(Kind::Sensor);
        let sensor = match sensors.first() {
            Some(child) => child.node.clone(),
            None => Arc::new(Node::empty(Kind::Sensor, "perspective")),
        };
        let film = FilmSettings::from_sensor(&sensor, &mut builder)?;
        check_sensor(&sensor, film.aspect(), &mut builder)?;

        let mut assembly = Assembly::default();
        for child in properties.children(Kind::Shape) {
            if let Some(shape) = Shape::build(&child.node, &mut builder)? {
                assembly.place(shape);
            }
        }
        for child in properties.children(Kind::Emitter) {
            if let Some(emitter) = free_emitter(&child.node, &mut builder)? {
                assembly.emitters.push(emitter);
            }
        }
        builder.finish(&properties)?;
        assembly.finish(builder.into_warnings(), options, SceneParts { transport, film, sensor })
    }
}

/// What a scene has besides geometry and lights.
struct SceneParts {
    transport: Transport,
    film: FilmSettings,
    sensor: Arc<Node>,
}

/// Shapes and lights on their way to a scene.
#[derive(Default)]
struct Assembly {
    shapes: Vec<PlacedShape>,
    emitters: Vec<Arc<dyn Emitter>>,
    triangles: Vec<ShadingTriangle>,
    analytic: Vec<Numbered>,
    positions: Vec<[f32; 3]>,
    indices: Vec<[u32; 3]>,
}

impl Assembly {
    fn place(&mut self, shape: Shape) {
        let number = self.shapes.len() as u32;
        let Shape { geometry, bsdf, radiance } = shape;
        let emitter = radiance.map(|radiance| {
            let geometry: Arc<dyn LightGeometry> = match &geometry {
                Geometry::Mesh(mesh) => Arc::new(TriangleLight::new(mesh)),
                Geometry::Parallelogram(mesh) => Arc::new(ParallelogramLight::new(mesh)),
                Geometry::Analytic(analytic) => analytic.clone(),
            };
            self.emitters.push(Arc::new(Area::new(geometry, radiance)));
            self.emitters.len() as u32 - 1
        });
        let analytic = match geometry {
            Geometry::Analytic(analytic) => {
                self.analytic.push((number, analytic.clone()));
                Some(analytic)
            }
            Geometry::Mesh(mesh) | Geometry::Parallelogram(mesh) => {
                let first_vertex = self.positions.len() as u32;
                self.positions.extend_from_slice(&mesh.positions);
                self.indices.extend(mesh.indices.iter().map(|t| t.map(|index| index + first_vertex)));
                let triangles = 0..mesh.indices.len();
                self.triangles
                    .extend(triangles.map(|triangle| ShadingTriangle::new(number, &mesh, triangle)));
                None
            }
        };
        let (smooth, needs_tangents) = (bsdf.has_smooth_lobe(), bsdf.needs_tangents());
        self.shapes.push(PlacedShape { analytic, bsdf, emitter, smooth, needs_tangents });
    }

    fn finish(self, warnings: Vec<String>, options: &SceneOptions, parts: SceneParts) -> Result<Scene> {
        let bounds = self.bounds();
        let soup = TriangleSoup { positions: &self.positions, indices: &self.indices };
        let kernel = accel::build(options.kernel, &soup, options.embree_library.as_deref())?;
        use_large_pages(&self.triangles);
        let selection = Selection::new(&self.emitters, &bounds);
        let environments = self.emitters.iter().enumerate();
        let environments =
            environments.filter(|(_, emitter)| emitter.is_environment()).map(|(i, emitter)| Environment {
                emitter: emitter.clone(),
                probability: selection.probability(i),
            });
        Ok(Scene {
            environments: environments.collect(),
            world: World {
                kernel,
                triangles: self.triangles,
                shapes: self.shapes,
                analytic: AnalyticShapes::new(self.analytic),
            },
            emitters: self.emitters,
            selection,
            transport: parts.transport,
            film: parts.film,
            sensor: parts.sensor,
            warnings,
        })
    }

    /// A sphere around the bounding box of everything.
    fn bounds(&self) -> SceneSphere {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let corners = self.positions.iter().map(|&p| Vec3::from(p));
        for corner in corners.chain(self.analytic.iter().flat_map(|(_, shape)| shape.bounds())) {
            low = low.min(corner);
            high = high.max(corner);
        }
        if low.x > high.x {
            return SceneSphere { center: Vec3::ZERO, radius: 1.0 };
        }
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let center: DVec3 = (low + high) * 0.5;
        let radius = (high - center).length().max(1e-6) as f32;
        SceneSphere { center: center.as_vec3().into(), radius }
    }
}

fn refuse_media(properties: &Properties<'_>, builder: &mut Builder) -> Result<()> {
    for child in properties.children(Kind::Medium) {
        let message = "participating media are not rendered yet".into();
        builder.forgive(Error::Scene { location: child.location.clone(), message }, "ignored")?;
    }
    Ok(())
}

/// The integrators that scene files may name.
const INTEGRATORS: [&str; 4] = ["direct", "path", "volpath", "volpathmis"];

/// The settings of the scene's integrator. Its kind is the caller's choice, so only shared parameters are read.
fn read_transport(node: &Node, builder: &mut Builder) -> Result<Transport> {
    let properties = Properties::new(node);
    if !INTEGRATORS.contains(&node.plugin.as_str()) {
        builder.unknown_plugin(node, INTEGRATORS.into_iter(), "replaced by path")?;
        return read_transport(&Node::empty(Kind::Integrator, "path"), builder);
    }
    let direct = node.plugin == "direct";
    let depth = if direct { 2 } else { properties.optional_integer("max_depth")?.unwrap_or(-1) };
    let rr_depth = if direct { 5 } else { properties.optional_integer("rr_depth")?.unwrap_or(5) };
    let max_depth = match depth {
        -1 => u32::MAX,
        depth => u32::try_from(depth)
            .map_err(|_| properties.error("max_depth must be -1 (no limit) or not negative"))?,
    };
    let rr_depth = u32::try_from(rr_depth)
        .ok()
        .filter(|depth| *depth > 0)
        .ok_or_else(|| properties.error("rr_depth must be positive"))?;
    let hide_emitters = properties.boolean("hide_emitters", false)?;
    builder.finish(&properties)?;
    let (roulette, mis) = (Roulette::default(), Mis::default());
    Ok(Transport { max_depth, rr_depth, roulette, hide_emitters, mis })
}

/// Build the sensor of a node, for a film of this aspect ratio.
pub(super) fn sensor(node: &Node, aspect: f64) -> Result<Arc<dyn Sensor>> {
    let mut builder = Builder::new(true);
    let properties = Properties::new(node);
    let entry = sensor::ALL.iter().find(|entry| entry.name == node.plugin);
    // a leniently loaded scene may have a sensor of a kind that is not known
    let build = entry.map_or(sensor::perspective::ENTRY.build, |entry| entry.build);
    build(&properties, &mut builder, aspect)
}

/// Complain early about a sensor that cannot be built, and about what it leaves over.
fn check_sensor(node: &Node, aspect: f64, builder: &mut Builder) -> Result<()> {
    let properties = Properties::new(node);
    let Some(entry) = sensor::ALL.iter().find(|entry| entry.name == node.plugin) else {
        let known = sensor::ALL.iter().map(|entry| entry.name);
        return builder.unknown_plugin(node, known, "replaced by perspective");
    };
    (entry.build)(&properties, builder, aspect)?;
    // the film is read by itself; the choice of sampler is the caller's
    properties.children(Kind::Film);
    properties.children(Kind::Sampler);
    refuse_media(&properties, builder)?;
    for shutter in ["shutter_open", "shutter_close"] {
        properties.float(shutter, 0.0)?;
    }
    builder.finish(&properties)
}

/// An emitter that belongs to no shape; `None` when it was left out, leniently.
fn free_emitter(node: &Node, builder: &mut Builder) -> Result<Option<Arc<dyn Emitter>>> {
    let properties = Properties::new(node);
    let Some(entry) = emitter::ALL.iter().find(|entry| entry.name == node.plugin) else {
        builder.unknown_plugin(node, emitter::ALL.iter().map(|entry| entry.name), "left out")?;
        return Ok(None);
    };
    let emitter = (entry.build)(&properties, builder)?;
    builder.finish(&properties)?;
    Ok(Some(emitter))
}
