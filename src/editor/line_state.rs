//! This module tells the modal state at a line: what a machine would know after it.

use super::path_sums::PathSums;
use super::program_view::ProgramView;
use crate::number::format_trimmed_number;
use crate::presentation::text_format::format_duration;
use crate::program::geometry::Pose;
use crate::program::record::{Spindle, SpindleDirection, SpindleUnit};
use crate::program::{Feed, LengthUnit, MotionClass, StatementId};
use nalgebra::Vector3;
use std::fmt::Write;
use std::sync::Arc;

/// What holds after the statement of a line.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct LineState {
    /// The unit of the program's lengths.
    pub unit: LengthUnit,
    /// The position and the axis, once they are known; in the program's unit.
    pub pose: Option<Pose>,
    /// The tool axis in force.
    pub axis: Vector3<f64>,
    /// The feed as programmed.
    pub feed: Option<Feed>,
    /// The feed in mm/min, if the spindle speed that it may need is known.
    pub feed_mm_min: Option<f64>,
    /// The spindle.
    pub spindle: Option<Arc<Spindle>>,
    /// The name of the tool for people.
    pub tool: Option<String>,
    /// The name of the operation; empty where the file marks none.
    pub operation: String,
    /// What the last COOLNT says: `FLOOD`.
    pub coolant: Option<String>,
    /// The class of the motion that ends here, if one does.
    pub class: Option<MotionClass>,
    /// The length of that motion, mm.
    pub motion_length_mm: Option<f64>,
    /// The thickest chip of that motion, mm. A view does not know it; who has simulated the program puts it in.
    pub thickest_chip_mm: Option<f64>,
    /// Lengths and time from the start of the program to here.
    pub sums: PathSums,
}

impl ProgramView {
    /// Returns what holds after the statement of a line, counted from 0. Returns `None` past the last line.
    pub fn line_state(&self, line: u32) -> Option<LineState> {
        let id = self.statement_on_line(line)?;
        let (mut sums, mut motions) = self.motions_before(id);
        let mut walk = motions.clone();
        let mut here = None;
        while let Some(motion) = motions.next() {
            if motion.last_statement() > id {
                break;
            }
            let own = self.measure(&motion);
            sums.add(&own);
            if motion.last_statement() == id {
                here = Some((motion.class, own.feed_length_mm + own.rapid_length_mm));
            }
            motions.give_back(motion);
        }
        if walk.statements_read() <= id.index() {
            while walk.read_statement().is_some_and(|read| read < id) {}
        }
        let state = walk.state();
        let feed = state.feed.map(|(feed, _)| feed);
        let rpm = state.spindle.as_deref().filter(|spindle| spindle.on && is_in_turns(spindle));
        let operation = self.operations().nth(state.operation).map(|(operation, _)| operation.name.clone());
        Some(LineState {
            unit: self.unit(),
            pose: state.pose,
            axis: state.axis,
            feed,
            feed_mm_min: feed.and_then(|feed| {
                feed.mm_per_minute(self.unit(), rpm.and_then(|spindle| spindle.speed), None)
            }),
            spindle: state.spindle.clone(),
            tool: state.tool.as_deref().map(|tool| tool.display_name()),
            operation: operation.unwrap_or_default(),
            coolant: self.coolant_before(id),
            class: here.map(|(class, _)| class),
            motion_length_mm: here.map(|(_, length)| length),
            thickest_chip_mm: None,
            sums,
        })
    }

    /// Returns the fields of the last COOLNT up to a statement.
    fn coolant_before(&self, id: StatementId) -> Option<String> {
        let all = self.coolant_statements();
        let last = all.get(all.partition_point(|found| *found <= id).checked_sub(1)?)?;
        let text = self.program().statement_text(self.program().statement(*last));
        let (_, fields) = std::str::from_utf8(text).ok()?.split_once('/')?;
        Some(fields.trim().to_owned())
    }
}

fn is_in_turns(spindle: &Spindle) -> bool {
    spindle.unit == SpindleUnit::RevolutionsPerMinute
}

impl LineState {
    /// Describes the state in Markdown, one fact a line.
    pub fn to_markdown(&self) -> String {
        let mut out = String::new();
        let mut say = |name: &str, text: String| {
            let _ = writeln!(out, "- {name}: {text}");
        };
        if !self.operation.is_empty() {
            say("operation", format!("`{}`", self.operation.replace('`', "'")));
        }
        if let Some(tool) = &self.tool {
            say("tool", tool.replace('`', "'"));
        }
        let unit = match self.unit {
            LengthUnit::Mm => "mm",
            LengthUnit::Inch => "inch",
        };
        if let Some(pose) = &self.pose {
            let point =
                pose.point.coords.iter().map(|value| format_trimmed_number(*value, 4)).collect::<Vec<_>>();
            say("position", format!("{} {unit}", point.join(", ")));
        }
        let axis = self.pose.as_ref().map_or(self.axis, |pose| pose.axis);
        let axis = axis.iter().map(|value| format_trimmed_number(*value, 6)).collect::<Vec<_>>();
        say("axis", axis.join(", "));
        if let Some(feed) = self.feed {
            let programmed =
                format!("{} {}", format_trimmed_number(feed.value, 4), feed.unit_or_default().word());
            let both = self.feed_mm_min.map(|mm| {
                let inch = mm / LengthUnit::Inch.mm_per_unit();
                format!(
                    " ({} mm/min, {} inch/min)",
                    format_trimmed_number(mm, 2),
                    format_trimmed_number(inch, 3)
                )
            });
            say("feed", programmed + &both.unwrap_or_default());
        }
        if let Some(spindle) = self.spindle.as_deref() {
            say("spindle", describe_spindle(spindle));
        }
        if let Some(coolant) = &self.coolant {
            say("coolant", coolant.replace('`', "'"));
        }
        if let (Some(class), Some(length)) = (self.class, self.motion_length_mm) {
            say("motion", format!("{class}, {} {unit}", format_trimmed_number(self.in_unit(length), 4)));
        }
        if let Some(chip) = self.thickest_chip_mm {
            say("thickest chip", format!("{} {unit}", format_trimmed_number(self.in_unit(chip), 5)));
        }
        let lengths = [self.sums.feed_length_mm, self.sums.rapid_length_mm];
        let [feed, rapid] = lengths.map(|length| format_trimmed_number(self.in_unit(length), 2));
        let untimed = match self.sums.untimed {
            0 => String::new(),
            1 => ", without 1 motion of unknown feed".to_owned(),
            count => format!(", without {count} motions of unknown feed"),
        };
        say(
            "so far",
            format!(
                "{feed} {unit} at feed, {rapid} {unit} at rapid, {}{untimed}",
                format_duration(self.sums.seconds)
            ),
        );
        out
    }

    fn in_unit(&self, length_mm: f64) -> f64 {
        length_mm / self.unit.mm_per_unit()
    }
}

fn describe_spindle(spindle: &Spindle) -> String {
    if !spindle.on {
        return "off".to_owned();
    }
    let unit = match spindle.unit {
        SpindleUnit::RevolutionsPerMinute => "rev/min",
        SpindleUnit::SurfaceFeet => "ft/min of surface",
        SpindleUnit::SurfaceMetres => "m/min of surface",
    };
    let speed = spindle
        .speed
        .map_or_else(|| "on".to_owned(), |speed| format!("{} {unit}", format_trimmed_number(speed, 3)));
    let sense = match spindle.direction {
        Some(SpindleDirection::Clockwise) => " clockwise",
        Some(SpindleDirection::CounterClockwise) => " counter-clockwise",
        None => "",
    };
    speed + sense
}
