//! From the elements of all files of a scene to drafts of nodes, whose references are still names.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DMat4;

use super::document::{self, Element, Source};
use super::drafts::{Drafts, Target};
use super::parameters::Parameters;
use super::{
    DEPTH_LIMIT, FILE_LIMIT, INCLUDE_DEPTH_LIMIT, INCLUDE_LIMIT, LoadOptions, TOTAL_LIMIT, spectrum,
    transform, values,
};
use crate::scene::folder::{self, Folder};
use crate::scene::node::{Kind, Value};
use crate::{Error, Location, Result};

/// Read the scene and all that it includes.
pub(super) fn read(path: &Path, options: &LoadOptions) -> Result<Drafts> {
    let mut reader = Reader {
        drafts: Drafts::default(),
        parameters: Parameters::new(&options.parameters),
        open: Vec::new(),
        includes: 0,
        bytes: 0,
    };
    let root = path.parent().unwrap_or(Path::new("."));
    reader.file(path, Folder::new(root, options.allow_outside), None)?;
    match reader.parameters.unused() {
        None => Ok(reader.drafts),
        Some(message) => {
            let location = Location { file: Arc::new(path.to_owned()), line: 0 };
            Err(Error::Scene { location, message })
        }
    }
}

/// Where an included file goes.
struct Parent<'a> {
    draft: usize,
    name: Option<&'a str>,
    depth: usize,
}

/// The file that is being read.
struct File {
    source: Source,
    folder: Arc<Folder>,
}

struct Reader {
    drafts: Drafts,
    parameters: Parameters,
    /// The files that are being read, from the scene to the innermost include.
    open: Vec<PathBuf>,
    includes: usize,
    bytes: u64,
}

impl Reader {
    fn file(&mut self, path: &Path, folder: Folder, parent: Option<&Parent<'_>>) -> Result<()> {
        let io = |source| Error::Io { path: path.to_owned(), source };
        self.open.push(path.canonicalize().map_err(io)?);
        let bytes = folder::read(path, FILE_LIMIT)?;
        self.bytes += bytes.len() as u64;
        if self.bytes > TOTAL_LIMIT {
            return Err(Error::file(
                path,
                format_args!("the scene is larger than {} MiB", TOTAL_LIMIT >> 20),
            ));
        }
        let text = String::from_utf8(bytes).map_err(|_| Error::file(path, "not UTF-8 text"))?;
        let file = &mut File { source: Source::new(path, &text), folder: Arc::new(folder) };
        let document = document::parse(&text, &file.source)?;
        self.root(document.root_element(), file, parent)?;
        self.open.pop();
        Ok(())
    }

