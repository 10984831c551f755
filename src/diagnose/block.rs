//! Columns that are solved together: their sums over whitened frames.

use super::columns::OWN;
use super::data::Data;
use super::gram::Whitened;
use nalgebra::{DMatrix, DVector};

/// Columns that are solved together, and, last, the residual.
#[derive(Debug, Clone)]
pub struct Block {
    /// G' W G.
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
        let last = self.full.nrows() - 1;
        // The columns, the residual, and the set's position.
        let mut values = DMatrix::<f64>::zeros(rows.roots.len(), active.len() + 2);
        for ((_, column), mut values) in active.iter().zip(values.column_iter_mut()) {
            let values = values.as_mut_slice().iter_mut();
            values.zip(rows.roots).zip(*column).for_each(|((value, root), column)| *value = root * column);
        }
        values.column_mut(active.len()).copy_from_slice(rows.residual);
        values.column_mut(active.len() + 1).copy_from_slice(&rows.position);
        let numbers: Vec<usize> = active.iter().map(|(number, _)| *number).chain([last]).collect();
        let product = values.transpose() * &values;
        let along = product.column(numbers.len());
        for (product, &column) in product.column_iter().zip(&numbers) {
            let mut sums = self.full.column_mut(column);
            for (value, &row) in product.iter().zip(&numbers) {
                sums[row] += value;
            }
        }
        for (along, &row) in along.iter().zip(&numbers) {
            self.position[set][row] += along;
        }
        for (a, &column) in numbers.iter().enumerate() {
            let (values, mut sums) = (values.column(a), self.mixed.column_mut(column));
            let mix = Mix { own: &rows.own, values: values.as_slice(), sums: sums.as_mut_slice() };
            pulp::Arch::new().dispatch(mix);
        }
    }
}

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
