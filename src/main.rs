//! The `clsmith` command. Everything is in `cli`; here is only the exit code.

#![warn(unreachable_pub)]

mod cli;

fn main() -> std::process::ExitCode {
    cli::run_command_line()
}
