//! Families in which masses, lengths, restitution or units run to an extreme.

use super::{Draft, Family, Sampler, put, scale, steps};
use crate::expr::{Expr, Symbol};
use crate::scene::{ContactLaw, Shape};

/// Families in which products leave the range of doubles.
pub const RANGES: [&str; 2] = ["overflow", "underflow"];

impl Sampler<'_> {
    /// A family in which some parameters are multiplied by 10^(power·k), k from `from` to `to`.
    fn multiplied(
        &self,
        name: &str,
        of: &[Symbol],
        (power, [from, to, by]): (f64, [f64; 3]),
        count: usize,
    ) -> Family {
        let names = of.join(", ");
        let (times, axis) = match power {
            1.0 => (String::new(), format!("log10 of the factor of {names}")),
            p => (format!("{p}").replace('-', "−"), String::from("k")),
        };
        self.family(
            name,
            format!("{names} × 10^{times}k, k = {from} … {to}"),
            axis,
            &steps(from, to, by),
            count,
            |d, x| of.iter().all(|s| scale(d, s, 10f64.powf(power * x))),
        )
    }

    pub(super) fn masses(&self, count: usize, list: &mut Vec<Family>) {
        let masses = self.of_dimension(1, 0, 0);
        if let [first, _, ..] = masses.as_slice() {
            let extent = (1.0, [-15.0, 15.0, 5.0]);
            let one = std::slice::from_ref(first);
            list.push(self.multiplied("mass ratio", one, extent, count));
        }
    }

    pub(super) fn restitution(&self, count: usize, list: &mut Vec<Family>) {
        let of = |e: &Expr| e.as_symbol().cloned();
        let e = self.scene.contacts.iter().find_map(|c| match &c.law {
            ContactLaw::Frictionless { restitution } => of(restitution),
            _ => None,
        });
        let Some(e) = e else { return };
        let zero = self.family(
            "e → 0",
            format!("{e} = 10^−k"),
            format!("−log10 {e}"),
            &steps(1.0, 16.0, 3.0),
            count,
            |d, x| put(d, &e, 10f64.powf(-x)),
        );
        let one = self.family(
            "e → 1",
            format!("{e} = 1 − 10^−k"),
            format!("−log10(1 − {e})"),
            &steps(1.0, 16.0, 1.0),
            count,
            |d, x| put(d, &e, 1.0 - 10f64.powf(-x)),
        );
        list.extend([zero, one]);
    }

    pub(super) fn sizes(&self, count: usize, list: &mut Vec<Family>) {
        let lengths = self.of_dimension(0, 1, 0);
        let inertias = self.of_dimension(1, 2, 0);
        let in_place = |name: &Symbol| {
            let mut places = self
                .scene
                .bodies
                .iter()
                .map(|b| &b.center)
                .chain(self.scene.hinges.iter().map(|h| &h.at))
                .chain(self.scene.contacts.iter().map(|c| &c.at));
            places.any(|v| v.iter().any(|e| e.symbols().contains(name)))
        };
        let in_inertia = |name: &Symbol| {
            self.scene
                .bodies
                .iter()
                .any(|b| b.inertia.symbols().contains(name))
        };
        let rectangle = self.scene.bodies.iter().find_map(|b| match &b.shape {
            Shape::Rectangle { width, .. } => width.as_symbol().cloned(),
            _ => None,
        });
        if let Some(width) = rectangle {
            let extent = (1.0, [-6.0, 6.0, 3.0]);
            list.push(self.multiplied("slender and wide", &[width], extent, count));
        }
        let arm = lengths.iter().find(|l| in_place(l));
        if let Some(arm) = arm.filter(|_| lengths.len() + inertias.len() > 1) {
            let extent = (1.0, [-8.0, 8.0, 4.0]);
            let one = std::slice::from_ref(arm);
            list.push(self.multiplied("long and short arms", one, extent, count));
        }
        let radius = lengths.iter().find(|l| in_inertia(l) && !in_place(l));
        let (of, power) = match (inertias.is_empty(), radius) {
            (false, _) => (inertias, -2.0),
            (true, Some(k)) => (vec![k.clone()], -1.0),
            _ => return,
        };
        let extent = (power, [0.0, 8.0, 1.0]);
        list.push(self.multiplied("radius of gyration → 0", &of, extent, count));
    }

    /// Everything large or small in powers of two, which changes no digit of any right answer.
    pub(super) fn ranges(&self, count: usize, list: &mut Vec<Family>) {
        let masses = self.of_dimension(1, 0, 0);
        let lengths = self.of_dimension(0, 1, 0);
        let inertias = self.of_dimension(1, 2, 0);
        let speeds = self.of_dimension(0, 1, -1);
        let spins = self.of_dimension(0, 0, -1);
        let impulses = self.of_dimension(1, 1, -1);
        if speeds.is_empty() && spins.is_empty() && impulses.is_empty() {
            return;
        }
        let change = |d: &mut Draft, mass: i32, length: i32, time: i32| {
            let mut all = true;
            for (names, power) in [
                (&masses, mass),
                (&lengths, length),
                (&inertias, mass + 2 * length),
                (&speeds, length - time),
                (&spins, -time),
                (&impulses, mass + length - time),
            ] {
                for name in names {
                    all &= (-1000..1000).contains(&power) && scale(d, name, 2f64.powi(power));
                }
            }
            all
        };
        list.push(self.family(
            RANGES[0],
            "all masses and speeds × 2^k: m v² up to 10^405".into(),
            "k".into(),
            &steps(0.0, 450.0, 90.0),
            count,
            |d, x| {
                let k = x as i32;
                change(d, k, 0, -k)
            },
        ));
        list.push(self.family(
            RANGES[1],
            "all masses and lengths × 2^−k, speeds kept: m l² down to 10^−325".into(),
            "k".into(),
            &steps(0.0, 360.0, 90.0),
            count,
            |d, x| {
                let k = x as i32;
                change(d, -k, -k, -k)
            },
        ));
    }
}