    fn root<'t>(
        &mut self,
        node: roxmltree::Node<'t, 't>,
        file: &mut File,
        parent: Option<&Parent<'_>>,
    ) -> Result<()> {
        let element = Element::read(node, &file.source, &mut self.parameters)?;
        check_version(&element)?;
        match parent {
            None if element.name == "scene" => {
                element.allow(&["version"], &["type", "id", "name"])?;
                let root = self.drafts.push(Kind::Scene, &element, &file.folder)?;
                self.children(node, file, root, 1)
            }
            None => Err(element.error("a scene file must start with <scene>")),
            Some(parent) if element.name == "scene" => {
                element.allow(&["version"], &["type", "id", "name"])?;
                self.children(node, file, parent.draft, parent.depth)
            }
            Some(parent) => {
                let Some(kind) = kind_named(element.name) else { return Err(unknown(&element)) };
                element.allow(&["version", "type"], &["id", "name"])?;
                let child = self.drafts.push(kind, &element, &file.folder)?;
                let name = parent.name.or(element.get("name"));
                self.drafts.attach(parent.draft, name, Target::Draft(child), &element)?;
                self.children(node, file, child, parent.depth + 1)
            }
        }
    }

    fn children<'t>(
        &mut self,
        node: roxmltree::Node<'t, 't>,
        file: &mut File,
        parent: usize,
        depth: usize,
    ) -> Result<()> {
        node.children().filter(roxmltree::Node::is_element).try_for_each(|child| {
            let element = Element::read(child, &file.source, &mut self.parameters)?;
            if depth > DEPTH_LIMIT {
                return Err(element.error(format_args!("nested deeper than {DEPTH_LIMIT}")));
            }
            self.element(child, &element, file, (parent, depth))
        })
    }

    /// One element inside of the node `parent`.
    fn element<'t>(
        &mut self,
        node: roxmltree::Node<'t, 't>,
        element: &Element<'t>,
        file: &mut File,
        (parent, depth): (usize, usize),
    ) -> Result<()> {
        if element.name == "spectrum" && element.get("type").is_some() {
            return self.spectrum_plugin(node, element, file, (parent, depth));
        }
        if let Some(kind) = kind_named(element.name) {
            element.allow(&["type"], &["id", "name"])?;
            let child = self.drafts.push(kind, element, &file.folder)?;
            self.drafts.attach(parent, element.get("name"), Target::Draft(child), element)?;
            return self.children(node, file, child, depth + 1);
        }
        if element.name != "transform" && node.children().any(|child| child.is_element()) {
            return Err(element.error("takes no nested elements"));
        }
        match element.name {
            "default" => self.default(element),
            "include" => self.include(element, file, (parent, depth)),
            "alias" => self.alias(element),
            "path" => search_path(node, element, file),
            "ref" => self.reference(element, parent),
            _ => {
                let value = self.value(node, element, file, parent)?;
                self.drafts.set(parent, element, value)
            }
        }
    }

    fn default(&mut self, element: &Element<'_>) -> Result<()> {
        element.allow(&["name", "value"], &[])?;
        let (name, value) = (element.required("name"), element.required("value"));
        self.parameters.default(name, value).map_err(|message| element.error(message))
    }

    fn alias(&mut self, element: &Element<'_>) -> Result<()> {
        element.allow(&["id", "as"], &[])?;
        let (id, new) = (element.required("id"), element.required("as"));
        let place = self.drafts.ids.get(id).map(|(place, _)| *place);
        let place =
            place.ok_or_else(|| element.error(format_args!("no object before this has the id '{id}'")))?;
        self.drafts.name_node(new, place, element)
    }

    fn reference(&mut self, element: &Element<'_>, parent: usize) -> Result<()> {
        element.allow(&["id"], &["name"])?;
        let id = element.required("id").to_owned();
        self.drafts.attach(parent, element.get("name"), Target::Id(id), element)
    }

    fn include(&mut self, element: &Element<'_>, file: &File, (parent, depth): (usize, usize)) -> Result<()> {
        element.allow(&["filename"], &["name"])?;
        let given = element.required("filename");
        let path = file.folder.resolve(given).map_err(|message| element.error(message))?;
        let real = path
            .canonicalize()
            .map_err(|error| element.error(format_args!("'{}' cannot be read: {error}", path.display())))?;
        if self.open.contains(&real) {
            return Err(element.error(format_args!("'{given}' includes itself")));
        }
        self.includes += 1;
        if self.open.len() > INCLUDE_DEPTH_LIMIT || self.includes > INCLUDE_LIMIT {
            return Err(element.error(format_args!(
                "more than {INCLUDE_DEPTH_LIMIT} nested or {INCLUDE_LIMIT} includes in all"
            )));
        }
        let mut folder = Folder::clone(&file.folder);
        folder.prepend(path.parent().unwrap_or(Path::new(".")).to_owned());
        self.file(&path, folder, Some(&Parent { draft: parent, name: element.get("name"), depth }))
    }

    fn value<'t>(
        &mut self,
        node: roxmltree::Node<'t, 't>,
        element: &Element<'t>,
        file: &File,
        parent: usize,
    ) -> Result<Value> {
        let blame = |message: String| element.error(message);
        match element.name {
            "transform" => return self.transform(node, element, file).map(Value::Transform),
            "spectrum" => {
                element.allow(&["name"], &["value", "filename"])?;
                let role = spectrum::role(self.drafts.all[parent].kind, element.required("name"));
                return spectrum::read(element, &file.folder, role).map(Value::Rgb);
            }
            "point" | "vector" => {
                element.allow(&["name"], &["x", "y", "z", "value"])?;
                return values::vector(element, None).map(Value::Vector);
            }
            "boolean" | "integer" | "float" | "string" | "rgb" => element.allow(&["name", "value"], &[])?,
            _ => return Err(unknown(element)),
        }
        let text = element.required("value");
        match element.name {
            "boolean" => values::boolean(text).map(Value::Boolean).map_err(blame),
            "integer" => values::integer(text).map(Value::Integer).map_err(blame),
            "float" => values::float(text).map(Value::Float).map_err(blame),
            "rgb" => values::rgb(text).map(Value::Rgb).map_err(blame),
            _ => Ok(Value::String(text.to_owned())),
        }
    }

    fn transform<'t>(
        &mut self,
        node: roxmltree::Node<'t, 't>,
        element: &Element<'t>,
        file: &File,
    ) -> Result<DMat4> {
        element.allow(&["name"], &[])?;
        let mut transform = DMat4::IDENTITY;
        for child in node.children().filter(roxmltree::Node::is_element) {
            let operation = Element::read(child, &file.source, &mut self.parameters)?;
            if child.children().any(|nested| nested.is_element()) {
                return Err(operation.error("takes no nested elements"));
            }
            transform = transform::apply(&operation, transform)?;
        }
        transform::check(element.required("name"), transform).map_err(|message| element.error(message))
    }

    /// `<spectrum type="…">`: read like any plugin, kept as a color.
    fn spectrum_plugin<'t>(
        &mut self,
        node: roxmltree::Node<'t, 't>,
        element: &Element<'t>,
        file: &mut File,
        (parent, depth): (usize, usize),
    ) -> Result<()> {
        element.allow(&["type", "name"], &[])?;
        let place = self.drafts.push(Kind::Texture, element, &file.folder)?;
        self.children(node, file, place, depth + 1)?;
        let draft =
            self.drafts.all.pop().filter(|draft| draft.children.is_empty() && self.drafts.all.len() == place);
        let draft = draft.ok_or_else(|| element.error("takes no nested plugins"))?;
        let color =
            spectrum::plugin(&draft.plugin, &draft.parameters).map_err(|message| element.error(message))?;
        self.drafts.set(parent, element, Value::Rgb(color))
    }
}

