//! Words for roots, lists and weights.

use crate::algorithms::{Algorithm, Verdict};
use crate::spec::{Irrational, Scheme, SchemeOrigin};

/// `1, 2, 3`, or `none`.
pub fn list(numbers: &[usize]) -> String {
    if numbers.is_empty() {
        return "none".to_owned();
    }
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// `once`, `twice`, `3 times`.
pub fn times(count: usize) -> String {
    match count {
        1 => "once".to_owned(),
        2 => "twice".to_owned(),
        _ => format!("{count} times"),
    }
}

/// The roots of equal steps, such as `0, 2 once; -1 twice`, and how many others there are.
pub fn roots(algorithm: &Algorithm, verdict: &Verdict) -> String {
    let Some(step) = algorithm.equal_step() else { return "unequal steps".to_owned() };
    let parts = step.denominator() as usize;
    let mut counts: Vec<usize> = verdict.roots.iter().map(|root| root.1).collect();
    counts.sort_unstable();
    counts.dedup();
    let mut words = if counts.len() == 1 && verdict.roots.len() == parts - 1 && parts > 3 {
        vec![format!("all but 1 {}", times(counts[0]))]
    } else {
        let of = |count: usize| {
            let mut ms: Vec<i64> =
                verdict.roots.iter().filter(|root| root.1 == count).map(|root| root.0).collect();
            ms.sort_by_key(|m| (m.abs(), *m));
            let ms: Vec<String> = ms.iter().map(ToString::to_string).collect();
            format!("{} {}", ms.join(", "), times(count))
        };
        counts.into_iter().map(of).collect()
    };
    let others = algorithm.frames() - 1 - verdict.roots.iter().map(|root| root.1).sum::<usize>();
    if others > 0 {
        words.push(format!("{others} other{}", if others == 1 { "" } else { "s" }));
    }
    words.join("; ")
}

/// What the weights are, in a few words.
pub fn weights(algorithm: &Algorithm) -> String {
    let Some(scheme) = &algorithm.scheme else { return "no: it estimates the step".to_owned() };
    match (scheme.origin, scheme.irrational) {
        (SchemeOrigin::Dft { coefficient_bits }, _) if algorithm.is_rounded() => {
            format!("rounded to {coefficient_bits} bits")
        }
        (_, Irrational::One) => "integer".to_owned(),
        (_, Irrational::Sqrt3) => "integer, sqrt(3)".to_owned(),
    }
}

/// Both rows of weights.
pub fn rows(scheme: &Scheme) -> String {
    let factor = match scheme.irrational {
        Irrational::One => "",
        Irrational::Sqrt3 => "sqrt(3) ",
    };
    format!("{:?}, {factor}{:?}", scheme.in_phase, scheme.quadrature)
}
