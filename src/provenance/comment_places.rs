//! This module finds where a comment may stand: directly before a record, but never inside a group that
//! readers expect in one piece.

use crate::parse;
use crate::program::{Dialect, InsertionPoint, Program, ProvenanceComment, Record, Statement, StatementId};

/// The places of comments for each statement of a program.
pub(super) struct CommentPlaces {
    /// The place before each statement itself, or before the first one of its group. A deleted statement has
    /// the place of the next live one.
    places: Vec<InsertionPoint>,
    header: InsertionPoint,
}

impl CommentPlaces {
    /// Finds the places for a whole program.
    pub(super) fn from_program(program: &Program) -> Self {
        let places = program.statement_ids().map(StatementId::before).collect();
        let mut found = Self { places, header: program.start() };
        let mut last: Option<(StatementId, &Statement)> = None;
        for (id, statement) in program.live_statements() {
            if let Some((last, above)) = last
                && must_stay_together(program, above, statement)
            {
                found.move_comments(id, found.comment_position(last));
            }
            last = Some((id, statement));
        }
        if program.dialect() == Dialect::Nx {
            found.move_behind_heads(program);
        }
        let mut next = program.end();
        for (id, statement) in program.numbered_statements().rev() {
            if statement.is_live() {
                next = found.comment_position(id);
            } else {
                found.move_comments(id, next);
            }
        }
        found.header = find_header_position(program, &found);
        found
    }

    /// Returns the place of comments about a statement.
    pub(super) fn comment_position(&self, id: StatementId) -> InsertionPoint {
        let place = self.places.get(id.index()).copied();
        debug_assert!(place.is_some(), "{id:?} belongs to another program");
        place.unwrap_or(id.before())
    }

    /// Returns the place of the header.
    pub(super) fn header_position(&self) -> InsertionPoint {
        self.header
    }

    fn move_comments(&mut self, id: StatementId, to: InsertionPoint) {
        match self.places.get_mut(id.index()) {
            Some(place) => *place = to,
            None => debug_assert!(false, "{id:?} belongs to another program"),
        }
    }

    /// Keeps the head of an NX operation, from TOOL PATH to MSYS, in one piece, with nothing before it, where
    /// no operation is. Comments about it come after it, beside NX's own `$$ centerline data`.
    fn move_behind_heads(&mut self, program: &Program) {
        let mut head: Vec<StatementId> = Vec::new();
        for (id, statement) in program.live_statements() {
            match statement.record() {
                Record::ToolData(_) | Record::Frame(_) | Record::Comment if !head.is_empty() => head.push(id),
                Record::OperationStart(_) => {
                    head.drain(..).for_each(|inside| self.move_comments(inside, id.before()));
                    head.push(id);
                }
                _ => head.drain(..).for_each(|inside| self.move_comments(inside, id.before())),
            }
        }
        head.drain(..).for_each(|inside| self.move_comments(inside, program.end()));
    }
}

/// Returns whether no comment may come between two consecutive statements.
fn must_stay_together(program: &Program, above: &Statement, below: &Statement) -> bool {
    let dialect = program.dialect();
    let text = program.statement_text(above).trim_ascii_start();
    let starts = |words: &[&[u8]]| words.iter().any(|word| text.starts_with(word));
    let goes_on = match above.record() {
        // A record that announces a motion belongs to the motion.
        Record::Circle(_) | Record::MoveArc(_) | Record::StartDirection(_) | Record::Rapid => true,
        Record::Nurbs | Record::Knot(_) => true,
        Record::Control(_) => matches!(below.record(), Record::Control(_) | Record::Knot(_)),
        Record::DriveArc(_) | Record::AxialArc(_) => {
            matches!(below.record(), Record::DriveArc(_) | Record::AxialArc(_) | Record::StartDirection(_))
        }
        Record::Cycle(_) | Record::CycleOn => true,
        // CATIA's frame consists of the mark, a name and three rows.
        Record::FrameMark => true,
        // CATIA's arcs consist of tolerances, AUTOPS, and pairs of INDIRV and TLON.
        Record::Known => dialect.has_columns() && starts(&[b"AUTOPS", b"INTOL", b"OUTTOL"]),
        // Labels of Makino and CAMWorks belong to the record that follows.
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
            // A line of bare numbers continues the GOTO before it.
            Record::Points(_) => program
                .statement_text(below)
                .trim_ascii_start()
                .first()
                .is_some_and(|byte| !byte.is_ascii_alphabetic()),
            _ => false,
        }
}

/// Returns the place where systems have comments of their own: after NX's first head, after PARTNO, after the
/// record with which Makino and CAMWorks files must begin, or else before the first record that is no
/// comment. Headers of earlier runs come first.
fn find_header_position(program: &Program, places: &CommentPlaces) -> InsertionPoint {
    let mut found = None;
    for (id, statement) in program.live_statements() {
        let first_of_file = match (program.dialect(), statement.record()) {
            (Dialect::Nx, Record::OperationStart(_)) => {
                found = Some(places.comment_position(id));
                break;
            }
            (Dialect::MakinoFf, Record::Text) => major_word(program, statement) == "PPRINT",
            (Dialect::CamWorks, Record::Units(_)) => true,
            (_, Record::Text) => major_word(program, statement) == "PARTNO",
            _ => false,
        };
        if first_of_file {
            found = Some(id.after());
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
        program
            .live_statements()
            .find(|(_, statement)| !says_nothing(statement.record()))
            .map(|(id, _)| id.before())
    };
    // A file that only consists of comments has its header before them.
    let from = found.or_else(first).unwrap_or(program.start());
    let own = |statement: &Statement| {
        ProvenanceComment::from_text(program.statement_text(statement)) == Some(ProvenanceComment::Header)
    };
    let rest = program.live_statements().filter(|(id, _)| id.before() >= from);
    let next = rest.skip_while(|(_, statement)| own(statement)).map(|(id, _)| id).next();
    next.map_or(program.end(), |next| places.comment_position(next))
}

fn major_word(program: &Program, statement: &Statement) -> String {
    parse::syntax(program.statement_text(statement)).major_word().into_owned()
}
