//! This module writes feeds. When motions want other feeds than the programmed ones, it decides which FEDRATs
//! to change and where to insert new ones.
//!
//! A FEDRAT governs the feed motions up to the next one. It takes the feed that its first motion wants. Where
//! a later motion wants another feed, a FEDRAT in the form of the governing one is inserted before the first
//! statement of that motion. The next FEDRAT of the file sets its own feed, so programmed feeds return by
//! themselves.

use super::motion_insertion::MotionInsertion;
use super::statement_numbers::{major_word, strip_remark};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::number;
use crate::parse;
use crate::program::motion::Motion;
use crate::program::record::find_lettered_number;
use crate::program::{Feed, FeedUnit, NumberRole, Program, Record, RecordKind, StatementId, StatementKind};
use crate::recipe::MotionFilter;
use crate::source::Span;
use crate::write::{FEED_SHARE, ProgramEditor};
use std::collections::BTreeSet;
use std::ops::Range;

/// The feed that a motion wants, in the unit of the record that governs it.
#[derive(Debug, Clone, Copy)]
struct WantedFeed {
    /// The first statement of the motion, or of the first of several motions that have a statement in common.
    first: StatementId,
    /// The last statement of the motion. The points of one GOTO have it in common, even those in lines of
    /// bare numbers.
    last: StatementId,
    /// The FEDRAT or CYCLE in force.
    governor: StatementId,
    feed: f64,
}

/// The feeds that the motions of a program want.
#[derive(Debug, Default)]
pub struct FeedPlan {
    wishes: Vec<WantedFeed>,
    threads: KeptThreads,
    /// The pitch records of thread passes whose feed was to be changed; they print no feed.
    pitches: BTreeSet<StatementId>,
}

/// What a plan does with feeds that are the pitch times the spindle speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ThreadFeeds {
    Kept,
    Changed,
}

/// Taps and thread passes whose feed a step would have changed. It is the pitch times the spindle speed, so it is kept.
#[derive(Debug, Default)]
struct KeptThreads {
    first: Option<StatementId>,
    holes: BTreeSet<usize>,
    passes: usize,
}

impl KeptThreads {
    fn add_motion(&mut self, motion: &Motion) {
        self.first.get_or_insert(motion.feed_from.unwrap_or(motion.last_statement()));
        match &motion.hole {
            Some((hole, _)) => _ = self.holes.insert(*hole),
            None => self.passes += 1,
        }
    }

    fn describe(&self, program: &Program) -> Option<Diagnostic> {
        let first = self.first?;
        let count = |count: usize, one: &str, many: &str| match count {
            0 => None,
            1 => Some(format!("1 {one}")),
            _ => Some(format!("{count} {many}")),
        };
        let kept: Vec<String> = [
            count(self.holes.len(), "tapped hole", "tapped holes"),
            count(self.passes, "thread pass", "thread passes"),
        ]
        .into_iter()
        .flatten()
        .collect();
        let verb = if self.holes.len() + self.passes == 1 { "was" } else { "were" };
        let message = format!(
            "{} {verb} left alone: the feed is the pitch times the spindle speed",
            kept.join(" and ")
        );
        let finding = Diagnostic::new(codes::THREADS_KEPT, message);
        Some(finding.with_label(program.source(), statement_span(program, first), "keeps its feed"))
    }
}

/// Reports thread passes that were selected by name, but whose feed follows from a pitch that the file states: the pitch
/// is the thread, and no feed is there to be written.
fn describe_pitch_passes(program: &Program, passes: &BTreeSet<StatementId>) -> Option<Diagnostic> {
    let first = *passes.first()?;
    let message = match passes.len() {
        1 => "the feed of this thread pass is not changed: it follows from a PITCH record".to_owned(),
        count => {
            format!("the feeds of {count} thread passes are not changed: they follow from a PITCH record")
        }
    };
    let found = Diagnostic::new(codes::NOT_CHANGED, message);
    Some(found.with_label(program.source(), statement_span(program, first), "left unchanged"))
}

/// Returns whether a step would change the feed of a thread that has none, for the one that its pitch makes.
fn would_change_feed(
    index: usize,
    motion: &Motion,
    want: &mut impl FnMut(usize, &Motion) -> Option<f64>,
) -> bool {
    let feed = Feed { value: 1.0, unit: Some(FeedUnit::PerRevolution) };
    let asked = Motion { feed: Some(feed), ..motion.clone() };
    want(index, &asked).is_some_and(|wanted| wanted != feed.value)
}

