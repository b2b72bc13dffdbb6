//! Work left to an operation, counted in steps that are the same on every machine.

use std::cell::Cell;

use super::Stop;

/// Work left, counted in products of terms: for the operation at hand, and for all that follow. What needs more ends with
/// [`Stop::TooLarge`], on every machine alike.
#[derive(Clone, Debug)]
pub(crate) struct Fuel {
    now: Cell<u64>,
    store: Cell<u64>,
}

impl Fuel {
    /// For one public operation: about a tenth of a second.
    pub const FULL: u64 = 2_000_000;
    /// For one factorization: shortening is worth that much at most.
    const PORTION: u64 = 300_000;

    pub fn new() -> Fuel {
        Fuel {
            now: Cell::new(Fuel::FULL),
            store: Cell::new(u64::MAX),
        }
    }

    /// From now on no more than this altogether.
    pub fn limit(&self, store: u64) {
        self.store.set(store);
        self.refill();
    }

    /// A new operation begins.
    pub fn refill(&self) {
        self.now.set(Fuel::FULL.min(self.store.get()));
    }

    /// Whether the operation at hand has none left.
    pub fn is_spent(&self) -> bool {
        self.now.get() == 0
    }

    pub fn burn(&self, amount: usize) -> Result<(), Stop> {
        let amount = amount as u64;
        self.store.set(self.store.get().saturating_sub(amount));
        match self.now.get().checked_sub(amount) {
            Some(left) => {
                self.now.set(left);
                Ok(())
            }
            None => {
                self.now.set(0);
                Err(Stop::TooLarge("work"))
            }
        }
    }

    /// A factorization with a portion of its own. The operation at hand pays a fixed fee for it, the store what it takes.
    pub fn portion<T>(&self, piece: impl FnOnce(&Fuel) -> T) -> T {
        let portion = Fuel {
            now: Cell::new(self.now.get().min(Fuel::PORTION).min(self.store.get())),
            store: self.store.clone(),
        };
        self.now.set(self.now.get().saturating_sub(2_000));
        let found = piece(&portion);
        self.store.set(portion.store.get());
        found
    }
}
