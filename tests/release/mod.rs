//! What is published: the package of the registry, archives and installers, services, and how a checkout looks on Windows.

mod archives;
mod checkout;
mod package;
mod services;

use std::path::{Path, PathBuf};
use std::process::Command;

fn project() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(name: &str) -> String {
    std::fs::read_to_string(project().join(name)).unwrap()
}

/// Runs a program in the project's folder and returns what it printed.
fn output(program: &Path, arguments: &[&str]) -> String {
    let done = Command::new(program).args(arguments).current_dir(project()).output().unwrap();
    assert!(done.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).unwrap()
}

/// Git, where this is a checkout; a copy of the sources alone has no history to ask.
#[track_caller]
fn git() -> Option<PathBuf> {
    if !project().join(".git").exists() {
        return None;
    }
    crate::support::require_program(&["git"])
}