impl FeedPlan {
    /// Asks `want` for the feed of every feed motion of a program, in the motion's own unit. `None` means the
    /// programmed feed.
    pub fn for_motions(program: &Program, mut want: impl FnMut(&Motion) -> Option<f64>) -> Self {
        Self::for_numbered_motions(program, |_, motion| want(motion))
    }

    /// Does the same as [`FeedPlan::for_motions`], and also changes the feeds of taps and threads where the
    /// step's `where` asks for them by name.
    pub(super) fn for_selected_motions(
        program: &Program,
        wanted: &MotionFilter,
        mut want: impl FnMut(&Motion) -> Option<f64>,
    ) -> Self {
        let threads = if wanted.threads == Some(true) { ThreadFeeds::Changed } else { ThreadFeeds::Kept };
        Self::collect_wishes(program, threads, |_, motion| want(motion))
    }

    /// Does the same as [`FeedPlan::for_motions`], but `want` also gets the index of the motion among all
    /// motions of the program.
    pub fn for_numbered_motions(program: &Program, want: impl FnMut(usize, &Motion) -> Option<f64>) -> Self {
        Self::collect_wishes(program, ThreadFeeds::Kept, want)
    }

    /// Does the same as [`FeedPlan::for_numbered_motions`], but also changes the feeds of taps and threads: for a step
    /// that changes the spindle speed, so that the pitch stays.
    pub(super) fn for_motions_and_threads(
        program: &Program,
        want: impl FnMut(usize, &Motion) -> Option<f64>,
    ) -> Self {
        Self::collect_wishes(program, ThreadFeeds::Changed, want)
    }

    fn collect_wishes(
        program: &Program,
        thread_feeds: ThreadFeeds,
        mut want: impl FnMut(usize, &Motion) -> Option<f64>,
    ) -> Self {
        let mut wishes = Vec::new();
        let (mut threads, mut pitches) = (KeptThreads::default(), BTreeSet::new());
        let mut insertion = MotionInsertion::new(program);
        let mut number = 0;
        program.motions().for_each_motion(|motion| {
            let place = insertion.find_statements(motion);
            let index = number;
            number += 1;
            if motion.rapid {
                return;
            }
            let Some(feed) = motion.feed.filter(|_| motion.feed_from.is_some() || motion.cuts_thread) else {
                // A tap without a feed is left alone as others are, where the step asks for it.
                if motion.cuts_thread
                    && thread_feeds == ThreadFeeds::Kept
                    && would_change_feed(index, motion, &mut want)
                {
                    threads.add_motion(motion);
                }
                return;
            };
            let mut wanted = want(index, motion).unwrap_or(feed.value);
            if motion.cuts_thread && wanted != feed.value && thread_feeds == ThreadFeeds::Kept {
                threads.add_motion(motion);
                wanted = feed.value;
            }
            let Some(governor) = motion.feed_from else {
                if wanted != feed.value {
                    pitches.insert(motion.last_statement());
                }
                return;
            };
            wishes.push(WantedFeed { first: place.first(), last: place.last(), governor, feed: wanted });
        });
        Self { wishes, threads, pitches }
    }

    /// Returns the statements that govern a feed motion.
    pub fn governing_statements(&self) -> BTreeSet<StatementId> {
        // Most motions have the governor of the motion before.
        self.wishes
            .chunk_by(|one, next| one.governor == next.governor)
            .filter_map(|same| same.first().map(|wish| wish.governor))
            .collect()
    }

