//! Families in which masses, lengths, restitution or units run to an extreme.

use super::{Draft, Family, Sampler, put, scale, steps};
use crate::expr::{Expr, Symbol};
use crate::scene::{ContactLaw, Shape};

impl Sampler<'_> {
    pub(super) fn masses(&self, count: usize, list: &mut Vec<Family>) {
        let masses = self.of_dimension(1, 0, 0);
        if let [first, _, ..] = masses.as_slice() {
            list.push(self.family(
                "mass ratio",
                format!("{first} × 10^k, k = −15 … 15"),
                format!("log10 of the factor of {first}"),
                &steps(-15.0, 15.0, 5.0),
                count,
                |d, x| scale(d, first, 10f64.powf(x)),
            ));
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
            list.push(self.family(
                "slender and wide",
                format!("{width} × 10^k, k = −6 … 6"),
                format!("log10 of the factor of {width}"),
                &steps(-6.0, 6.0, 3.0),
                count,
                |d, x| scale(d, &width, 10f64.powf(x)),
            ));
        }
        if let Some(arm) = lengths
            .iter()
            .find(|l| in_place(l))
            .filter(|_| lengths.len() + inertias.len() > 1)
        {
            list.push(self.family(
                "long and short arms",
                format!("{arm} × 10^k, k = −8 … 8"),
                format!("log10 of the factor of {arm}"),
                &steps(-8.0, 8.0, 4.0),
                count,
                |d, x| scale(d, arm, 10f64.powf(x)),
            ));
        }
        let radius = lengths.iter().find(|l| in_inertia(l) && !in_place(l));
        match (inertias.is_empty(), radius) {
            (false, _) => list.push(self.family(
                "radius of gyration → 0",
                format!("{} × 10^−2k, so k_G × 10^−k", inertias.join(", ")),
                "−log10 of the factor of k_G".into(),
                &steps(0.0, 8.0, 1.0),
                count,
                |d, x| inertias.iter().all(|i| scale(d, i, 10f64.powf(-2.0 * x))),
            )),
            (true, Some(k)) => list.push(self.family(
                "radius of gyration → 0",
                format!("{k} × 10^−k"),
                format!("−log10 of the factor of {k}"),
                &steps(0.0, 8.0, 1.0),
                count,
                |d, x| scale(d, k, 10f64.powf(-x)),
            )),
            _ => {}
        }
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
            "overflow",
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
            "underflow",
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
