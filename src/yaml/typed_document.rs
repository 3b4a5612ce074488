//! This module checks a tree against a type and continues after the first fault.
//!
//! serde stops at the first fault. So the faulty entry is removed from the tree, and the rest is checked
//! again. A fault that only exists because something was removed is not reported.

use super::fault_diagnostics::{self, FaultWording};
use super::node_deserializer::NodeDeserializer;
use super::yaml_fault::{YamlFault, YamlFaultKind};
use super::yaml_tree;
use super::{KeyOrValue, YamlDocument};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::parameters::find_similar_name;
use serde::de::DeserializeOwned;

/// The largest number of faults that are reported. After so many, the first ones should be fixed first.
const MOST_FAULTS: usize = 20;

impl YamlDocument {
    /// Converts the document to a `T`. `special` words the faults that have a particular meaning in this kind
    /// of file.
    ///
    /// # Errors
    /// Returns all faults in the order of the text, at most 20 findings.
    pub(crate) fn deserialize_checked<T: DeserializeOwned>(
        &self,
        special: FaultWording,
    ) -> Result<T, Failure> {
        let mut tree = self.root.clone();
        let mut found = self.find_duplicate_keys();
        for (path, _, later) in yaml_tree::find_duplicate_entries(&self.root) {
            tree.remove_at_path(&[path.as_slice(), &[later]].concat());
        }
        let mut removed: Vec<Vec<usize>> = Vec::new();
        while found.len() < MOST_FAULTS {
            let fault = match T::deserialize(NodeDeserializer(&tree)) {
                Ok(value) if found.is_empty() => return Ok(value),
                Ok(_) => break,
                Err(fault) => reverse_path(fault),
            };
            if !self.follows_from(&fault, &removed) {
                found.push(fault_diagnostics::render_fault(self, &fault, special));
            }
            if !tree.remove_at_path(&fault.path) {
                break;
            }
            removed.push(fault.path);
        }
        found.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
        found.dedup_by(|a, b| {
            a.message == b.message
                && a.labels.first().map(|label| label.span) == b.labels.first().map(|label| label.span)
        });
        Err(found.into())
    }

    /// Returns whether a fault only follows from a removed entry: the missing key itself was removed, or a
    /// misspelling of it.
    fn follows_from(&self, fault: &YamlFault, removed: &[Vec<usize>]) -> bool {
        let mut inside = removed.iter().filter_map(|path| {
            let (last, parent) = path.split_last()?;
            (parent == fault.path).then_some(*last)
        });
        match &fault.kind {
            YamlFaultKind::Missing { name } => {
                let node = self.root.node_at_path(&fault.path);
                let is_it = |key: &str| key == *name || find_similar_name(key, &[name]).is_some();
                inside.any(|index| {
                    node.and_then(|node| node.entry_at(index)).is_some_and(|entry| is_it(&entry.key))
                })
            }
            YamlFaultKind::UnknownKey { .. } | YamlFaultKind::UnknownChoice { .. } => false,
            _ => inside.next().is_some(),
        }
    }

    fn find_duplicate_keys(&self) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        for (path, first, later) in
            yaml_tree::find_duplicate_entries(&self.root).into_iter().take(MOST_FAULTS)
        {
            let key = |index| {
                self.node_span(&[path.as_slice(), &[index]].concat(), KeyOrValue::Key).unwrap_or_default()
            };
            let name = self
                .root
                .node_at_path(&path)
                .and_then(|map| map.entry_at(later))
                .map_or("", |entry| &entry.key);
            found.push(
                Diagnostic::new(codes::YAML_DUPLICATE_KEY, format!("`{name}` is given twice"))
                    .with_label(&self.source, key(later), "given again here")
                    .with_label(&self.source, key(first), "given first here"),
            );
        }
        found
    }
}

fn reverse_path(mut fault: YamlFault) -> YamlFault {
    fault.path.reverse();
    fault
}