    /// Writes the feeds. A FEDRAT that the same step put in before, and that would now repeat the feed in force, is
    /// taken out again.
    ///
    /// # Errors
    /// Returns an error if a feed cannot be printed as a record that reads back.
    pub fn write_feeds(
        mut self,
        editor: &mut ProgramEditor,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<(), Failure> {
        findings.extend(describe_unknown_feeds(editor.program()));
        findings.extend(self.threads.describe(editor.program()));
        findings.extend(describe_pitch_passes(editor.program(), &self.pitches));
        self.unify_statement_feeds(editor.program(), findings);
        // After any number of cycles with feeds of their own, a FEDRAT is in force again, and a cycle after
        // FEDRATs. So only the newest of each kind has to be remembered.
        let (mut fedrat, mut cycle): (Option<FeedInForce>, Option<FeedInForce>) = (None, None);
        for wish in &self.wishes {
            let governor = wish.governor;
            let slot = if is_cycle(editor.program(), governor) { &mut cycle } else { &mut fedrat };
            match slot {
                Some(in_force) if in_force.governor == wish.governor => {
                    if in_force.feed == wish.feed {
                        continue;
                    }
                    let Some(template) = &in_force.template else {
                        findings.push(describe_kept_cycle_feed(editor.program(), governor));
                        continue;
                    };
                    // No text can state such a number. Setting it gives the proper error, while a new record
                    // would silently repeat the old feed.
                    if !wish.feed.is_finite() {
                        return set_feed(editor, governor, wish.feed);
                    }
                    editor.insert_before(wish.first, &template.render_with_feed(wish.feed, editor))?;
                    in_force.feed = wish.feed;
                }
                in_force => {
                    let template = FedratTemplate::from_statement(editor, governor);
                    let repeats = in_force.as_ref().is_some_and(|before| before.feed == wish.feed);
                    if repeats && editor.is_own_insertion(governor) {
                        editor.delete_statement(governor)?;
                        *in_force = Some(FeedInForce { governor, feed: wish.feed, template });
                        continue;
                    }
                    if feed_number_indices(editor.program(), governor).nth(1).is_some() {
                        findings.push(describe_further_feeds(editor.program(), governor));
                    }
                    set_feed(editor, governor, wish.feed)?;
                    *in_force = Some(FeedInForce { governor, feed: wish.feed, template });
                }
            }
        }
        Ok(())
    }

    /// Gives all points of one GOTO the lowest of their feeds, because one statement cannot have several.
    fn unify_statement_feeds(&mut self, program: &Program, findings: &mut Vec<Diagnostic>) {
        let mut start = 0;
        while let Some(wish) = self.wishes.get(start).copied() {
            let rest = self.wishes.get_mut(start..).unwrap_or_default();
            let count = rest.iter().take_while(|other| other.last == wish.last).count().max(1);
            let group = rest.get_mut(..count).unwrap_or_default();
            // The lowest feed is the only one that keeps the limits of all these points.
            let lowest = group.iter().map(|wish| wish.feed).fold(f64::INFINITY, f64::min);
            if group.iter().any(|wish| wish.feed != lowest) {
                group.iter_mut().for_each(|wish| wish.feed = lowest);
                findings.push(describe_shared_statement(program, wish.last));
            }
            start += count;
        }
    }
}

/// A FEDRAT or CYCLE that was given its feed, and the feed that was last written in its place.
struct FeedInForce {
    governor: StatementId,
    feed: f64,
    /// It is `None` for a CYCLE, because no second one can be inserted between holes.
    template: Option<FedratTemplate>,
}

fn is_cycle(program: &Program, statement: StatementId) -> bool {
    matches!(program.statement(statement).record(), Record::Cycle(_))
}

/// Gives a FEDRAT or CYCLE another feed.
///
/// # Errors
/// Returns an error if the statement states no feed, or if the feed cannot be printed as a record that reads
/// back.
pub(super) fn set_feed(editor: &mut ProgramEditor, statement: StatementId, feed: f64) -> Result<(), Failure> {
    let program = editor.program();
    let Some(number) = feed_number_indices(program, statement).next() else {
        let text = program.statement_text(program.statement(statement));
        if let Some((at, printed)) = print_lettered_feed(text, feed) {
            return editor.replace_parts(statement, &[(at, printed.as_bytes())]);
        }
        let error =
            Diagnostic::new(codes::NO_SUCH_STATEMENT, "the step sets the feed of a record that states none");
        let span = statement_span(program, statement);
        return Err(error.with_label(program.source(), span, "states no feed").into());
    };
    editor.set_numbers(statement, &[(number, feed)])
}

/// Prints a feed in place of a number behind a letter (`F300`), which is a word to all but a shop's own post.
fn print_lettered_feed(text: &[u8], feed: f64) -> Option<(Range<usize>, String)> {
    let (at, _) = find_lettered_number(&parse::syntax(text)).filter(|_| feed.is_finite())?;
    let own = number::count_decimals(text.get(at.clone())?);
    Some((at, number::format_trimmed_number(feed, printed_decimals(feed, own).unsigned_abs() as usize)))
}

/// Returns how many decimals a feed needs so that it is printed exactly: its own, or so many that the
/// writer's tolerance is below the last one.
pub(super) fn printed_decimals(feed: f64, own: usize) -> i32 {
    let tolerance = (feed * FEED_SHARE).min(5e-5);
    (own as i32).max((-tolerance.log10()).floor() as i32).min(15)
}

/// Rounds a feed down to a value that is printed exactly, with its own decimals or as many as the writer's
/// tolerance requires.
pub(super) fn round_feed_down(feed: f64, own: usize) -> f64 {
    let power = 10f64.powi(printed_decimals(feed, own));
    // The factor keeps a feed that is already rounded from losing its last digit to a rounding error.
    let down = (feed * power * (1.0 + 1e-12)).floor() / power;
    if down > 0.0 { down } else { feed }
}

/// Returns the number of decimals of the feed that a statement prints.
pub(super) fn decimals_of_feed(program: &Program, statement: StatementId) -> usize {
    let found = program.statement(statement);
    let text = program.statement_text(found);
    let roles = parse::number_roles(found.record(), text);
    let numbers = parse::statement_numbers(text).into_iter().zip(roles);
    let feed = numbers.filter(|(_, role)| *role == NumberRole::Feed).map(|((at, _), _)| at).next();
    feed.and_then(|at| text.get(at)).map_or(0, number::count_decimals)
}

/// Returns the indices of the numbers of a statement that are feeds.
fn feed_number_indices(program: &Program, statement: StatementId) -> impl Iterator<Item = usize> {
    let found = program.statement(statement);
    let roles = parse::number_roles(found.record(), program.statement_text(found));
    roles.into_iter().enumerate().filter(|(_, role)| *role == NumberRole::Feed).map(|(number, _)| number)
}

/// A FEDRAT of the file on which new ones are modelled: its bytes without comment and line end.
struct FedratTemplate {
    text: Vec<u8>,
}

impl FedratTemplate {
    fn from_statement(editor: &ProgramEditor, statement: StatementId) -> Option<Self> {
        let program = editor.program();
        let found = program.statement(statement);
        if !matches!(found.record(), Record::Feed(_)) {
            return None;
        }
        debug_assert!(matches!(
            parse::syntax(program.statement_text(found)).form,
            StatementKind::Words | StatementKind::Structured
        ));
        Some(Self { text: strip_remark(program.statement_text(found)) })
    }

