//! A tree checked against a type, past the first fault.
//!
//! serde stops at the first fault. So the faulty entry is taken out of the tree and the rest is checked again; a fault that
//! only exists because something was taken out is not reported.

use super::de::NodeDeserializer;
use super::explain::{self, Special};
use super::fault::{Fault, Kind};
use super::node;
use super::{Document, Part, words};
use crate::diagnostic::{Diagnostic, codes};
use serde::de::DeserializeOwned;

/// Who made more mistakes than this fixes the first ones first.
const MOST: usize = 20;

impl Document {
    /// The document as a `T`. `special` words the faults that mean something particular in this kind of file.
    ///
    /// # Errors
    /// Everything that is wrong, in the order of the text; at most 20 findings.
    pub fn check<T: DeserializeOwned>(&self, special: Special) -> Result<T, Vec<Diagnostic>> {
        let mut tree = self.root.clone();
        let mut found = self.duplicates();
        for (path, _, later) in node::duplicates(&self.root) {
            tree.remove(&[path.as_slice(), &[later]].concat());
        }
        let mut removed: Vec<Vec<usize>> = Vec::new();
        while found.len() < MOST {
            let fault = match T::deserialize(NodeDeserializer(&tree)) {
                Ok(value) if found.is_empty() => return Ok(value),
                Ok(_) => break,
                Err(fault) => outermost_first(fault),
            };
            if !self.follows_from(&fault, &removed) {
                found.push(explain::diagnostic(self, &fault, special));
            }
            if !tree.remove(&fault.path) {
                break;
            }
            removed.push(fault.path);
        }
        found.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
        found.dedup_by(|a, b| {
            a.message == b.message
                && a.labels.first().map(|label| label.span) == b.labels.first().map(|label| label.span)
        });
        Err(found)
    }

    /// Whether the node is only wrong because something in it was taken out: the key itself, or a misspelling of it.
    fn follows_from(&self, fault: &Fault, removed: &[Vec<usize>]) -> bool {
        let mut inside = removed.iter().filter_map(|path| {
            let (last, parent) = path.split_last()?;
            (parent == fault.path).then_some(*last)
        });
        match &fault.kind {
            Kind::Missing { name } => {
                let node = self.root.at(&fault.path);
                let is_it = |key: &str| key == *name || words::meant(key, &[name]).is_some();
                inside.any(|index| {
                    node.and_then(|node| node.entry(index)).is_some_and(|entry| is_it(&entry.key))
                })
            }
            Kind::UnknownKey { .. } | Kind::UnknownChoice { .. } => false,
            _ => inside.next().is_some(),
        }
    }

    fn duplicates(&self) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        for (path, first, later) in node::duplicates(&self.root).into_iter().take(MOST) {
            let key = |index| self.span(&[path.as_slice(), &[index]].concat(), Part::Key).unwrap_or_default();
            let name = self.root.at(&path).and_then(|map| map.entry(later)).map_or("", |entry| &entry.key);
            found.push(
                Diagnostic::new(codes::YAML_DUPLICATE_KEY, format!("`{name}` is given twice"))
                    .label(&self.source, key(later), "given again here")
                    .label(&self.source, key(first), "given first here"),
            );
        }
        found
    }
}

fn outermost_first(mut fault: Fault) -> Fault {
    fault.path.reverse();
    fault
}
