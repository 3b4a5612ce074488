//! What benchmarks share that run the command itself.

use std::process::{Child, ExitStatus};
use std::time::Duration;

/// Waits for a process; how it ended, and the peak of its memory in bytes as Linux keeps it, 0 elsewhere.
pub fn wait_with_peak(mut child: Child) -> (ExitStatus, u64) {
    let file = format!("/proc/{}/status", child.id());
    let peak = || {
        let text = std::fs::read_to_string(&file).ok()?;
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
        Some(line.split_whitespace().next()?.parse::<u64>().ok()? * 1024)
    };
    let mut most = 0;
    loop {
        most = peak().unwrap_or(0).max(most);
        if let Some(status) = child.try_wait().expect("a child process") {
            return (status, most);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}
