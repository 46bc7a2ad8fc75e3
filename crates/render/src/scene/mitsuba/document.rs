//! An XML file: its elements with their attributes substituted, and the line of everything.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use roxmltree::{Document, ParsingOptions};

use super::NODES_LIMIT;
use super::parameters::Parameters;
use crate::{Error, Location, Result};

/// A file whose lines can be counted.
pub(super) struct Source {
    pub(super) file: Arc<PathBuf>,
    newlines: Vec<usize>,
}

impl Source {
    pub(super) fn new(path: &Path, text: &str) -> Self {
        let newlines = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at);
        Self { file: Arc::new(path.to_owned()), newlines: newlines.collect() }
    }

    pub(super) fn location(&self, offset: usize) -> Location {
        let line = self.newlines.partition_point(|newline| *newline < offset) as u32 + 1;
        Location { file: self.file.clone(), line }
    }
}

/// Parse the text of a file. Document types, and with them entities, are refused.
pub(super) fn parse<'t>(text: &'t str, source: &Source) -> Result<Document<'t>> {
    let options = ParsingOptions { allow_dtd: false, nodes_limit: NODES_LIMIT, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| Error::Scene {
        location: Location { file: source.file.clone(), line: error.pos().row },
        message: format!("not well-formed XML: {error}"),
    })
}

/// An element whose attributes had their parameters replaced.
pub(super) struct Element<'t> {
    pub(super) name: &'t str,
    pub(super) location: Location,
    attributes: Vec<(&'t str, Cow<'t, str>)>,
}

impl<'t> Element<'t> {
    pub(super) fn read(
        node: roxmltree::Node<'t, 't>,
        source: &Source,
        parameters: &mut Parameters,
    ) -> Result<Self> {
        let name = node.tag_name().name();
        let mut element =
            Self { name, location: source.location(node.range().start), attributes: Vec::new() };
        for attribute in node.attributes() {
            let value = parameters.substitute(attribute.value()).map_err(|message| element.error(message))?;
            element.attributes.push((attribute.name(), value));
        }
        Ok(element)
    }

    /// An error at this element.
    pub(super) fn error(&self, message: impl std::fmt::Display) -> Error {
        Error::Scene { location: self.location.clone(), message: format!("<{}>: {message}", self.name) }
    }

    /// Insist on these attributes and on no others.
    pub(super) fn allow(&self, required: &[&str], optional: &[&str]) -> Result<()> {
        if let Some(missing) = required.iter().find(|name| self.get(name).is_none()) {
            return Err(self.error(format_args!("the attribute '{missing}' is missing")));
        }
        let known = |name: &str| required.contains(&name) || optional.contains(&name);
        match self.attributes.iter().find(|(name, _)| !known(name)) {
            None => Ok(()),
            Some((name, _)) => {
                let all = [required, optional].concat().join(", ");
                Err(self.error(format_args!("unknown attribute '{name}'; known: {all}")))
            }
        }
    }

    /// An attribute, if given.
    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(known, _)| *known == name).map(|(_, value)| &value[..])
    }

    /// An attribute that [`Element::allow`] required.
    pub(super) fn required(&self, name: &str) -> &str {
        self.get(name).unwrap_or_default()
    }
}
