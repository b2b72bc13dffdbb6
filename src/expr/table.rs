//! What belongs to a few symbols, in the order of their names.
//!
//! A formula names its symbols again and again, and nearly always by the same [`Symbol`]: looking one up compares
//! addresses first and letters only then.

use std::ops::Index;

use super::Symbol;

/// Entries that are looked through by address.
const FEW: usize = 16;

/// A value for each of some symbols; iterates by name.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Table<T> {
    /// In the order of the names, each once.
    entries: Vec<(Symbol, T)>,
}

impl<T> Default for Table<T> {
    fn default() -> Table<T> {
        Table {
            entries: Vec::new(),
        }
    }
}

impl<T> Table<T> {
    /// Where a name stands, or where it would.
    fn place(&self, name: &str) -> Result<usize, usize> {
        let is_it = |(known, _): &(Symbol, T)| std::ptr::eq::<str>(&**known, name);
        let first = self.entries.iter().take(FEW).position(is_it);
        let by_letters = || match self.entries.last() {
            Some((last, _)) if **last >= *name => {
                let order = |(known, _): &(Symbol, T)| (**known).cmp(name);
                self.entries.binary_search_by(order)
            }
            // Most tables are filled in order.
            _ => Err(self.entries.len()),
        };
        first.map_or_else(by_letters, Ok)
    }

    /// The value of a symbol.
    pub fn get(&self, name: &str) -> Option<&T> {
        self.place(name).ok().map(|at| &self.entries[at].1)
    }

    /// The same, to change it.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut T> {
        self.place(name).ok().map(|at| &mut self.entries[at].1)
    }

    /// The value of a symbol, which is `new` where there was none.
    pub fn get_or_insert(&mut self, name: &Symbol, new: impl FnOnce() -> T) -> &mut T {
        let at = self.place(name).unwrap_or_else(|at| {
            self.entries.insert(at, (name.clone(), new()));
            at
        });
        &mut self.entries[at].1
    }

    /// Whether the symbol has a value.
    pub fn contains_key(&self, name: &str) -> bool {
        self.place(name).is_ok()
    }

    /// Gives a symbol a value; the one it had.
    pub fn insert(&mut self, name: Symbol, value: T) -> Option<T> {
        match self.place(&name) {
            Ok(at) => Some(std::mem::replace(&mut self.entries[at].1, value)),
            Err(at) => {
                self.entries.insert(at, (name, value));
                None
            }
        }
    }

    /// Takes the value of a symbol away.
    pub fn remove(&mut self, name: &str) -> Option<T> {
        self.place(name).ok().map(|at| self.entries.remove(at).1)
    }

    /// Keeps the entries for which `keeps` holds.
    pub fn retain(&mut self, mut keeps: impl FnMut(&Symbol, &mut T) -> bool) {
        self.entries.retain_mut(|(name, value)| keeps(name, value));
    }

    /// Number of symbols.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Names and values.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (&Symbol, &T)> + Clone {
        self.entries.iter().map(|(name, value)| (name, value))
    }

    /// The names.
    pub fn keys(&self) -> impl DoubleEndedIterator<Item = &Symbol> + Clone {
        self.entries.iter().map(|(name, _)| name)
    }

    /// The values.
    pub fn values(&self) -> impl DoubleEndedIterator<Item = &T> + Clone {
        self.entries.iter().map(|(_, value)| value)
    }

    /// Names and values, to change these.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (&Symbol, &mut T)> {
        let entries = self.entries.iter_mut();
        entries.map(|(name, value)| (&*name, value))
    }

    /// The values, to change them.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.entries.iter_mut().map(|(_, value)| value)
    }
}

impl<T> Index<&str> for Table<T> {
    type Output = T;
    fn index(&self, name: &str) -> &T {
        match self.place(name) {
            Ok(at) => &self.entries[at].1,
            Err(_) => panic!("no entry for {name}"),
        }
    }
}

impl<T> Extend<(Symbol, T)> for Table<T> {
    fn extend<I: IntoIterator<Item = (Symbol, T)>>(&mut self, entries: I) {
        for (name, value) in entries {
            self.insert(name, value);
        }
    }
}

impl<T> FromIterator<(Symbol, T)> for Table<T> {
    fn from_iter<I: IntoIterator<Item = (Symbol, T)>>(entries: I) -> Table<T> {
        let mut table = Table::default();
        table.extend(entries);
        table
    }
}

impl<T> IntoIterator for Table<T> {
    type Item = (Symbol, T);
    type IntoIter = std::vec::IntoIter<(Symbol, T)>;
    fn into_iter(self) -> Self::IntoIter {
        self.entries.into_iter()
    }
}

impl<'a, T> IntoIterator for &'a Table<T> {
    type Item = (&'a Symbol, &'a T);
    type IntoIter = Box<dyn Iterator<Item = (&'a Symbol, &'a T)> + 'a>;
    fn into_iter(self) -> Self::IntoIter {
        Box::new(self.iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_found_by_its_letters_too() {
        let mut table: Table<u8> = [("b".into(), 2), ("a".into(), 1)].into_iter().collect();
        assert_eq!(table.get("a"), Some(&1));
        assert_eq!(table.insert("b".into(), 3), Some(2));
        assert_eq!(table.keys().map(|k| &**k).collect::<String>(), "ab");
        assert_eq!(table.remove("a"), Some(1));
        assert!(!table.contains_key("a") && table.len() == 1);
    }
}
