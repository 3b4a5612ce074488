//! This module reads the numbers of statements with their roles, in memory that the next statement uses again.

use super::{shortcut, split_statement};
use crate::program::record::add_path_roles;
use crate::program::{NumberRole, Record, StatementField};
use std::ops::Range;

/// The numbers of one statement.
#[derive(Debug, Default)]
pub(crate) struct StatementNumbers {
    /// Their places in the statement's text and their values, in the order of the text.
    pub places: Vec<(Range<usize>, f64)>,
    /// Their roles.
    pub roles: Vec<NumberRole>,
    /// An empty list, whose memory the next statement's fields take.
    pub(crate) spare_fields: Vec<StatementField>,
}

impl StatementNumbers {
    /// Reads the numbers of a text, whose meaning is `record`, and forgets those of the text before.
    pub(crate) fn read(&mut self, record: &Record, text: &[u8]) {
        self.places.clear();
        self.roles.clear();
        if let Record::Goto(goto) = record {
            add_path_roles(goto.axis.is_some(), &mut self.roles);
            if shortcut::add_plain_goto_numbers(text, &mut self.places) {
                return;
            }
        }
        let (mut syntax, _) = split_statement(text, &mut self.spare_fields);
        syntax.add_numbers(&mut self.places);
        if self.roles.is_empty() {
            self.roles = record.number_roles(&syntax);
        }
        self.spare_fields = std::mem::take(&mut syntax.fields);
        self.spare_fields.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_of_the_statement_before_leaves_nothing_behind() {
        let mut numbers = StatementNumbers::default();
        for text in [
            "GOTO/1.5,-2,3\n",
            "CIRCLE/1,2,3,0,0,1,5\n",
            "GOTO/1,2,3,0,0,1 $$ c\n",
            "RAPID\n",
            "FEDRAT/MMPM,800.\n",
            "GOTO/1,2,3\n",
        ] {
            let text = text.as_bytes();
            let (record, _) = crate::parse::read_record(text).unwrap();
            numbers.read(&record, text);
            assert_eq!(numbers.places, crate::parse::statement_numbers(text));
            assert_eq!(numbers.roles, crate::parse::number_roles(&record, text));
        }
    }
}
