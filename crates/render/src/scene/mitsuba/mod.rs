//! Mitsuba 3 XML to a tree of plain data.
//!
//! Everything Mitsuba 3.9 documents of the format: `<default>` and `$name`, `<include>`, `<alias>`, `<path>`, `<ref>`
//! (also to what follows), `<boolean> <integer> <float> <string> <point> <vector> <rgb> <spectrum> <transform>` and the
//! elements of all kinds of plugins. Stricter than Mitsuba where a file would not mean what its author thinks: numbers must
//! be finite, `to_world` invertible, names and ids unique, and a parameter that nobody uses is an error.
//!
//! Scenes come from others. Entities are off; sizes, nesting, includes and substitutions are limited, so that a small file
//! cannot become a large tree; files outside of the scene's folder are refused unless allowed.

mod document;
mod drafts;
mod parameters;
mod reader;
mod resolve;
mod spectrum;
mod transform;
mod values;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use crate::Result;
use crate::scene::node::Node;

/// How a scene is loaded.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Values for `$name`, which win over the scene's own `<default>`.
    pub parameters: BTreeMap<String, String>,
    /// Let the scene read files outside of its folder. Only for scenes you trust.
    pub allow_outside: bool,
}

/// The largest scene file, in bytes.
const FILE_LIMIT: u64 = 64 << 20;
/// All files of a scene together, in bytes.
const TOTAL_LIMIT: u64 = 256 << 20;
/// The most XML nodes (elements, text, comments) of one file.
const NODES_LIMIT: u32 = 4_000_000;
/// How deep plugins may be nested, through includes and references too.
const DEPTH_LIMIT: usize = 128;
/// How deep includes may be nested, as in Mitsuba.
const INCLUDE_DEPTH_LIMIT: usize = 15;
/// How many includes there may be, repeated ones counted.
const INCLUDE_LIMIT: usize = 1000;

/// Read a scene. The root of the tree has [`Kind::Scene`](crate::scene::node::Kind::Scene); its children are all top-level
/// plugins in file order, also those that are only there to be referred to.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Arc<Node>> {
    let drafts = reader::read(path, options)?;
    resolve::resolve(drafts)
}