    fn render_with_feed(&self, feed: f64, editor: &ProgramEditor) -> Vec<u8> {
        if parse::statement_numbers(&self.text).is_empty() {
            let mut text = self.text.clone();
            if let Some((at, printed)) = print_lettered_feed(&self.text, feed) {
                text.splice(at, printed.into_bytes());
            }
            return text;
        }
        let record = Record::Feed(crate::program::Feed { value: feed, unit: None });
        let patched = crate::write::patch_numbers(&self.text, &record, &[(0, feed)], editor.style());
        patched.unwrap_or_else(|| self.text.clone())
    }
}

fn statement_span(program: &Program, statement: StatementId) -> Span {
    program.statement(statement).origin()
}

/// Reports FEDRATs in the words of a post (`FEDRAT/9000,FPM`, `FEDRAT/RAPID`). It is not known what they set,
/// so no step can change it.
fn describe_unknown_feeds(program: &Program) -> Option<Diagnostic> {
    let mut unknown = program.live_statements_of(&[RecordKind::Other]).filter(|(_, statement)| {
        matches!(statement.record(), Record::Known)
            && major_word(program.statement_text(statement)) == "FEDRAT"
    });
    let (first, _) = unknown.next()?;
    let message = match unknown.count() {
        0 => "the feed that this FEDRAT sets is not understood; it is not changed".to_owned(),
        more => format!("the feeds that {} FEDRATs set are not understood; they are not changed", more + 1),
    };
    let found = Diagnostic::new(codes::NOT_CHANGED, message);
    Some(found.with_label(program.source(), statement_span(program, first), "left as it is"))
}

fn describe_shared_statement(program: &Program, statement: StatementId) -> Diagnostic {
    Diagnostic::new(
        codes::NOT_CHANGED,
        "the points of this GOTO would need different feeds; the lowest is used for all of them",
    )
    .with_label(program.source(), statement_span(program, statement), "several points in one statement")
}

fn describe_further_feeds(program: &Program, statement: StatementId) -> Diagnostic {
    Diagnostic::new(
        codes::NOT_CHANGED,
        "this record has several feeds; only the first, at which the tool enters, is changed",
    )
    .with_label(program.source(), statement_span(program, statement), "more than one feed")
}

fn describe_kept_cycle_feed(program: &Program, statement: StatementId) -> Diagnostic {
    Diagnostic::new(
        codes::NOT_CHANGED,
        "the holes of one CYCLE would need different feeds; the feed of the first hole is used for all of them",
    )
    .with_label(
        program.source(),
        statement_span(program, statement),
        "one feed for all holes of the cycle",
    )
}
