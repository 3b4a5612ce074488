//! This module holds what all jobs in threads of their own need: how they stop, and how they say why nothing came of them.

use super::outbox::Outbox;
use clsmith::diagnostic::Failure;
use clsmith::simulation_run::RunWatcher;
use lsp_server::{ErrorCode, RequestId};
use std::sync::atomic::{AtomicBool, Ordering};

/// A simulation beside an editor takes no more memory; a finer one is for the command.
pub(super) const MOST_MEMORY_BYTES: u64 = 2 << 30;

/// Stops a job when its request was cancelled.
pub(super) struct StopWhenCancelled<'s>(pub(super) &'s AtomicBool);

impl RunWatcher for StopWhenCancelled<'_> {
    fn report_progress(&self, _: f64, _: f64) {}

    fn is_stop_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    fn memory_limit_bytes(&self) -> Option<u64> {
        Some(MOST_MEMORY_BYTES)
    }
}

/// Answers that a job was cancelled, or what was in its way.
pub(super) fn refuse_failure(outbox: &Outbox, id: RequestId, failure: &Failure) {
    match failure {
        Failure::Interrupted => outbox.refuse(id, ErrorCode::RequestCanceled, "cancelled"),
        Failure::Found(findings) => {
            let message = findings.first().map_or("it failed", |found| found.message.as_str());
            outbox.refuse(id, ErrorCode::RequestFailed, message);
        }
    }
}
