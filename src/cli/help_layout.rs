//! This module fits the help to the width of the terminal: examples, paragraphs and lists below the options.

use clap::Command;

/// The largest number of columns of the help, because longer lines of prose are hard to read.
const WIDEST: usize = 100;

/// The indentation of the further lines of a wrapped example, and of an explanation that has a line of its
/// own.
const EXAMPLE_INDENT: usize = 6;

/// Returns the command with its help, and that of its subcommands, fitted to a number of columns.
pub(super) fn fit_help(command: Command, columns: usize) -> Command {
    let columns = columns.min(WIDEST);
    let fit = |command: Command| {
        let after = command.get_after_help().map(|text| fit_text(&text.to_string(), columns));
        let command = command.term_width(columns);
        match after {
            Some(after) => command.after_help(after),
            None => command,
        }
    };
    let names: Vec<String> = command.get_subcommands().map(|one| one.get_name().to_owned()).collect();
    names.into_iter().fold(fit(command), |command, name| command.mut_subcommand(name, fit))
}

/// Fits a text. Paragraphs at the left margin are wrapped anew. An indented line that fits stays as it is. If
/// it does not fit, the text behind a gap of blanks gets a line of its own.
fn fit_text(text: &str, columns: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut paragraph: Vec<&str> = Vec::new();
    for line in text.lines().chain([""]) {
        let is_prose = !line.is_empty() && !line.starts_with(' ');
        if is_prose {
            paragraph.push(line);
            // A title is never joined with the lines below it.
            if !line.ends_with(':') {
                continue;
            }
        }
        let words: Vec<&str> = paragraph.drain(..).flat_map(str::split_whitespace).collect();
        wrap_words(&words, ["", ""], columns, &mut lines);
        if is_prose {
            continue;
        }
        fit_indented(line, columns, &mut lines);
    }
    while lines.last().is_some_and(String::is_empty) {
        lines.pop();
    }
    lines.join("\n")
}

fn fit_indented(line: &str, columns: usize, lines: &mut Vec<String>) {
    if line.chars().count() <= columns {
        lines.push(line.to_owned());
        return;
    }
    let text = line.trim_start();
    let margin = line.len() - text.len();
    let (first, rest) = match text.find("  ") {
        Some(gap) => text.split_at(gap),
        None => (text, ""),
    };
    let is_example = first.starts_with("clsmith ");
    let deeper = margin.min(columns / 2) + EXAMPLE_INDENT - 2;
    let indents = [" ".repeat(margin.min(columns / 2)), " ".repeat(deeper)];
    let words: Vec<&str> = first.split_whitespace().collect();
    // A wrapped line of a command ends with a backslash, so that the command can be copied.
    let begin = lines.len();
    wrap_words(&words, [&indents[0], &indents[1]], columns - 2 * usize::from(is_example), lines);
    if is_example {
        let end = lines.len().saturating_sub(1);
        lines.get_mut(begin..end).unwrap_or_default().iter_mut().for_each(|line| line.push_str(" \\"));
    }
    let words: Vec<&str> = rest.split_whitespace().collect();
    wrap_words(&words, [&indents[1], &indents[1]], columns, lines);
}

/// Appends words as lines. The first line begins with the first indent, all others with the second.
fn wrap_words(words: &[&str], indents: [&str; 2], columns: usize, lines: &mut Vec<String>) {
    let [first, other] = indents;
    let mut line = first.to_owned();
    let mut is_empty = true;
    for word in words {
        if !is_empty && line.chars().count() + 1 + word.chars().count() > columns {
            lines.push(std::mem::replace(&mut line, other.to_owned()));
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    if !is_empty {
        lines.push(line);
    }
}

#[cfg(test)]
mod tests {
    use super::fit_text;

    const TEXT: &str = "\
Examples:
  clsmith stats part.cls
  clsmith stats --units inch part.ncl        for a file that does not state its unit

Outputs appear whole or not at all, never
over an input.";

    #[test]
    fn what_fits_stays_and_paragraphs_are_wrapped_anew() {
        let wide = fit_text(TEXT, 100);
        assert!(wide.contains("part.ncl        for a file"), "{wide}");
        assert!(wide.ends_with("Outputs appear whole or not at all, never over an input."), "{wide}");
    }

    #[test]
    fn what_does_not_fit_gets_lines_of_its_own() {
        let narrow = fit_text(TEXT, 40);
        assert!(narrow.lines().all(|line| line.chars().count() <= 40), "{narrow}");
        assert!(
            narrow.contains(
                "  clsmith stats --units inch part.ncl\n      for a file that does not state its\n"
            ),
            "{narrow}"
        );
    }

    #[test]
    fn a_long_command_can_be_copied() {
        let fitted = fit_text("Examples:\n  clsmith apply recipe.yaml part.cls --report out.html", 40);
        assert_eq!(fitted, "Examples:\n  clsmith apply recipe.yaml part.cls \\\n      --report out.html");
    }
}
