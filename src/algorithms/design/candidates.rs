//! Polynomials with the roots of a demand: the shortest one times small cofactors.

use super::request::{Demand, Ring};
use num_complex::Complex64;
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// A polynomial of Surrel's sign, lowest power first.
pub(super) type Coefficients = Vec<Complex64>;

/// Cofactors of one degree that are tried at most of each kind.
const MOST_COFACTORS: usize = 20_000;
/// Largest multiple to which the cofactor of least noise is rounded.
const MOST_SCALE: i32 = 64;

fn product(one: &[Complex64], other: &[Complex64]) -> Coefficients {
    let mut product = vec![Complex64::ZERO; one.len() + other.len() - 1];
    for (n, a) in one.iter().enumerate() {
        for (m, b) in other.iter().enumerate() {
            product[n + m] += a * b;
        }
    }
    product
}

/// The polynomial with the roots exp(2πi step residue), each as often as it is named.
fn with_roots(demand: &Demand, residues: impl Iterator<Item = i64>) -> Coefficients {
    let roots = residues
        .map(|residue| Complex64::from_polar(1.0, TAU * (residue as f64 * demand.step.turns()).fract()));
    let polynomial = roots.fold(vec![Complex64::ONE], |all, root| product(&all, &[-root, Complex64::ONE]));
    // Products of whole orbits have coefficients in the ring: only rounding is taken away here.
    polynomial.into_iter().map(|c| nearest(demand.ring, c)).collect()
}

/// The ring's integer nearest to `value` along the axes of its lattice.
fn nearest(ring: Ring, value: Complex64) -> Complex64 {
    let lattice = ring.lattice();
    let along = (value.im / lattice.im).round();
    (value - along * lattice).re.round() + along * lattice
}

/// Noise factor of `polynomial` with `demand`'s step; infinite where it is blind to the fundamental.
pub(super) fn noise_factor(demand: &Demand, polynomial: &[Complex64]) -> f64 {
    let power: f64 = polynomial.iter().map(Complex64::norm_sqr).sum();
    (2.0 * power).sqrt() / at_fundamental(demand, polynomial).norm()
}

fn at_fundamental(demand: &Demand, polynomial: &[Complex64]) -> Complex64 {
    let root = Complex64::from_polar(1.0, demand.step.rad());
    polynomial.iter().rev().fold(Complex64::ZERO, |value, c| value * root + c)
}

/// Polynomials of `frames` coefficients, neither end 0, with the roots of `demand`: the shortest times products of whole
/// orbits of roots, times small integers of the ring, and times rounded multiples of the cofactor of least noise.
pub(super) fn candidates(demand: &Demand, frames: usize) -> Vec<Coefficients> {
    let demanded = demand.roots.iter().flat_map(|(&residue, &times)| std::iter::repeat_n(residue, times));
    let shortest = with_roots(demand, demanded);
    let Some(degree) = (frames + 1).checked_sub(shortest.len() + 1) else { return Vec::new() };
    let mut cofactors = of_orbits(demand, degree);
    cofactors.extend(of_small_integers(demand.ring, degree));
    cofactors.extend(of_least_noise(demand, &shortest, degree));
    let whole = |cofactor: &Coefficients| {
        cofactor.first().is_some_and(|c| c.norm() > 0.5) && cofactor.last().is_some_and(|c| c.norm() > 0.5)
    };
    cofactors.iter().filter(|cofactor| whole(cofactor)).map(|cofactor| product(&shortest, cofactor)).collect()
}

