//! The steps that one decision may take in all, whatever stages it goes through.
//!
//! A step is about ten nanoseconds of work: a node valued in doubles, a quarter of a product of terms. Inside [`within`]
//! all that could run away takes its steps from one store. Once that is empty products of polynomials are too large and
//! values are unknown, so that whoever asked ends undecided. Steps are counted, never seconds: every machine reaches the
//! same verdict. Outside there is no limit.

use std::cell::Cell;

thread_local! {
    static LEFT: Cell<Option<u64>> = const { Cell::new(None) };
    static SCOPE: Cell<u64> = const { Cell::new(0) };
}

/// Counts the limits that began or ended on this thread: what is remembered across one would let a decision hang on what was
/// asked before it.
pub(crate) fn scope() -> u64 {
    SCOPE.get()
}

/// Ends the limit, also where the work panics.
struct Limited;

impl Drop for Limited {
    fn drop(&mut self) {
        LEFT.set(None);
        SCOPE.set(SCOPE.get() + 1);
    }
}

/// Does work that may take this many steps; as a part of other work it takes the steps of that.
pub(crate) fn within<T>(steps: u64, work: impl FnOnce() -> T) -> T {
    if LEFT.get().is_some() {
        return work();
    }
    LEFT.set(Some(steps));
    SCOPE.set(SCOPE.get() + 1);
    let _limited = Limited;
    work()
}

/// Takes steps; false where they are not left.
pub(crate) fn take(steps: u64) -> bool {
    let Some(left) = LEFT.get() else {
        return true;
    };
    let rest = left.checked_sub(steps);
    LEFT.set(Some(rest.unwrap_or(0)));
    rest.is_some()
}

/// Whether all steps are taken.
pub(crate) fn spent() -> bool {
    LEFT.get() == Some(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_work_share_its_steps_and_nothing_is_left_behind() {
        within(10, || {
            assert!(take(4));
            assert!(!within(100, || take(7)));
            assert!(spent() && !take(1));
        });
        assert!(!spent() && take(u64::MAX));
    }
}
