//! This module makes completion scripts.

use clap::{Arg, Command};
use clap_complete::Shell;
use std::fmt::Write;

/// Returns the completion script for a shell.
pub(super) fn write_completion_script(shell: Shell, command: &mut Command) -> String {
    // The script is made in memory first, because clap_complete treats a closed pipe as a bug.
    let mut script = Vec::new();
    clap_complete::generate(shell, command, "clsmith", &mut script);
    let script = String::from_utf8_lossy(&script).into_owned();
    match shell {
        Shell::PowerShell => add_powershell_values(&script, command),
        Shell::Fish => script + &list_fish_values(command),
        _ => script,
    }
}

/// Returns lines for fish about the values of positional arguments, which clap_complete leaves out.
fn list_fish_values(command: &Command) -> String {
    let mut lines = String::new();
    for command in command.get_subcommands() {
        for argument in command.get_positionals() {
            let names = list_names(argument).join(" ");
            if !names.is_empty() {
                let name = command.get_name();
                // Writing to a String cannot fail.
                let _ = writeln!(
                    lines,
                    "complete -c clsmith -n \"__fish_clsmith_using_subcommand {name}\" -f -a \"{names}\""
                );
            }
        }
    }
    lines
}

/// Adds values to the script for PowerShell, for which clap_complete only writes names of commands and
/// options.
///
/// The values of an option are offered if the word before the cursor is that option. The values of a
/// positional argument are offered together with the options of its command.
fn add_powershell_values(script: &str, command: &Command) -> String {
    let Some(at) = script.find("    $completions = @(") else { return script.to_owned() };
    let mut tables = String::from("    $values = @{\n");
    let mut places = String::from("    $places = @{\n");
    for command in command.get_subcommands() {
        let name = command.get_name();
        for argument in command.get_arguments().filter(|argument| !argument.is_hide_set()) {
            let Some(list) = list_values(argument) else { continue };
            // Writing to a String cannot fail.
            let _ = match argument.get_long() {
                Some(long) => writeln!(tables, "        'clsmith;{name};--{long}' = @({list})"),
                None => writeln!(places, "        'clsmith;{name}' = @({list})"),
            };
        }
    }
    let (head, tail) = script.split_at(at);
    let chosen = "    $before = $commandElements | Where-Object {\n        \
                      $_.Extent.EndOffset -lt $cursorPosition -and $_.Extent.Text -ne $wordToComplete\n    \
                  } | Select-Object -Last 1\n    \
                  $owner = ($command -split ';')[0..1] -join ';'\n    \
                  $of = $values[\"$owner;$($before.Extent.Text)\"]\n    \
                  if ($of) {\n        \
                      return $of.Where{ $_ -like \"$wordToComplete*\" } |\n            \
                          ForEach-Object { [CompletionResult]::new($_, $_, [CompletionResultType]::ParameterValue, $_) }\n    \
                  }\n";
    let tail = tail.replacen(
        "    $completions.Where{",
        "    $completions += @($places[$command] | Where-Object { $_ } |\n        \
             ForEach-Object { [CompletionResult]::new($_, $_, [CompletionResultType]::ParameterValue, $_) })\n    \
         $completions.Where{",
        1,
    );
    format!("{head}{tables}    }}\n{places}    }}\n{chosen}{tail}")
}

/// Returns the values of an argument, if they are known.
fn list_names(argument: &Arg) -> Vec<String> {
    if !argument.get_action().takes_values() {
        return Vec::new();
    }
    argument.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect()
}

/// Returns the values of an argument as a list of PowerShell, if they are known.
fn list_values(argument: &Arg) -> Option<String> {
    let quoted: Vec<String> = list_names(argument).iter().map(|name| format!("'{name}'")).collect();
    (!quoted.is_empty()).then(|| quoted.join(", "))
}