/// Products of further whole orbits, with repetition, of just this degree.
fn of_orbits(demand: &Demand, degree: usize) -> Vec<Coefficients> {
    let parts = demand.step.denominator();
    let orbits: BTreeSet<Vec<i64>> = (0..parts)
        .map(|residue| demand.ring.orbit(residue, parts))
        .filter(|orbit| !orbit.contains(&1))
        .map(|orbit| orbit.into_iter().collect())
        .collect();
    let mut open: Vec<(Vec<i64>, usize)> = vec![(Vec::new(), 0)];
    let orbits: Vec<Vec<i64>> = orbits.into_iter().collect();
    let mut found = Vec::new();
    while let Some((residues, from)) = open.pop() {
        if residues.len() == degree {
            found.push(with_roots(demand, residues.into_iter()));
            if found.len() == MOST_COFACTORS {
                break;
            }
            continue;
        }
        for (number, orbit) in orbits.iter().enumerate().skip(from) {
            if residues.len() + orbit.len() <= degree {
                open.push(([&residues[..], orbit].concat(), number));
            }
        }
    }
    found
}

/// All with the highest coefficient 1 and the others at most 2 (or 1) steps of the lattice away from 0 on either axis, while
/// they are few enough.
fn of_small_integers(ring: Ring, degree: usize) -> Vec<Coefficients> {
    for most in [2_i32, 1] {
        let choices = (2 * most as usize + 1).pow(2);
        let count = choices.checked_pow(degree as u32).unwrap_or(usize::MAX);
        if count > MOST_COFACTORS {
            continue;
        }
        let element = |choice: usize| {
            let side = 2 * most as usize + 1;
            let (re, im) = ((choice % side) as f64, (choice / side) as f64);
            (re - f64::from(most)) + (im - f64::from(most)) * ring.lattice()
        };
        let cofactor = |mut number: usize| {
            let mut cofactor: Coefficients = Vec::with_capacity(degree + 1);
            for _ in 0..degree {
                cofactor.push(element(number % choices));
                number /= choices;
            }
            cofactor.push(Complex64::ONE);
            cofactor
        };
        return (0..count).map(cofactor).collect();
    }
    Vec::new()
}

/// Rounded multiples of the cofactor with which Σ|c|² is least at the same response to the fundamental: of the normal
/// equations M q = v with M the products of the shifted polynomials, v the conjugate powers of the fundamental's root.
fn of_least_noise(demand: &Demand, shortest: &[Complex64], degree: usize) -> Vec<Coefficients> {
    let size = degree + 1;
    let shifted = |row: usize, column: usize| -> Complex64 {
        let overlap = shortest.iter().enumerate().filter_map(|(n, c)| {
            let other = (n + column).checked_sub(row)?;
            Some(shortest.get(other)?.conj() * c)
        });
        overlap.sum()
    };
    let root = Complex64::from_polar(1.0, -demand.step.rad());
    let mut rows: Vec<Vec<Complex64>> = (0..size)
        .map(|row| {
            let left = (0..size).map(|column| shifted(row, column));
            left.chain([root.powu(row as u32)]).collect()
        })
        .collect();
    for pivot in 0..size {
        let best = (pivot..size).max_by(|&a, &b| rows[a][pivot].norm().total_cmp(&rows[b][pivot].norm()));
        let Some(best) = best.filter(|&best| rows[best][pivot].norm() > 1e-9) else { return Vec::new() };
        rows.swap(pivot, best);
        let own = rows[pivot].clone();
        for (row, others) in rows.iter_mut().enumerate() {
            let factor = others[pivot] / own[pivot];
            if row != pivot {
                others.iter_mut().zip(&own).for_each(|(value, own)| *value -= factor * own);
            }
        }
    }
    let solution: Coefficients = (0..size).map(|row| rows[row][size] / rows[row][row]).collect();
    // With the highest coefficient or the largest one along the real axis.
    let largest = solution.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let units = [solution.last().copied(), largest].into_iter().flatten().filter(|unit| unit.norm() > 1e-9);
    let rounded = |unit: Complex64, scale: i32| -> Coefficients {
        solution.iter().map(|c| nearest(demand.ring, c / unit * f64::from(scale))).collect()
    };
    units
        .flat_map(|unit| (1..=MOST_SCALE).map(move |scale| (unit, scale)))
        .map(|(unit, scale)| rounded(unit, scale))
        .collect()
}
