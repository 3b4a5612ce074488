//! Who may start.

use clsmith::batch::budget::{LEAST, PER_BYTE, PER_LINE, Queue, need, need_of};
use proptest::prelude::*;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;

#[test]
fn a_need_grows_with_the_file() {
    assert_eq!(need(0, 0), LEAST);
    assert_eq!(need(1000, 20) - need(0, 0), 1000 * PER_BYTE + 20 * PER_LINE);
    assert_eq!(need(u64::MAX, u64::MAX), u64::MAX);
}

#[test]
fn lines_are_counted_in_samples() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.cls");
    for line in
        ["GOTO/1.0,2.0,3.0\n", "GOTO/1.0000,2.0000,3.0000,0.0000000,0.0000000,1.0000000\n", "GOTO/1,2,3\r"]
    {
        let text = line.repeat(20_000);
        std::fs::write(&path, &text).unwrap();
        let (told, right) = (need_of(&path, text.len() as u64), need(text.len() as u64, 20_000));
        assert!(told.abs_diff(right) < right / 100, "{told} {right}");
    }
    // A long head of long lines does not hide that the rest is short.
    let text = format!("{}{}", format!("$${}\n", "-".repeat(1000)).repeat(100), "RAPID\n".repeat(100_000));
    std::fs::write(&path, &text).unwrap();
    assert!(need_of(&path, text.len() as u64) >= need(text.len() as u64, 100_000));
    assert_eq!(need_of(&folder.path().join("none"), 10), need(10, 0));
}

#[test]
fn the_largest_that_fits_is_first() {
    let queue = Queue::new([(0, 10), (1, 60), (2, 30), (3, 50)], 100);
    let first = queue.take().unwrap();
    let second = queue.take().unwrap();
    let third = queue.take().unwrap();
    // 60, then the 50 does not fit but the 30 does, then the 10.
    assert_eq!([first.file, second.file, third.file], [1, 2, 0]);
    drop(first);
    assert_eq!(queue.take().unwrap().file, 3);
    drop((second, third));
    assert!(queue.take().is_none());
}

#[test]
fn what_is_larger_than_all_there_is_runs_alone() {
    let queue = Queue::new([(0, 1000), (1, 5)], 100);
    let small = queue.take().unwrap();
    assert_eq!(small.file, 1, "what fits is first");
    std::thread::scope(|scope| {
        let large = scope.spawn(|| queue.take().map(|ticket| ticket.file));
        std::thread::sleep(Duration::from_millis(30));
        assert!(!large.is_finished(), "somebody runs");
        drop(small);
        assert_eq!(large.join().unwrap(), Some(0));
    });
}

#[test]
fn a_closed_queue_gives_nothing() {
    let queue = Queue::new([(0, 60), (1, 60)], 100);
    let running = queue.take().unwrap();
    std::thread::scope(|scope| {
        let waiting = scope.spawn(|| queue.take().is_none());
        queue.close();
        assert!(waiting.join().unwrap(), "who waits is told");
    });
    drop(running);
    assert!(queue.take().is_none());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]
    #[test]
    fn everything_runs_once_and_within_the_budget(
        needs in proptest::collection::vec(1u64..150, 0..40),
        workers in 1usize..5,
    ) {
        let queue = Queue::new(needs.iter().copied().enumerate(), 100);
        let (used, count) = (AtomicU64::new(0), AtomicUsize::new(0));
        let seen: Vec<AtomicUsize> = needs.iter().map(|_| AtomicUsize::new(0)).collect();
        std::thread::scope(|scope| {
            for _ in 0..workers {
                scope.spawn(|| {
                    while let Some(ticket) = queue.take() {
                        let all = used.fetch_add(ticket.need, Ordering::SeqCst) + ticket.need;
                        let running = count.fetch_add(1, Ordering::SeqCst) + 1;
                        assert!(all <= 100 || running == 1, "{all} for {running}");
                        seen[ticket.file].fetch_add(1, Ordering::SeqCst);
                        std::thread::yield_now();
                        count.fetch_sub(1, Ordering::SeqCst);
                        used.fetch_sub(ticket.need, Ordering::SeqCst);
                    }
                });
            }
        });
        prop_assert!(seen.iter().all(|times| times.load(Ordering::SeqCst) == 1));
    }
}
