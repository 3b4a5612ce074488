//! Where a comment may stand: directly before a record, but never inside a group that readers expect in one piece.

use crate::parse;
use crate::program::{Dialect, Program, ProvenanceComment, Record, Statement};

/// For each statement of a program, where its comments stand.
pub(super) struct CommentPlaces {
    /// The statement before which they stand: itself, or the first of its group; of a deleted one, that of the next live one.
    before: Vec<usize>,
    header: usize,
}

impl CommentPlaces {
    /// Looks at a whole program.
    pub(super) fn from_program(program: &Program) -> Self {
        let end = program.statements().len();
        let mut before: Vec<usize> = (0..end).collect();
        let mut last: Option<(usize, &Statement)> = None;
        for (index, statement) in program.live_statements() {
            if let Some((last, above)) = last
                && must_stay_together(program, above, statement)
                && let Some(start) = before.get(last).copied()
                && let Some(place) = before.get_mut(index)
            {
                *place = start;
            }
            last = Some((index, statement));
        }
        if program.dialect() == Dialect::Nx {
            move_behind_heads(program, &mut before);
        }
        let mut next = end;
        for (statement, place) in program.statements().iter().zip(&mut before).rev() {
            if statement.is_live() {
                next = *place;
            } else {
                *place = next;
            }
        }
        let mut places = Self { before, header: 0 };
        places.header = find_header_position(program, &places);
        places
    }

    /// The statement before which comments about a statement stand.
    pub(super) fn comment_position(&self, index: usize) -> usize {
        self.before.get(index).copied().unwrap_or(self.before.len())
    }

    /// The statement before which the header stands.
    pub(super) fn header_position(&self) -> usize {
        self.header
    }
}

/// Whether no comment may come between two statements that follow each other.
fn must_stay_together(program: &Program, above: &Statement, below: &Statement) -> bool {
    let dialect = program.dialect();
    let text = program.statement_text(above).trim_ascii_start();
    let starts = |words: &[&[u8]]| words.iter().any(|word| text.starts_with(word));
    let goes_on = match above.record() {
        // What announces a motion, and the motion.
        Record::Circle(_) | Record::MoveArc(_) | Record::StartDirection(_) | Record::Rapid => true,
        Record::Nurbs | Record::Knot(_) => true,
        Record::Control(_) => matches!(below.record(), Record::Control(_) | Record::Knot(_)),
        Record::DriveArc(_) => matches!(below.record(), Record::DriveArc(_) | Record::StartDirection(_)),
        Record::Cycle(_) | Record::CycleOn => true,
        // CATIA's frame: the mark, a name, three rows.
        Record::FrameMark => true,
        // CATIA's arcs: tolerances, AUTOPS, then pairs of INDIRV and TLON.
        Record::Known => dialect.has_columns() && starts(&[b"AUTOPS", b"INTOL", b"OUTTOL"]),
        // Makino's and CAMWorks' labels are about the record that follows.
        Record::Marked(_) | Record::Text => match dialect {
            Dialect::MakinoFf => starts(&[b"PPRINT/MOTION"]),
            Dialect::CamWorks => matches!(above.record(), Record::Marked(_)),
            _ => false,
        },
        _ => false,
    };
    goes_on
        || match below.record() {
            Record::MatrixRow(_) => true,
            // A line of bare numbers goes on with the GOTO before it.
            Record::Points(_) => program
                .statement_text(below)
                .trim_ascii_start()
                .first()
                .is_some_and(|byte| !byte.is_ascii_alphabetic()),
            _ => false,
        }
}

/// The head of an NX operation, TOOL PATH to MSYS, stays in one piece, and nothing comes before it, where no operation is:
/// what is to say about it stands after it, beside NX's own `$$ centerline data`.
fn move_behind_heads(program: &Program, before: &mut [usize]) {
    let mut head: Vec<usize> = Vec::new();
    let end = before.len();
    let mut close = |head: &mut Vec<usize>, next: usize| {
        for inside in head.drain(..) {
            if let Some(place) = before.get_mut(inside) {
                *place = next;
            }
        }
    };
    for (index, statement) in program.live_statements() {
        match statement.record() {
            Record::ToolData(_) | Record::Frame(_) | Record::Comment if !head.is_empty() => head.push(index),
            Record::OperationStart(_) => {
                close(&mut head, index);
                head.push(index);
            }
            _ => close(&mut head, index),
        }
    }
    close(&mut head, end);
}

/// Where systems have comments of their own: after NX's first head; after PARTNO; after the record that Makino and CAMWorks files
/// must begin with; else before the first record that is no comment. Headers of earlier runs come first.
fn find_header_position(program: &Program, places: &CommentPlaces) -> usize {
    let mut found = None;
    for (index, statement) in program.live_statements() {
        let first_of_file = match (program.dialect(), statement.record()) {
            (Dialect::Nx, Record::OperationStart(_)) => {
                found = Some(places.comment_position(index));
                break;
            }
            (Dialect::MakinoFf, Record::Text) => major_word(program, statement) == "PPRINT",
            (Dialect::CamWorks, Record::Units(_)) => true,
            (_, Record::Text) => major_word(program, statement) == "PARTNO",
            _ => false,
        };
        if first_of_file {
            found = Some(index + 1);
            break;
        }
        if statement.record().is_motion() {
            break;
        }
    }
    let says_nothing = |record: &Record| {
        matches!(
            record,
            Record::ByteOrderMark
                | Record::Blank
                | Record::Comment
                | Record::FrameMark
                | Record::MatrixRow(_)
        )
    };
    let first = || {
        program.live_statements().find(|(_, statement)| !says_nothing(statement.record())).map(|(at, _)| at)
    };
    let from = found.or_else(first).unwrap_or_default();
    let own = |statement: &Statement| {
        ProvenanceComment::from_text(program.statement_text(statement)) == Some(ProvenanceComment::Header)
    };
    let rest = program.live_statements().filter(|(index, _)| *index >= from);
    let next = rest.skip_while(|(_, statement)| own(statement)).map(|(index, _)| index).next();
    next.map_or(program.statements().len(), |next| places.comment_position(next))
}

fn major_word(program: &Program, statement: &Statement) -> String {
    parse::syntax(program.statement_text(statement)).major_word()
}
