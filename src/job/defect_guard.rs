//! This module turns a panic in the work on one file into a finding, so that the work on other files goes on.

use crate::diagnostic::{Diagnostic, codes};
use crate::fingerprint::VERSION;
use std::any::Any;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Mutex, PoisonError};

/// How many panics are remembered; each is asked for once, soon after it happened.
const REMEMBERED: usize = 64;

/// Panics that nobody has asked for yet: what each says, and where in clsmith it happened.
static PANICS: Mutex<Vec<(String, String)>> = Mutex::new(Vec::new());

/// Remembers where panics happen instead of printing them, for the whole process. A command calls it once, before
/// any work; without it the finding of a panic names no place.
pub fn remember_panics() {
    panic::set_hook(Box::new(|panicked| {
        let mut panics = PANICS.lock().unwrap_or_else(PoisonError::into_inner);
        if panics.len() >= REMEMBERED {
            panics.remove(0);
        }
        panics.push((read_payload(panicked.payload()), describe_place(panicked)));
    }));
}

/// Does the work on one file, and returns a finding if clsmith itself fails in it. `file` is the name that people
/// know the file by.
///
/// What the work has changed outside of itself may be half done after a finding; callers only pass what they throw
/// away then.
///
/// ```
/// use clsmith::job::catch_defect;
///
/// assert_eq!(catch_defect("part.cls", || 7).ok(), Some(7));
/// let defect = catch_defect("part.cls", || panic!("a list is empty")).expect_err("it panicked");
/// assert_eq!(defect.code.id(), "CL0440");
/// assert!(defect.message.contains("part.cls") && defect.message.contains("a list is empty"));
/// ```
///
/// # Errors
/// Returns [`codes::DEFECT`] with what happened and what to send to whom.
pub fn catch_defect<T>(file: &str, work: impl FnOnce() -> T) -> Result<T, Diagnostic> {
    panic::catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        let said = read_payload(payload.as_ref());
        let place = take_place(&said).map(|place| format!(" at {place}")).unwrap_or_default();
        let message = format!(
            "clsmith {VERSION} failed on {file}: {said}{place}; the defect is in clsmith, not in the file"
        );
        Diagnostic::new(codes::DEFECT, message)
    })
}

/// What a panic says.
fn read_payload(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied().map(str::to_owned);
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no reason is given".to_owned())
}

/// The file and line of clsmith in which a panic happened.
fn describe_place(panicked: &PanicHookInfo<'_>) -> String {
    panicked.location().map(|at| format!("{}:{}", at.file(), at.line())).unwrap_or_default()
}

/// Takes the place of the last panic that says this. Several threads may panic at once, so it is found by its text.
fn take_place(said: &str) -> Option<String> {
    let mut panics = PANICS.lock().unwrap_or_else(PoisonError::into_inner);
    let index = panics.iter().rposition(|(text, _)| text == said)?;
    let (_, place) = panics.remove(index);
    Some(place).filter(|place| !place.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_without_a_panic_gives_its_value() {
        assert_eq!(catch_defect("a.cls", || 3).unwrap(), 3);
    }

    #[test]
    fn a_panic_on_another_thread_of_the_work_is_a_finding_too() {
        let defect = catch_defect("a.cls", || {
            rayon::join(|| (), || panic!("{} points", 3));
        });
        assert!(defect.unwrap_err().message.contains("failed on a.cls: 3 points"));
    }
}
