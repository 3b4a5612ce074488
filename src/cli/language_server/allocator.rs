//! This module lets the memory of long texts go back to the system.

/// Lets the memory of long texts go back to the system when they are not needed any more.
///
/// The allocator of glibc keeps freed blocks of up to 32 MiB once it has seen some, and then a server that has read a long
/// program a few times holds twice what it needs. The limit can only be set before the process starts, so the process takes
/// its own place with the limit in its environment. Nothing else changes; where that is not possible it goes on as it is.
pub(super) fn give_back_large_texts() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        use std::os::unix::process::CommandExt;
        const LIMIT: &str = "MALLOC_MMAP_THRESHOLD_";
        if std::env::var_os(LIMIT).is_some() {
            return;
        }
        if let Ok(own) = std::env::current_exe() {
            // It returns only if it failed.
            let _ = std::process::Command::new(own)
                .args(std::env::args_os().skip(1))
                .env(LIMIT, "1048576")
                .exec();
        }
    }
}
