//! `<default>` and `$name`: the parameters of a scene.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// All substituted text together, in bytes: parameters made of parameters grow exponentially.
const SUBSTITUTED_LIMIT: usize = 16 << 20;

/// What every substitution costs of this limit, so that empty ones end too.
const SUBSTITUTION_COST: usize = 16;
/// The longest name of a parameter.
const MAX_NAME: usize = 64;

/// What `$name` stands for, and which names were heard of.
pub(super) struct Parameters {
    values: BTreeMap<String, String>,
    given: BTreeSet<String>,
    known: BTreeSet<String>,
    left: usize,
}

impl Parameters {
    pub(super) fn new(given: &BTreeMap<String, String>) -> Self {
        Self {
            values: given.clone(),
            given: given.keys().cloned().collect(),
            known: BTreeSet::new(),
            left: SUBSTITUTED_LIMIT,
        }
    }

    /// A `<default>`: the first one counts, unless a value was given from outside.
    pub(super) fn default(&mut self, name: &str, value: &str) -> Result<(), String> {
        if name.is_empty() || name.len() > MAX_NAME {
            return Err(format!("a parameter's name must have 1 to {MAX_NAME} letters"));
        }
        self.known.insert(name.to_owned());
        self.values.entry(name.to_owned()).or_insert_with(|| value.to_owned());
        Ok(())
    }

    /// Replace every `$name`; `\$` is a dollar sign. Where several names fit, the longest counts. What is put in is not
    /// looked at again.
    pub(super) fn substitute<'t>(&mut self, text: &'t str) -> Result<Cow<'t, str>, String> {
        if !text.contains('$') {
            return Ok(Cow::Borrowed(text));
        }
        let mut out = String::new();
        let mut rest = text;
        while let Some(at) = rest.find('$') {
            let (before, after) = (&rest[..at], &rest[at + 1..]);
            rest = after;
            if let Some(escaped) = before.strip_suffix('\\') {
                out.push_str(escaped);
                out.push('$');
                continue;
            }
            out.push_str(before);
            let (name, value) = self.longest(after).ok_or_else(|| self.unknown(after))?;
            out.push_str(value);
            let cost = value.len() + SUBSTITUTION_COST;
            self.left =
                self.left.checked_sub(cost).ok_or("parameters are used too often or grow too large")?;
            self.known.insert(name.to_owned());
            rest = &after[name.len()..];
        }
        out.push_str(rest);
        Ok(Cow::Owned(out))
    }

    /// The longest start of `text` that is a parameter's name, and its value.
    fn longest<'t>(&self, text: &'t str) -> Option<(&'t str, &str)> {
        let ends = (1..=text.len().min(MAX_NAME)).rev().filter(|end| text.is_char_boundary(*end));
        ends.map(|end| &text[..end]).find_map(|name| self.values.get(name).map(|value| (name, &value[..])))
    }

    fn unknown(&self, text: &str) -> String {
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
        format!("undefined parameter '${}'; {}", &text[..end], self.list())
    }

    fn list(&self) -> String {
        match self.known.len() {
            0 => "the scene has no parameters".into(),
            _ => format!("known: {}", self.known.iter().map(String::as_str).collect::<Vec<_>>().join(", ")),
        }
    }

    /// A complaint about a given parameter that the scene never heard of.
    pub(super) fn unused(&self) -> Option<String> {
        let unused = self.given.difference(&self.known).next()?;
        Some(format!("unknown parameter '{unused}'; {}", self.list()))
    }
}
