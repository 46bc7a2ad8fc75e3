//! Nodes while the files are read: children are places in a list, references are still names.

use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

use super::document::Element;
use crate::scene::folder::Folder;
use crate::scene::node::{Kind, Parameter, Value};
use crate::{Location, Result};

/// A node whose children are places in a list or ids.
pub(super) struct Draft {
    pub(super) kind: Kind,
    pub(super) plugin: String,
    pub(super) id: Option<String>,
    pub(super) location: Location,
    pub(super) parameters: Vec<Parameter>,
    pub(super) children: Vec<DraftChild>,
    pub(super) folder: Arc<Folder>,
    names: HashSet<String>,
}

pub(super) struct DraftChild {
    pub(super) name: Option<String>,
    pub(super) target: Target,
    pub(super) location: Location,
}

pub(super) enum Target {
    /// A place in [`Drafts::all`].
    Draft(usize),
    Id(String),
}

/// All nodes of a scene; the first one is the root.
#[derive(Default)]
pub(super) struct Drafts {
    pub(super) all: Vec<Draft>,
    pub(super) ids: BTreeMap<String, (usize, Location)>,
}

impl Drafts {
    /// A new draft for an element.
    pub(super) fn push(&mut self, kind: Kind, element: &Element<'_>, folder: &Arc<Folder>) -> Result<usize> {
        let place = self.all.len();
        let id = element.get("id").map(str::to_owned);
        if let Some(id) = &id {
            self.name_node(id, place, element)?;
        }
        let plugin = element.required("type").to_owned();
        if plugin.is_empty() && kind != Kind::Scene {
            return Err(element.error("the attribute 'type' is empty"));
        }
        self.all.push(Draft {
            kind,
            plugin: if kind == Kind::Scene { String::new() } else { plugin },
            id,
            location: element.location.clone(),
            parameters: Vec::new(),
            children: Vec::new(),
            folder: folder.clone(),
            names: HashSet::new(),
        });
        Ok(place)
    }

    /// Give an id to a draft.
    pub(super) fn name_node(&mut self, id: &str, place: usize, element: &Element<'_>) -> Result<()> {
        if id.is_empty() {
            return Err(element.error("an id is empty"));
        }
        let previous = self.ids.insert(id.to_owned(), (place, element.location.clone()));
        match previous {
            None => Ok(()),
            Some((_, first)) => Err(element.error(format_args!("the id '{id}' is already taken at {first}"))),
        }
    }

    /// Names must be unique among the parameters and children of a node; `_arg_…` stands for no name.
    fn claim(&mut self, parent: usize, name: &str, element: &Element<'_>) -> Result<()> {
        if self.all[parent].names.insert(name.to_owned()) {
            return Ok(());
        }
        Err(element.error(format_args!("the name '{name}' is given twice in one plugin")))
    }

    /// A nested or referenced plugin of `parent`.
    pub(super) fn attach(
        &mut self,
        parent: usize,
        name: Option<&str>,
        target: Target,
        element: &Element<'_>,
    ) -> Result<()> {
        let name = name.filter(|name| !name.is_empty() && !name.starts_with("_arg_"));
        if let Some(name) = name {
            self.claim(parent, name, element)?;
        }
        let child = DraftChild { name: name.map(str::to_owned), target, location: element.location.clone() };
        self.all[parent].children.push(child);
        Ok(())
    }

    /// A parameter of `parent`, under the element's name.
    pub(super) fn set(&mut self, parent: usize, element: &Element<'_>, value: Value) -> Result<()> {
        let name = element.required("name");
        if name.is_empty() {
            return Err(element.error("the attribute 'name' is empty"));
        }
        self.claim(parent, name, element)?;
        let parameter = Parameter { name: name.to_owned(), value, location: element.location.clone() };
        self.all[parent].parameters.push(parameter);
        Ok(())
    }
}
