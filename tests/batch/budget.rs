//! Who may start.

use clsmith::batch::memory_budget::{
    LEAST, MemoryQueue, PER_BYTE, PER_LINE, estimate_file_memory_bytes, estimate_memory_bytes,
};
use proptest::prelude::*;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;

#[test]
fn a_need_grows_with_the_file() {
    assert_eq!(estimate_memory_bytes(0, 0), LEAST);
    assert_eq!(
        estimate_memory_bytes(1000, 20) - estimate_memory_bytes(0, 0),
        1000 * PER_BYTE + 20 * PER_LINE
    );
    assert_eq!(estimate_memory_bytes(u64::MAX, u64::MAX), u64::MAX);
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
        let (told, right) = (
            estimate_file_memory_bytes(&path, text.len() as u64),
            estimate_memory_bytes(text.len() as u64, 20_000),
        );
        assert!(told.abs_diff(right) < right / 100, "{told} {right}");
    }
    // A long head of long lines does not hide that the rest is short.
    let text = format!("{}{}", format!("$${}\n", "-".repeat(1000)).repeat(100), "RAPID\n".repeat(100_000));
    std::fs::write(&path, &text).unwrap();
    assert!(
        estimate_file_memory_bytes(&path, text.len() as u64)
            >= estimate_memory_bytes(text.len() as u64, 100_000)
    );
    assert_eq!(estimate_file_memory_bytes(&folder.path().join("none"), 10), estimate_memory_bytes(10, 0));
}

#[test]
fn the_largest_that_fits_is_first() {
    let queue = MemoryQueue::new([(0, 10), (1, 60), (2, 30), (3, 50)], 100);
    let first = queue.take_next().unwrap();
    let second = queue.take_next().unwrap();
    let third = queue.take_next().unwrap();
    // 60, then the 50 does not fit but the 30 does, then the 10.
    assert_eq!([first.file, second.file, third.file], [1, 2, 0]);
    drop(first);
    assert_eq!(queue.take_next().unwrap().file, 3);
    drop((second, third));
    assert!(queue.take_next().is_none());
}

#[test]
fn what_is_larger_than_all_there_is_runs_alone() {
    let queue = MemoryQueue::new([(0, 1000), (1, 5)], 100);
    let small = queue.take_next().unwrap();
    assert_eq!(small.file, 1, "what fits is first");
    std::thread::scope(|scope| {
        let large = scope.spawn(|| queue.take_next().map(|ticket| ticket.file));
        std::thread::sleep(Duration::from_millis(30));
        assert!(!large.is_finished(), "somebody runs");
        drop(small);
        assert_eq!(large.join().unwrap(), Some(0));
    });
}

#[test]
fn a_closed_queue_gives_nothing() {
    let queue = MemoryQueue::new([(0, 60), (1, 60)], 100);
    let running = queue.take_next().unwrap();
    std::thread::scope(|scope| {
        let waiting = scope.spawn(|| queue.take_next().is_none());
        queue.close_queue();
        assert!(waiting.join().unwrap(), "who waits is told");
    });
    drop(running);
    assert!(queue.take_next().is_none());
}

proptest! {
    #![proptest_config(crate::support::property(30))]
    #[test]
    fn everything_runs_once_and_within_the_budget(
        needs in proptest::collection::vec(1u64..150, 0..40),
        workers in 1usize..5,
    ) {
        let queue = MemoryQueue::new(needs.iter().copied().enumerate(), 100);
        let (used, count) = (AtomicU64::new(0), AtomicUsize::new(0));
        let seen: Vec<AtomicUsize> = needs.iter().map(|_| AtomicUsize::new(0)).collect();
        std::thread::scope(|scope| {
            for _ in 0..workers {
                scope.spawn(|| {
                    while let Some(ticket) = queue.take_next() {
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
