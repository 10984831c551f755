//! Sums of roots of unity with integer factors, and whether such a sum is zero: exactly, in integers.

use std::collections::BTreeMap;

/// An element of Z\[ζ\] with ζ = exp(2πi / order): a sum of integers times powers of ζ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cyclotomic {
    order: i64,
    /// Factors, by exponents 0 … order − 1. None is 0.
    terms: BTreeMap<i64, i128>,
}

impl Cyclotomic {
    /// Zero, as a sum of roots of unity of the order `order` (≥ 1).
    pub fn zero(order: i64) -> Self {
        Self { order, terms: BTreeMap::new() }
    }

    /// Adds `factor` · ζ^`exponent`.
    pub fn add(&mut self, exponent: i64, factor: i128) {
        let sum = self.terms.entry(exponent.rem_euclid(self.order)).or_insert(0);
        *sum += factor;
        if *sum == 0 {
            self.terms.remove(&exponent.rem_euclid(self.order));
        }
    }

    /// Whether the sum is zero.
    ///
    /// With a(x) for the sum, x for ζ: Π (1 − x^(order/p)) over the primes p that divide the order is 0 at every root of
    /// x^order − 1 of a lower order, and at none of the very order. So a(ζ) = 0 exactly if the product of both is 0 at all
    /// roots of x^order − 1, that is, if it leaves no remainder by it. (That a is 0 at one root of that order makes it 0 at
    /// all: they are conjugates over the integers.)
    pub fn is_zero(&self) -> bool {
        let mut product = self.clone();
        for prime in primes_of(self.order) {
            for (exponent, factor) in product.terms.clone() {
                product.add(exponent + self.order / prime, -factor);
            }
        }
        product.terms.is_empty()
    }
}

/// The primes that divide `number` (≥ 1).
fn primes_of(mut number: i64) -> Vec<i64> {
    let mut primes = Vec::new();
    let mut divisor = 2;
    while divisor * divisor <= number {
        if number % divisor == 0 {
            primes.push(divisor);
            while number % divisor == 0 {
                number /= divisor;
            }
        }
        divisor += 1;
    }
    if number > 1 {
        primes.push(number);
    }
    primes
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;
    use std::f64::consts::TAU;

    fn sum(order: i64, terms: &[(i64, i128)]) -> Cyclotomic {
        let mut sum = Cyclotomic::zero(order);
        terms.iter().for_each(|&(exponent, factor)| sum.add(exponent, factor));
        sum
    }

    /// The roots of unity of an order add up to 0, those of a prime factor too, and so do sums of such.
    #[test]
    fn vanishing_sums_vanish_and_their_neighbours_do_not() {
        for order in 2..=60 {
            let all: Vec<(i64, i128)> = (0..order).map(|exponent| (exponent, 1)).collect();
            assert!(sum(order, &all).is_zero(), "{order}");
            for prime in primes_of(order) {
                let mut polygon: Vec<_> = (0..prime).map(|corner| (1 + corner * order / prime, 7)).collect();
                assert!(sum(order, &polygon).is_zero(), "{order}, {prime}");
                polygon[0].1 += 1;
                assert!(!sum(order, &polygon).is_zero(), "{order}, {prime}");
            }
        }
        // 1 + ζ5 … and a third: -ζ6 - ζ6^5 + 1 = 0 and i² + 1 = 0.
        assert!(sum(6, &[(1, -1), (5, -1), (0, 1)]).is_zero());
        assert!(sum(4, &[(2, 1), (0, 1)]).is_zero());
        assert!(!sum(4, &[(1, 1), (0, 1)]).is_zero());
        assert!(sum(12, &[]).is_zero());
    }

    /// Near zero is not zero: the golden ratio's powers by Fibonacci numbers, F(n) φ − F(n + 1) = ±φ^−n, with φ = −ζ² − ζ³.
    #[test]
    fn what_floating_point_takes_for_zero_is_not() {
        let (mut one, mut other) = (1_i128, 1_i128);
        for _ in 0..80 {
            (one, other) = (other, one + other);
        }
        let near = sum(5, &[(2, -one), (3, -one), (0, -other)]);
        let value: Complex64 = near
            .terms
            .iter()
            .map(|(&exponent, &factor)| Complex64::from_polar(factor as f64, TAU * exponent as f64 / 5.0))
            .sum();
        assert!(value.norm() / one as f64 <= 1e-14, "{value}");
        assert!(!near.is_zero());
    }
}
