//! This module follows lines through edits: where a line of the text now stood when the program was read.

use super::edited_text::LineEdit;

/// The lines that were edited since the program was read, as one block. Lines before it stand where they stood, lines
/// behind it are moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EditedLines {
    block: Option<LineEdit>,
}

impl EditedLines {
    /// Adds an edit of the text as it is now.
    pub fn add(&mut self, edit: LineEdit) {
        let Some(block) = self.block else {
            self.block = Some(edit);
            return;
        };
        let (block_end, edit_end) = (block.first + block.new_lines, edit.first + edit.old_lines);
        let first = block.first.min(edit.first);
        // Both ends are lines of the text between the two edits.
        let end = block_end.max(edit_end);
        let old_lines = block.old_lines + (end - first) - block.new_lines;
        let new_lines = edit.new_lines + (end - first) - edit.old_lines;
        self.block = Some(LineEdit { first, old_lines, new_lines });
    }

    /// Returns where a line stood, or `None` for a line that was edited.
    pub fn line_before(&self, line: u32) -> Option<u32> {
        match self.block {
            Some(block) if line >= block.first + block.new_lines => {
                Some((line - block.new_lines).saturating_add(block.old_lines))
            }
            Some(block) if line >= block.first => None,
            _ => Some(line),
        }
    }

    /// Returns where a line of the program stands now, or `None` for a line that was edited.
    pub fn line_now(&self, line: u32) -> Option<u32> {
        match self.block {
            Some(block) if line >= block.first + block.old_lines => {
                Some((line - block.old_lines).saturating_add(block.new_lines))
            }
            Some(block) if line >= block.first => None,
            _ => Some(line),
        }
    }

    /// Returns the last line before the edits, if a line was edited and there is one.
    pub fn line_in_front(&self) -> Option<u32> {
        self.block.and_then(|block| block.first.checked_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::property;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(property(256))]
        /// Lines that no edit touched are found again; numbers stand for lines of the first text.
        #[test]
        fn untouched_lines_are_followed(
            edits in proptest::collection::vec((0_usize..20, 1_usize..4, 1_usize..4), 0..6)
        ) {
            let mut lines: Vec<Option<u32>> = (0..20).map(Some).collect();
            let mut followed = EditedLines::default();
            for (first, old, new) in edits {
                let first = first.min(lines.len() - 1);
                let old = old.min(lines.len() - first);
                lines.splice(first..first + old, vec![None; new]);
                followed.add(LineEdit { first: first as u32, old_lines: old as u32, new_lines: new as u32 });
            }
            for (now, before) in lines.iter().enumerate() {
                let told = followed.line_before(now as u32);
                // One block stands for all edits, so lines between two of them may count as edited.
                prop_assert!(told.is_none() || told == *before, "{now}: {told:?} is {before:?}");
                if let Some(before) = told {
                    prop_assert_eq!(followed.line_now(before), Some(now as u32));
                }
            }
            if followed == EditedLines::default() {
                prop_assert_eq!(followed.line_before(7), Some(7));
            }
        }
    }
}
