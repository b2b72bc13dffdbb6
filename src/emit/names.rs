//! Identifiers that all languages accept.

use std::collections::BTreeSet;

use super::helpers;

/// Names already given, and words that languages keep for themselves.
#[derive(Default)]
pub(super) struct Names(BTreeSet<String>);

const KEPT: &str = "False None True abs abstract alignas and as assert async auto await become bool box break case char class const \
    continue cos crate def default del do double dyn elif else enum except extern fabs false final finally float fmax fn \
    for from gen global goto if impl import in inline int is lambda let long loop macro main libm match math max mod \
    move mut nonlocal not np or override pass pow priv pub raise ref register remainder restrict return round self short signed sin \
    sizeof sqrt static struct super switch tan trait true try type typedef typeof union unsafe unsigned unsized use virtual \
    void volatile where while wide with yield Self";

/// Names of the C library that a question may well have.
pub(super) const C_LIBRARY: &str = "abort bsearch ceil clock div exit exp floor free gamma hypot index j0 j1 jn labs ldiv link log printf puts \
    rand read remove rename signal sleep time times tgamma lgamma trunc wait write y0 y1 yn";

impl Names {
    /// The name as an identifier of all languages, not given before.
    pub(super) fn fresh(&mut self, name: &str) -> String {
        // One underscore for any number of other signs.
        let mut base = String::new();
        for c in name.chars() {
            match c {
                c if c.is_ascii_alphanumeric() => base.push(c),
                _ if base.ends_with('_') => {}
                _ => base.push('_'),
            }
        }
        if base.is_empty() || base.starts_with(|c: char| c.is_ascii_digit() || c == '_') {
            base = format!("q{base}");
        }
        let free = |n: &String, given: &BTreeSet<String>| {
            !given.contains(n) && !KEPT.split_whitespace().any(|k| k == n) && !helpers::is_helper(n)
        };
        let mut fresh = base.clone();
        if !free(&fresh, &self.0) {
            let stem = base
                .trim_end_matches(|c: char| c.is_ascii_digit())
                .to_string();
            fresh = (1..)
                .map(|k| match stem.as_str() {
                    "t" | "w" | "angle" => format!("{stem}{}", k + 1),
                    _ => format!("{base}_{k}"),
                })
                .find(|n| free(n, &self.0))
                .unwrap_or(base);
        }
        self.0.insert(fresh.clone());
        fresh
    }
}