/// A folder for the files of everything that follows in this file.
fn search_path<'t>(node: roxmltree::Node<'t, 't>, element: &Element<'t>, file: &mut File) -> Result<()> {
    element.allow(&["value"], &[])?;
    if node.parent() != Some(node.document().root_element()) {
        return Err(element.error("only allowed directly below <scene>"));
    }
    let folder = file.folder.resolve(element.required("value")).map_err(|message| element.error(message))?;
    if !folder.is_dir() {
        return Err(element.error(format_args!("the folder '{}' does not exist", folder.display())));
    }
    Arc::make_mut(&mut file.folder).prepend(folder);
    Ok(())
}

fn kind_named(name: &str) -> Option<Kind> {
    Kind::ALL.into_iter().find(|kind| kind.element() == name && *kind != Kind::Scene)
}

fn unknown(element: &Element<'_>) -> Error {
    let mut known = vec![
        "alias",
        "boolean",
        "default",
        "float",
        "include",
        "integer",
        "path",
        "point",
        "ref",
        "rgb",
        "spectrum",
        "string",
        "transform",
        "vector",
    ];
    known.extend(Kind::ALL.iter().filter(|kind| **kind != Kind::Scene).map(|kind| kind.element()));
    known.sort_unstable();
    let place = match element.name {
        "lookat" | "matrix" | "rotate" | "scale" | "translate" => "only allowed inside of <transform>",
        "scene" => "only allowed as the root of a file",
        _ => "unknown element",
    };
    element.error(format_args!("{place}; known here: {}", known.join(", ")))
}

fn check_version(element: &Element<'_>) -> Result<()> {
    let supported = "scenes of Mitsuba 3 are supported (version=\"3.0.0\")";
    let Some(version) = element.get("version") else {
        return Err(element.error(format_args!("the attribute 'version' is missing; {supported}")));
    };
    let mut parts = version.trim().split('.').map(str::parse::<u32>);
    let major = parts.next();
    let valid = parts.by_ref().take(3).all(|part| part.is_ok());
    match major {
        Some(Ok(3)) if valid => Ok(()),
        _ => Err(element.error(format_args!(
            "version '{}' is not supported; {supported}; Mitsuba 3 itself converts files of versions 0.x and 2.x",
            values::shorten(version)
        ))),
    }
}
