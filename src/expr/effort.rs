//! The steps that one decision may take in all, whatever stages it goes through, and those of all decisions about a scene.
//!
//! A step is about ten nanoseconds of work: a node valued in doubles, a quarter of a product of terms. Inside [`within`]
//! all that could run away takes its steps from one store. Once that is empty products of polynomials are too large and
//! values are unknown, so that whoever asked ends undecided. Steps are counted, never seconds: every machine reaches the
//! same verdict. Outside there is no limit.
//!
//! [`of_scene`] counts the same steps for a whole scene. Once its store is empty no sign, zero or shorter form is looked for any
//! more: each is undecided. Products go on, within limits of their own: an answer is written as far as it is known.

use std::cell::Cell;
use std::thread::LocalKey;

thread_local! {
    static LEFT: Cell<Option<u64>> = const { Cell::new(None) };
    static SCOPE: Cell<u64> = const { Cell::new(0) };
    static OF_SCENE: Cell<Option<u64>> = const { Cell::new(None) };
}

/// Steps that decisions about one scene may take together: some seconds.
const SCENE: u64 = 400_000_000;

/// Counts the limits that began or ended on this thread: what is remembered across one would let a decision hang on what was
/// asked before it.
pub(crate) fn scope() -> u64 {
    SCOPE.get()
}

/// Ends a limit, also where the work panics.
struct Limited(&'static LocalKey<Cell<Option<u64>>>);

impl Drop for Limited {
    fn drop(&mut self) {
        self.0.set(None);
        SCOPE.set(SCOPE.get() + 1);
    }
}

/// Does work that may take what a store is filled with; as a part of other such work it takes what that has left.
fn limited<T>(
    store: &'static LocalKey<Cell<Option<u64>>>,
    steps: u64,
    work: impl FnOnce() -> T,
) -> T {
    if store.get().is_some() {
        return work();
    }
    store.set(Some(steps));
    SCOPE.set(SCOPE.get() + 1);
    let _limited = Limited(store);
    work()
}

/// Does work that may take this many steps.
pub(crate) fn within<T>(steps: u64, work: impl FnOnce() -> T) -> T {
    limited(&LEFT, steps, work)
}

/// Works on a scene.
pub(crate) fn of_scene<T>(work: impl FnOnce() -> T) -> T {
    limited(&OF_SCENE, SCENE, work)
}

/// Takes steps; false where the decision at hand has none left.
pub(crate) fn take(steps: u64) -> bool {
    if let Some(left) = OF_SCENE.get() {
        OF_SCENE.set(Some(left.saturating_sub(steps)));
    }
    let Some(left) = LEFT.get() else {
        return true;
    };
    let rest = left.checked_sub(steps);
    LEFT.set(Some(rest.unwrap_or(0)));
    rest.is_some()
}

/// Whether all steps are taken, of the decision at hand or of the scene.
pub(crate) fn spent() -> bool {
    LEFT.get() == Some(0) || OF_SCENE.get() == Some(0)
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

    #[test]
    fn a_scene_out_of_steps_decides_nothing_and_goes_on() {
        of_scene(|| {
            assert!(take(SCENE - 1) && !spent());
            of_scene(|| assert!(take(1) && spent()));
            assert!(take(1) && spent());
        });
        assert!(!spent());
    }
}
