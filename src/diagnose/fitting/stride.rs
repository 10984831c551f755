//! Steps of Gauss and Newton, whole ones and others, within the bounds of numbers.

use super::projected::Projected;
use crate::diagnose::tangents::columns::Column;
use crate::diagnose::tangents::pieces::Piece;
use nalgebra::{DMatrix, DVector};

/// What is taken of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stride {
    /// All of it.
    Whole,
    /// With so much more of each number's own information.
    Damped(f64),
    /// The step of all numbers but those of shapes: where frames see a flicker at its own pace, its frequency is an extremum, whose tangent says nothing, and the
    /// strength is far from known.
    ShapesHeld,
}

impl Stride {
    /// One after the other, until one is taken (Levenberg 1944, Marquardt 1963).
    pub const ALL: [Self; 5] =
        [Self::Whole, Self::Damped(1e-2), Self::Damped(0.3), Self::Damped(10.0), Self::ShapesHeld];

    /// All of them, from this one on, which was taken, or, if it `kept` what was promised, from the one on that is damped less: what was too far there is
    /// likely to be here, and comes last.
    pub fn and_after(self, kept: bool) -> impl Iterator<Item = Self> {
        let place = Self::ALL.iter().position(|stride| *stride == self).unwrap_or(0);
        let less = if self == Self::ShapesHeld { 0 } else { place.saturating_sub(usize::from(kept)) };
        Self::ALL.into_iter().cycle().skip(less).take(Self::ALL.len())
    }
}

/// Whether the number of a `column` is a shape.
pub fn is_shape(column: &Column, pieces: &[Piece]) -> bool {
    pieces[column.piece].effect.parameters[column.parameter].is_shape()
}

/// How far the number of each column may go.
fn reaches(columns: &[Column], pieces: &[Piece], full_scale_dn: f64) -> Vec<f64> {
    let parameter = |column: &Column| &pieces[column.piece].effect.parameters[column.parameter];
    columns.iter().map(|column| parameter(column).reach(full_scale_dn)).collect()
}

/// The step to the minimum for numbers that stay within their bounds: one that is at a bound and would go beyond stays where it is. And the covariance
/// there, of all: that a number is held does not make the others better known beside it than they are (a bound does a little: this is the safe side).
pub fn bounded_step(
    projected: &Projected,
    columns: &[Column],
    pieces: &[Piece],
    full_scale_dn: f64,
    stride: Stride,
) -> (DVector<f64>, DMatrix<f64>) {
    let mut reach = reaches(columns, pieces, full_scale_dn);
    let damping = if let Stride::Damped(damping) = stride { damping } else { 0.0 };
    if stride == Stride::ShapesHeld {
        let shapes = reach.iter_mut().zip(columns).filter(|(_, column)| is_shape(column, pieces));
        shapes.for_each(|(reach, _)| *reach = 0.0);
    }
    let (mut theta, covariance) = step(projected, &reach, damping);
    loop {
        let goes_beyond = |number: &usize| {
            let piece = &pieces[columns[*number].piece];
            let parameter = columns[*number].parameter;
            let (low, high) = piece.bounds_within(parameter, full_scale_dn);
            let (value, step) = (piece.values[parameter], theta[*number]);
            reach[*number] > 0.0 && (step < 0.0 && value <= low || step > 0.0 && value >= high)
        };
        let Some(held) = (0..columns.len()).find(goes_beyond) else { return (theta, covariance) };
        reach[held] = 0.0;
        theta = step(projected, &reach, damping).0;
    }
}

/// The step to the minimum, and the covariance there. That no number goes beyond its `reach` is known beforehand; one without any
/// stays where it is.
fn step(projected: &Projected, reach: &[f64], damping: f64) -> (DVector<f64>, DMatrix<f64>) {
    let size = projected.vector.len();
    if size == 0 {
        return (DVector::zeros(0), DMatrix::zeros(0, 0));
    }
    let known = |c: usize| projected.matrix[(c, c)].max(0.0) + reach[c].powi(-2);
    let scale = DVector::from_fn(size, |c, _| if reach[c] > 0.0 { known(c).sqrt().recip() } else { 0.0 });
    let scaled = DMatrix::from_fn(size, size, |row, column| {
        let value =
            if row == column { (1.0 + damping) * known(row) } else { projected.matrix[(row, column)] };
        if reach[row] > 0.0 && reach[column] > 0.0 { value * scale[row] * scale[column] } else { 0.0 }
    });
    let eigen = scaled.symmetric_eigen();
    let kept = eigen.eigenvalues.map(|value| if value > 1e-6 { value.recip() } else { 0.0 });
    let inverse = &eigen.eigenvectors * DMatrix::from_diagonal(&kept) * eigen.eigenvectors.transpose();
    let theta = (&inverse * projected.vector.component_mul(&scale)).component_mul(&scale);
    let covariance = DMatrix::from_fn(size, size, |r, c| inverse[(r, c)] * scale[r] * scale[c]);
    (theta, covariance)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever was taken, all are tried, and what was damped more comes first.
    #[test]
    fn strides_go_on_from_the_last_one() {
        let [whole, little, more, much, held] = Stride::ALL;
        let after = |stride: Stride| stride.and_after(true).collect::<Vec<_>>();
        assert_eq!(after(whole), Stride::ALL);
        assert_eq!(after(little), Stride::ALL);
        assert_eq!(after(more), [little, more, much, held, whole]);
        assert_eq!(after(much), [more, much, held, whole, little]);
        assert_eq!(after(held), Stride::ALL);
        // What led not nearly as far down as it should is damped as before.
        let after = |stride: Stride| stride.and_after(false).collect::<Vec<_>>();
        assert_eq!(after(whole), Stride::ALL);
        assert_eq!(after(little), [little, more, much, held, whole]);
        assert_eq!(after(held), Stride::ALL);
    }
}
