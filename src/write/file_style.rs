//! This module measures on a file itself how it writes its numbers and lines.

use super::line_breaks::find_full_column;
use crate::number::{self, NumberFormat, ZeroStyle};
use crate::parse;
use crate::program::{NumberRole, Program, Record};

/// The number of statements of a kind that are examined; files are uniform.
const SAMPLE: usize = 200;

/// The style of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileStyle {
    /// The zero style.
    pub zeros: ZeroStyle,
    /// The most decimals in coordinates and lengths.
    pub length_decimals: usize,
    /// The most decimals in unit vectors.
    pub direction_decimals: usize,
    /// The most decimals in feeds.
    pub feed_decimals: usize,
    /// Whether numbers are right-aligned in columns.
    pub columns: bool,
    /// The offset at which the file breaks full lines, inside numbers and words too; `None` if it breaks none.
    pub full_column: Option<usize>,
    /// The line end of most of the sampled lines: `\n`, `\r\n` or a lone `\r`.
    pub line_end: &'static str,
    /// The number of decimals that changed lengths and feeds get beyond their own; 0 unless a step converts
    /// to a larger unit.
    pub finer: usize,
}

/// The most decimals that [`FileStyle::finer`] gives a number. A hundred-millionth of an inch is below the
/// decimals of any file.
const FINEST: usize = 8;

impl FileStyle {
    /// Measures a program as it is now, including the changes of earlier steps. So two steps of one recipe
    /// write the same bytes as two runs with one step each. If there is nothing to measure, the style has 4,
    /// 7 and 4 decimals, as in NX.
    pub fn from_program(program: &Program) -> Self {
        let mut seen = StyleSample::from_program(program);
        if seen.lines == 0 {
            // A file without points and feeds has the line end of its first line.
            let bytes = program.source().bytes();
            let end: &[u8] = match memchr::memchr2(b'\n', b'\r', bytes).and_then(|end| bytes.get(end..)) {
                Some([b'\r', b'\n', ..]) => b"\r\n",
                Some([b'\r', ..]) => b"\r",
                _ => b"\n",
            };
            seen.count_line_end(end);
        }
        // One number may look padded or cut by chance, so the majority decides.
        let solidworks = program.dialect() == crate::program::Dialect::SolidWorks;
        Self {
            zeros: if solidworks || seen.cut_zeros > seen.padded { ZeroStyle::Cut } else { ZeroStyle::Kept },
            length_decimals: seen.lengths.unwrap_or(4),
            direction_decimals: seen.directions.unwrap_or(7).max(6),
            feed_decimals: seen.feed.unwrap_or(4),
            columns: program.dialect().has_columns(),
            full_column: find_full_column(program.source().bytes()),
            line_end: match seen.lines {
                lines if seen.crlf * 2 > lines => "\r\n",
                lines if seen.cr * 2 > lines => "\r",
                _ => "\n",
            },
            finer: 0,
        }
    }

    /// Returns the number of decimals that the file has for a role.
    pub fn role_decimals(&self, role: NumberRole) -> usize {
        match role {
            NumberRole::Direction(_) | NumberRole::ArcAxis(_) | NumberRole::FrameAxis(..) => {
                self.direction_decimals
            }
            NumberRole::Feed | NumberRole::SurfaceSpeed => self.feed_decimals,
            NumberRole::Point(_) | NumberRole::Step(_) | NumberRole::FrameOrigin(_) | NumberRole::Length => {
                self.length_decimals
            }
            NumberRole::Plain => 0,
        }
    }

