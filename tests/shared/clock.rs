//! How long work takes this thread, whatever else the machine does meanwhile.

use std::fs;
use std::time::{Duration, Instant};

/// What work gives, and the time that a processor spent on it; where the system does not tell that, the time on the clock.
pub fn spent<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let (start, before) = (Instant::now(), on_processor());
    let out = work();
    let elapsed = start.elapsed();
    let spent = before
        .zip(on_processor())
        .map(|(before, after)| after - before);
    (out, spent.map_or(elapsed, |spent| spent.min(elapsed)))
}

/// Time of this thread on a processor, as Linux tells it.
fn on_processor() -> Option<Duration> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(Duration::from_nanos(
        text.split_whitespace().next()?.parse().ok()?,
    ))
}
