//! References become shared nodes.

use std::sync::Arc;

use super::DEPTH_LIMIT;
use super::drafts::{Draft, Drafts, Target};
use crate::scene::node::{Child, Node};
use crate::{Error, Location, Result};

/// How far a draft has come.
enum State {
    Waiting(Box<Draft>),
    /// Its children are being resolved: who refers to it now closes a circle.
    Open,
    /// Finished, with the height of the tree below it.
    Done(Arc<Node>, usize),
}

struct Resolver {
    states: Vec<State>,
    ids: std::collections::BTreeMap<String, (usize, Location)>,
    /// The names of the drafts that are open, outermost first.
    open: Vec<String>,
}

/// The tree below the first draft.
pub(super) fn resolve(drafts: Drafts) -> Result<Arc<Node>> {
    let states = drafts.all.into_iter().map(|draft| State::Waiting(Box::new(draft))).collect();
    let mut resolver = Resolver { states, ids: drafts.ids, open: Vec::new() };
    resolver.node(0, &Location::default()).map(|(node, _)| node)
}

impl Resolver {
    /// The node at `place`, referred to from `from`, and its height.
    fn node(&mut self, place: usize, from: &Location) -> Result<(Arc<Node>, usize)> {
        if let State::Done(node, height) = &self.states[place] {
            return Ok((node.clone(), *height));
        }
        let error = |message: String| Error::Scene { location: from.clone(), message };
        let State::Waiting(draft) = std::mem::replace(&mut self.states[place], State::Open) else {
            return Err(error(format!("objects refer to each other in a circle: {}", self.open.join(" → "))));
        };
        if self.open.len() > DEPTH_LIMIT {
            return Err(error(format!("nested deeper than {DEPTH_LIMIT} through references")));
        }
        self.open.push(draft.id.clone().unwrap_or_else(|| draft.kind.element().to_owned()));
        let mut children = Vec::with_capacity(draft.children.len());
        let mut height = 0;
        for child in draft.children {
            let place = match child.target {
                Target::Draft(place) => place,
                Target::Id(id) => self.place(&id, &child.location)?,
            };
            let (node, below) = self.node(place, &child.location)?;
            height = height.max(below + 1);
            children.push(Child { name: child.name, node, location: child.location });
        }
        self.open.pop();
        if height > DEPTH_LIMIT {
            return Err(error(format!("nested deeper than {DEPTH_LIMIT} through references")));
        }
        let node = Arc::new(Node {
            kind: draft.kind,
            plugin: draft.plugin,
            id: draft.id,
            location: draft.location,
            parameters: draft.parameters,
            children,
            folder: draft.folder,
        });
        self.states[place] = State::Done(node.clone(), height);
        Ok((node, height))
    }

    fn place(&self, id: &str, from: &Location) -> Result<usize> {
        if let Some((place, _)) = self.ids.get(id) {
            return Ok(*place);
        }
        let similar = similar(id, self.ids.keys());
        let hint =
            if similar.is_empty() { String::new() } else { format!("; similar: {}", similar.join(", ")) };
        let message = format!("<ref>: no object has the id '{}'{hint}", super::values::shorten(id));
        Err(Error::Scene { location: from.clone(), message })
    }
}

/// Up to five known ids that are the most similar to `id`, however little that is.
fn similar<'a>(id: &str, known: impl Iterator<Item = &'a String>) -> Vec<&'a str> {
    // Long ids and long lists would only cost time.
    let mut rated: Vec<(usize, &str)> = known
        .filter(|known| known.len() <= 64)
        .take(2000)
        .map(|known| (distance(id, known), &known[..]))
        .collect();
    rated.sort_unstable();
    rated.into_iter().take(5).map(|(_, known)| known).collect()
}

/// Edit distance (Levenshtein) of the first 64 letters, without regard to case.
fn distance(a: &str, b: &str) -> usize {
    let letters = |text: &str| text.chars().take(64).map(|c| c.to_ascii_lowercase()).collect::<Vec<_>>();
    let (a, b) = (letters(a), letters(b));
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