    /// Returns the format of a changed number: at least its own decimals, or those of the file if the file
    /// cuts zeros.
    pub fn changed_format(&self, role: NumberRole, original: &[u8]) -> NumberFormat {
        let own = number::count_decimals(original);
        let decimals = match self.zeros {
            ZeroStyle::Kept => own,
            ZeroStyle::Cut => own.max(self.role_decimals(role)),
        };
        let finer = match role {
            NumberRole::Direction(_)
            | NumberRole::ArcAxis(_)
            | NumberRole::FrameAxis(..)
            | NumberRole::Plain => 0,
            _ => self.finer,
        };
        let decimals = decimals.max((decimals + finer).min(FINEST));
        // Each further decimal makes the tolerance ten times finer.
        let tolerance = role_tolerance(role) * 0.1f64.powi(finer as i32);
        let point = original.contains(&b'.') || !matches!(role, NumberRole::Plain | NumberRole::SurfaceSpeed);
        NumberFormat { decimals, tolerance, zeros: self.zeros, point }
    }

    /// Returns the format of a new number.
    pub fn new_format(&self, role: NumberRole) -> NumberFormat {
        let point = role != NumberRole::Plain;
        NumberFormat {
            decimals: self.role_decimals(role),
            tolerance: role_tolerance(role),
            zeros: self.zeros,
            point,
        }
    }
}

/// Returns half of the coarsest last decimal that measured dialects print: 4 decimals for lengths and feeds,
/// 6 for unit vectors. The axes of a frame move whole parts: 7 decimals, as NX prints them, keep a metre
/// within the fourth decimal.
fn role_tolerance(role: NumberRole) -> f64 {
    match role {
        NumberRole::FrameAxis(..) => 5e-8,
        NumberRole::Direction(_) | NumberRole::ArcAxis(_) => 5e-7,
        _ => 5e-5,
    }
}

/// The counts from which a style is made.
#[derive(Default)]
struct StyleSample {
    points: usize,
    feeds: usize,
    axes: usize,
    lines: usize,
    crlf: usize,
    cr: usize,
    lengths: Option<usize>,
    directions: Option<usize>,
    feed: Option<usize>,
    /// The number of numbers that only a writer without padding writes, and of those that only one with
    /// padding writes.
    cut_zeros: usize,
    padded: usize,
}

impl StyleSample {
    /// Measures the points, feeds and axes of a program until there are enough of each kind.
    fn from_program(program: &Program) -> Self {
        let mut seen = Self::default();
        for (_, statement) in program.live_statements() {
            let kind = match statement.record() {
                Record::Goto(_) | Record::Circle(_) | Record::DriveArc(_) | Record::AxialArc(_) => {
                    &mut seen.points
                }
                Record::Feed(_) => &mut seen.feeds,
                Record::ToolAxis(_) => &mut seen.axes,
                _ => continue,
            };
            *kind += 1;
            if *kind <= SAMPLE {
                seen.measure_statement(statement.record(), program.statement_text(statement));
            } else if seen.points > 50 * SAMPLE {
                break;
            }
        }
        seen
    }

    /// Counts the line end of a line.
    fn count_line_end(&mut self, text: &[u8]) {
        self.lines += 1;
        self.crlf += usize::from(text.ends_with(b"\r\n"));
        self.cr += usize::from(text.ends_with(b"\r"));
    }

    /// Measures the numbers of one statement.
    fn measure_statement(&mut self, record: &Record, text: &[u8]) {
        self.count_line_end(text);
        for ((at, _), role) in
            parse::statement_numbers(text).into_iter().zip(parse::number_roles(record, text))
        {
            let number = text.get(at).unwrap_or_default();
            let decimals = number::count_decimals(number);
            let most = match role {
                NumberRole::Point(_) => &mut self.lengths,
                NumberRole::Direction(_) | NumberRole::ArcAxis(_) => &mut self.directions,
                NumberRole::Feed => &mut self.feed,
                _ => continue,
            };
            *most = Some(most.map_or(decimals, |most| most.max(decimals)));
            let cut = number.ends_with(b".") || number.starts_with(b".") || number.starts_with(b"-.");
            self.cut_zeros += usize::from(cut);
            self.padded += usize::from(decimals > 0 && number.ends_with(b"0"));
        }
    }
}
