//! Columns that are solved together: their sums over whitened frames.

use super::columns::OWN;
use super::data::Data;
use super::gram::Whitened;
use nalgebra::{DMatrix, DVector};
use ndarray::{ArrayView2, Axis};

/// Columns that are solved together, and, last, the residual.
#[derive(Debug, Clone)]
pub struct Block {
    /// G' W G, its lower triangle.
    pub full: DMatrix<f64>,
    /// The pixels' own numbers against columns and residual: (4 x pixels) x (columns + 1).
    pub mixed: DMatrix<f64>,
    /// A set's position against columns and residual.
    pub position: Vec<DVector<f64>>,
}

/// One frame, whitened: a row a pixel.
pub struct Rows<'a> {
    /// By the pixel's own numbers.
    pub own: Vec<[f64; OWN]>,
    /// By the set's position.
    pub position: Vec<f64>,
    /// Root of the weight.
    pub roots: &'a [f64],
    /// Residual.
    pub residual: &'a [f64],
}

impl<'a> Rows<'a> {
    /// Those of a frame.
    pub fn of(data: &Data, whitened: &Whitened<'a>) -> Self {
        let Whitened { frame, roots, residual, .. } = *whitened;
        let own = |(pixel, &root): (usize, &f64)| {
            // A background never moves: as long as the light is on, its constant light is ambient light.
            let constant = if data.tells_constant(pixel) { frame.own[2][pixel] } else { 0.0 };
            [frame.own[0][pixel], frame.own[1][pixel], constant, frame.own[3][pixel]].map(|own| root * own)
        };
        let position = roots.iter().zip(&frame.position).map(|(root, position)| root * position);
        Self {
            own: roots.iter().enumerate().map(own).collect(),
            position: position.collect(),
            roots,
            residual,
        }
    }
}

impl Block {
    /// Without any frame, for so many `columns` and `sets`.
    pub fn empty(pixels: usize, columns: usize, sets: usize) -> Self {
        Self {
            full: DMatrix::zeros(columns + 1, columns + 1),
            mixed: DMatrix::zeros(OWN * pixels, columns + 1),
            position: vec![DVector::zeros(0); sets],
        }
    }

    /// With the frames of another, of other sets.
    pub fn join(&mut self, other: Self) {
        self.full += other.full;
        self.mixed += other.mixed;
        for (a, b) in self.position.iter_mut().zip(other.position) {
            if a.is_empty() {
                *a = b;
            }
        }
    }

    /// With `rows` of a frame of number `set`, in which the columns `active` act, by their numbers.
    pub fn add(&mut self, set: usize, rows: &Rows, active: &[(usize, &[f64])]) {
        let (pixels, last) = (rows.roots.len(), self.full.nrows() - 1);
        // The columns, the residual, and the set's position.
        let mut values = Vec::with_capacity(pixels * (active.len() + 2));
        for (_, column) in active {
            values.extend(column.iter().zip(rows.roots).map(|(column, root)| root * column));
        }
        values.extend_from_slice(rows.residual);
        values.extend_from_slice(&rows.position);
        let values = ArrayView2::from_shape((active.len() + 2, pixels), &values).expect("a row a column");
        let numbers: Vec<usize> = active.iter().map(|(number, _)| *number).chain([last]).collect();
        // Products of columns, each pair once but for those of one panel.
        for first in (0..numbers.len()).step_by(PANEL) {
            let width = PANEL.min(numbers.len() - first);
            let rest = values.slice_axis(Axis(0), (first..).into());
            let product = rest.slice_axis(Axis(0), (..width).into()).dot(&rest.t());
            for (number, product) in product.outer_iter().enumerate() {
                let column = numbers[first + number];
                for (value, &row) in product.iter().skip(number).zip(&numbers[first + number..]) {
                    self.full[(row.max(column), row.min(column))] += value;
                }
                self.position[set][column] += product[product.len() - 1];
            }
        }
        for (values, &column) in values.outer_iter().zip(&numbers) {
            let mut sums = self.mixed.column_mut(column);
            let values = values.to_slice().expect("a row is a slice");
            let mix = Mix { own: &rows.own, values, sums: sums.as_mut_slice() };
            pulp::Arch::new().dispatch(mix);
        }
    }
}

/// So many columns are multiplied with all others at a time: half of a symmetric product need not be made.
const PANEL: usize = 64;

/// Adds a column's products with the pixels' own numbers to their sums.
struct Mix<'a> {
    own: &'a [[f64; OWN]],
    values: &'a [f64],
    sums: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Mix<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for ((sums, own), value) in self.sums.chunks_exact_mut(OWN).zip(self.own).zip(self.values) {
            for (sum, own) in sums.iter_mut().zip(own) {
                *sum += own * value;
            }
        }
    }
}
