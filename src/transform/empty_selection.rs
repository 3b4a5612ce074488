//! This module reports a `where:` that selects nothing. Its help names the conditions that nothing in the
//! program matches, the nearest names, and what there is.

use super::StepContext;
use crate::diagnostic::{Diagnostic, Severity, codes};
use crate::parameters::{Glob, ToolPattern, find_similar_name};
use crate::program::motion::{ActiveTool, Motion};
use crate::program::{Program, operation};
use crate::recipe::{FeedRange, MotionFilter};

/// The largest number of names that a list shows. The rest is counted.
const MOST_LISTED: usize = 8;

/// Reports that a `where` selects nothing. `kind` is what it selects: `motion`, `statement` or `operation`.
/// It is an error if the selection is required, and otherwise a note.
pub(super) fn report_nothing_selected(
    kind: &str,
    wanted: &MotionFilter,
    program: &Program,
    context: &mut StepContext<'_>,
) {
    let message = format!("`where` selects no {kind} of this program");
    let mut finding = context.step_finding(codes::NOTHING_SELECTED, message, &["where"], "selects nothing");
    if !wanted.required {
        finding = Diagnostic { severity: Severity::Note, ..finding };
    }
    let unmatched = describe_unmatched_conditions(wanted, program, context);
    let help = if unmatched.is_empty() {
        format!(
            "Each condition of `where` matches something, but no {kind} that the step changes matches all of them."
        )
    } else {
        unmatched.join(" ")
    };
    // Whoever runs one recipe on many programs does not want an error for each that lacks an operation.
    let optional = " Write `required: false` into the `where` of a step that may find nothing.";
    let help = if wanted.required { help + optional } else { help };
    context.findings.push(finding.with_help(help));
}

/// Returns a sentence or two about each condition that nothing in the program matches.
fn describe_unmatched_conditions(
    wanted: &MotionFilter,
    program: &Program,
    context: &StepContext<'_>,
) -> Vec<String> {
    let motions: Vec<Motion> = program.motions().collect();
    let mut found = Vec::new();
    if let Some(patterns) = &wanted.operations {
        found.extend(describe_operations(patterns, program));
    }
    if let Some(patterns) = &wanted.tools {
        found.extend(describe_tools(patterns, &motions));
    }
    if let Some(classes) = &wanted.motions
        && !motions.iter().any(|motion| classes.contains(&motion.class))
    {
        let known = distinct(motions.iter().map(|motion| motion.class.to_string()));
        found.push(format!("No motion is of these classes. {}", list_names("classes", &known)));
    }
    if let Some(range) = &wanted.feed {
        found.extend(describe_feeds(*range, &motions, program, context));
    }
    found
}

fn describe_operations(patterns: &[Glob], program: &Program) -> Option<String> {
    let names = operation::find_operations(program).into_iter().map(|operation| operation.name);
    let known = distinct(names.filter(|name| !name.is_empty()));
    if known.iter().any(|name| patterns.iter().any(|pattern| pattern.matches_name(name))) {
        return None;
    }
    let meant = patterns.iter().map(Glob::as_str);
    Some(describe_names("operation", meant, &known, list_names("operations", &quote_names(&known))))
}

fn describe_tools(patterns: &[ToolPattern], motions: &[Motion]) -> Option<String> {
    let tools: Vec<&ActiveTool> = motions.iter().filter_map(|motion| motion.tool.as_deref()).collect();
    let fits = |tool: &&ActiveTool| {
        patterns.iter().any(|pattern| pattern.matches_tool(tool.number, tool.name.as_deref()))
    };
    if tools.iter().any(fits) {
        return None;
    }
    let names = distinct(tools.iter().filter_map(|tool| tool.name.clone()));
    let meant: Vec<String> = patterns
        .iter()
        .map(|pattern| match pattern {
            ToolPattern::Number(number) => number.to_string(),
            ToolPattern::Name(name) => name.as_str().to_owned(),
        })
        .collect();
    let listed = distinct(tools.iter().map(|tool| match (tool.number, &tool.name) {
        (Some(number), Some(name)) => format!("{number} (`{name}`)"),
        (Some(number), None) => number.to_string(),
        (None, Some(name)) => format!("`{name}`"),
        (None, None) => "one without a number and a name".to_owned(),
    }));
    Some(describe_names("tool", meant.iter().map(String::as_str), &names, list_names("tools", &listed)))
}

fn describe_feeds(
    range: FeedRange,
    motions: &[Motion],
    program: &Program,
    context: &StepContext<'_>,
) -> Option<String> {
    let file = context.file_length_unit(program);
    let at_feed = motions.iter().filter(|motion| !motion.rapid);
    let feeds: Vec<f64> = at_feed.filter_map(|motion| context.feed_per_minute(motion, file)).collect();
    if feeds.iter().any(|feed| range.contains(*feed)) {
        return None;
    }
    let lowest = feeds.iter().copied().reduce(f64::min);
    Some(match (lowest, feeds.iter().copied().reduce(f64::max)) {
        (Some(lowest), Some(highest)) => {
            format!("No feed lies in this range: the feeds of the program run from {lowest} to {highest}.")
        }
        _ => "No feed of the program is known.".to_owned(),
    })
}

/// Words which names match nothing, the nearest name, and the names that there are.
fn describe_names<'n>(
    what: &str,
    patterns: impl Iterator<Item = &'n str>,
    known: &[String],
    listing: String,
) -> String {
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    let patterns: Vec<&str> = patterns.collect();
    let quoted: Vec<String> = patterns.iter().map(|pattern| format!("`{pattern}`")).collect();
    // Wildcards are no letters of a name, so they must not count as differences.
    let near =
        patterns.iter().find_map(|pattern| find_similar_name(pattern.trim_matches(['*', '?']), &known));
    let meant = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    let end = if meant.is_empty() { "." } else { "" };
    format!("No {what} is called {}{meant}{end} {listing}", quoted.join(" or "))
}

fn list_names(what: &str, names: &[String]) -> String {
    if names.is_empty() {
        return format!("The program has no {what}.");
    }
    let shown = names.iter().take(MOST_LISTED).cloned().collect::<Vec<_>>().join(", ");
    let more = names.len().saturating_sub(MOST_LISTED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("The program has the {what} {shown}{more}.")
}

fn quote_names(names: &[String]) -> Vec<String> {
    names.iter().map(|name| format!("`{name}`")).collect()
}

/// Returns the first of each of several equal names, in their order.
fn distinct(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut known = std::collections::BTreeSet::new();
    names.filter(|name| known.insert(name.clone())).collect()
}
