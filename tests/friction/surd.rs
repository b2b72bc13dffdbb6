//! Exact numbers p ± √R with one square root, for the end of Stronge's path: two ways to it agree or they do not.

use std::cmp::Ordering;

use carom::expr::number::{sqrt_exact, to_f64};
use carom::expr::{Function, Rational, Scalar, ratio};
use carom::numeric::Number;
use num_traits::Signed;

/// p + q √R with q = ±1; R = 0 where there is no root.
#[derive(Clone, Debug)]
pub struct Surd {
    pub p: Rational,
    minus: bool,
    square: Rational,
}

impl Surd {
    pub fn rational(p: Rational) -> Surd {
        Surd {
            p,
            minus: false,
            square: Rational::zero(),
        }
    }

    fn sign(&self) -> Ordering {
        let root = match (self.square.is_zero(), self.minus) {
            (true, _) => Ordering::Equal,
            (_, true) => Ordering::Less,
            _ => Ordering::Greater,
        };
        let plain = self.p.cmp(&Rational::zero());
        if plain == root || root == Ordering::Equal {
            return plain;
        }
        if plain == Ordering::Equal {
            return root;
        }
        match (&self.p * &self.p).cmp(&self.square) {
            Ordering::Greater => plain,
            Ordering::Less => root,
            Ordering::Equal => Ordering::Equal,
        }
    }

    /// √(R/R') where both roots are rational multiples of each other; nothing else occurs along a path.
    fn share(&self, other: &Surd) -> Rational {
        sqrt_exact(&(&self.square / &other.square)).expect("one root")
    }
}

impl PartialEq for Surd {
    fn eq(&self, other: &Surd) -> bool {
        self.minus(other).sign() == Ordering::Equal
    }
}

impl PartialOrd for Surd {
    fn partial_cmp(&self, other: &Surd) -> Option<Ordering> {
        Some(self.minus(other).sign())
    }
}

impl Scalar for Surd {
    fn from_rational(value: &Rational) -> Surd {
        Surd::rational(value.clone())
    }
    fn pi() -> Option<Surd> {
        None
    }
    fn plus(&self, other: &Surd) -> Surd {
        let p = &self.p + &other.p;
        if self.square.is_zero() || other.square.is_zero() {
            let root = if self.square.is_zero() { other } else { self };
            return Surd { p, ..root.clone() };
        }
        let signed = |minus: bool, k: Rational| if minus { -k } else { k };
        let k = signed(self.minus, self.share(other)) + signed(other.minus, Rational::one());
        Surd {
            p,
            minus: k.is_negative(),
            square: &k * &k * &other.square,
        }
    }
    fn times(&self, other: &Surd) -> Surd {
        let scaled = |x: &Surd, k: &Rational| Surd {
            p: &x.p * k,
            minus: x.minus != k.is_negative(),
            square: &x.square * k * k,
        };
        match (self.square.is_zero(), other.square.is_zero()) {
            (true, _) => scaled(other, &self.p),
            (_, true) => scaled(self, &other.p),
            _ => {
                let product = self.share(other) * &other.square;
                let product = if self.minus == other.minus {
                    product
                } else {
                    -product
                };
                let root = |x: &Surd| Surd {
                    p: Rational::zero(),
                    ..x.clone()
                };
                let cross = scaled(&root(self), &other.p).plus(&scaled(&root(other), &self.p));
                Surd::rational(&self.p * &other.p + product).plus(&cross)
            }
        }
    }
    fn recip(&self) -> Option<Surd> {
        if self.square.is_zero() {
            return (!self.p.is_zero()).then(|| Surd::rational(self.p.recip()));
        }
        let norm = &self.p * &self.p - &self.square;
        let conjugate = Surd {
            minus: !self.minus,
            ..self.clone()
        };
        (!norm.is_zero()).then(|| conjugate.times(&Surd::rational(norm.recip())))
    }
    fn sqrt(&self) -> Option<Surd> {
        if !self.square.is_zero() || self.p.is_negative() {
            return None;
        }
        Some(match sqrt_exact(&self.p) {
            Some(root) => Surd::rational(root),
            None => Surd {
                p: Rational::zero(),
                minus: false,
                square: self.p.clone(),
            },
        })
    }
    fn pow(&self, _: &Surd) -> Option<Surd> {
        None
    }
    fn call(&self, _: Function) -> Option<Surd> {
        None
    }
}

impl Number for Surd {
    fn zero() -> Surd {
        Surd::rational(Rational::zero())
    }
    fn one() -> Surd {
        Surd::rational(Rational::one())
    }
    fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }
    fn minus(&self, other: &Surd) -> Surd {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Surd {
        self.times(&Surd::rational(ratio(-1, 1)))
    }
    fn halved(&self) -> Surd {
        self.times(&Surd::rational(ratio(1, 2)))
    }
    fn size(&self) -> f64 {
        let root = to_f64(&self.square).sqrt();
        (to_f64(&self.p) + if self.minus { -root } else { root }).abs()
    }
}
