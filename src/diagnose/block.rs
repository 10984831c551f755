//! Columns that are solved together: their sums over whitened frames.

use super::columns::OWN;
use super::data::Data;
use super::gram::{Filled, Whitened};
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

/// A few frames, whitened, one after the other: a row a pixel.
#[derive(Default)]
pub struct Rows {
    /// By the pixel's own numbers.
    pub own: Vec<[f64; OWN]>,
    /// By the set's position.
    pub position: Vec<f64>,
    /// Root of the weight.
    pub roots: Vec<f64>,
    /// Residual.
    pub residual: Vec<f64>,
    /// Of each frame, not whitened: the columns that all blocks share, and those of each block.
    pub columns: Vec<(Vec<Vec<f64>>, Filled)>,
}

impl Rows {
    /// With a frame, whose columns are to follow.
    pub fn push(&mut self, data: &Data, whitened: &Whitened) {
        let Whitened { frame, roots, residual, .. } = *whitened;
        for (pixel, &root) in roots.iter().enumerate() {
            // A background never moves: as long as the light is on, its constant light is ambient light.
            let constant = if data.tells_constant(pixel) { frame.own[2][pixel] } else { 0.0 };
            let own = [frame.own[0][pixel], frame.own[1][pixel], constant, frame.own[3][pixel]];
            self.own.push(own.map(|own| root * own));
            self.position.push(root * frame.position[pixel]);
        }
        self.roots.extend_from_slice(roots);
        self.residual.extend_from_slice(residual);
    }

    /// Of each frame, the columns that block `number` has there, by their numbers: first the `shared` ones.
    pub fn active(&self, number: usize, shared: usize) -> Vec<Vec<(usize, &[f64])>> {
        let mut active = Vec::new();
        for (common, filled) in &self.columns {
            let common = common.iter().enumerate().map(|(column, values)| (column, &values[..]));
            let own = filled[number].iter().map(|(column, values)| (shared + column, &values[..]));
            active.push(common.chain(own).filter(|(_, values)| !values.is_empty()).collect());
        }
        active
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

    /// With `rows` of number `set`, whose columns are `active` frame by frame.
    pub fn add(&mut self, set: usize, rows: &Rows, active: &[Vec<(usize, &[f64])>]) {
        let last = self.full.nrows() - 1;
        let pixels = self.mixed.nrows() / OWN;
        let mut numbers: Vec<usize> = active.iter().flatten().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let mut values = DMatrix::<f64>::zeros(rows.roots.len(), numbers.len() + 1);
        for (frame, columns) in active.iter().enumerate() {
            let roots = &rows.roots[frame * pixels..][..pixels];
            for (number, column) in columns {
                let Ok(place) = numbers.binary_search(number) else { continue };
                let mut of_frame = values.column_mut(place);
                let of_frame = of_frame.as_mut_slice()[frame * pixels..][..pixels].iter_mut();
                of_frame.zip(roots).zip(*column).for_each(|((value, root), column)| *value = root * column);
            }
        }
        values.column_mut(numbers.len()).copy_from_slice(&rows.residual);
        numbers.push(last);
        let turned = values.transpose();
        let product = &turned * &values;
        let along = turned * DVector::from_column_slice(&rows.position);
        for (a, &row) in numbers.iter().enumerate() {
            for (b, &column) in numbers.iter().enumerate() {
                self.full[(row, column)] += product[(a, b)];
            }
            self.position[set][row] += along[a];
        }
        for (a, &column) in numbers.iter().enumerate() {
            let (values, mut sums) = (values.column(a), self.mixed.column_mut(column));
            let mix = Mix { own: &rows.own, values: values.as_slice(), sums: sums.as_mut_slice() };
            pulp::Arch::new().dispatch(mix);
        }
    }
}

/// Adds a column's products with the pixels' own numbers to their sums, all frames of a pixel at once.
struct Mix<'a> {
    own: &'a [[f64; OWN]],
    values: &'a [f64],
    sums: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Mix<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let pixels = self.sums.len() / OWN;
        for (pixel, sums) in self.sums.chunks_exact_mut(OWN).enumerate() {
            let mut total = [0.0; OWN];
            let frames =
                self.own[pixel..].iter().step_by(pixels).zip(self.values[pixel..].iter().step_by(pixels));
            for (own, value) in frames {
                for (total, own) in total.iter_mut().zip(own) {
                    *total += own * value;
                }
            }
            sums.iter_mut().zip(total).for_each(|(sum, total)| *sum += total);
        }
    }
}
