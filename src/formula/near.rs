//! Which name somebody meant who mistyped it.

/// The candidate that differs from `name` least, if by little: what somebody who mistyped it meant.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = name.chars().count();
    if length == 0 || length > 60 {
        return None;
    }
    let limit = length.div_ceil(3);
    candidates
        .into_iter()
        .filter(|c| c.chars().count() <= 60)
        .map(|c| (distance(name, c), c))
        .filter(|(d, c)| *d <= limit && *d < length.max(c.chars().count()))
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// Number of letters to change, add, drop or swap with their neighbor; a change of case counts nothing.
pub fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (
        a.to_lowercase().chars().collect(),
        b.to_lowercase().chars().collect(),
    );
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let same = usize::from(a[i - 1] != b[j - 1]);
                let mut best = (rows[i - 1][j - 1] + same)
                    .min(rows[i - 1][j] + 1)
                    .min(rows[i][j - 1] + 1);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(rows[i - 2][j - 2] + 1);
                }
                best
            };
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_one_slip_away() {
        let names = ["mass", "length", "velocity", "m1", "m2"];
        assert_eq!(nearest("lenght", names), Some("length"));
        assert_eq!(nearest("Mass", names), Some("mass"));
        assert_eq!(nearest("m3", names), Some("m1"));
        assert_eq!(nearest("zz", names), None);
        assert_eq!(nearest("L", ["m", "l"]), Some("l"));
        assert_eq!(nearest("H", ["m", "l"]), None);
    }
}
