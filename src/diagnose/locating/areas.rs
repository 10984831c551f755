//! Neighbouring pixels together: what each says of one way of being off, summed over rectangles of them.

use nalgebra::{Matrix4, Vector4};

/// A pixel counts for so many standard deviations at most: one alone is no patch.
const MOST_SIGMAS: f64 = 4.0;
/// What is nearly all absorbed by the pixel's own numbers is rounding.
const SEEN: f64 = 1e-3;
/// Shares of the rectangles of one size, and chi squared of one degree that noise makes so often (Abramowitz and Stegun 1964, table 26.8).
const USUAL: [(f64, f64); 2] = [(0.5, 0.455), (0.3, 1.074)];

/// What a pixel, or several, say of one way of being off: score and information.
pub type Said = (f64, f64);

/// The rectangle of a size that is off most in any of the parts that were looked at.
#[derive(Debug, Clone)]
pub struct Rectangle<P> {
    /// Of which of the sizes it is.
    pub size: (usize, usize),
    /// First and last row and column, of the pixels that are looked at.
    pub rows: (usize, usize),
    /// The same of columns.
    pub columns: (usize, usize),
    /// The part of what was recorded.
    pub part: P,
    /// Its chi squared, over what those of its size usually have.
    pub chi2: f64,
}

/// A search for that over parts.
pub struct Search<P> {
    sizes: &'static [(usize, usize)],
    squares: Vec<Vec<f64>>,
    greatest: Vec<Option<Rectangle<P>>>,
}

impl<P: Copy> Search<P> {
    /// Of rectangles of these `sizes`, rows and columns; as many as there are (0): whole lines.
    pub fn of(sizes: &'static [(usize, usize)]) -> Self {
        Self { sizes, squares: vec![Vec::new(); sizes.len()], greatest: sizes.iter().map(|_| None).collect() }
    }

    /// Looks at what pixels say in a part, in lines of so many.
    pub fn look(&mut self, said: &[Said], width: usize, part: P) {
        let area = Area::of(said, width);
        for ((&size, squares), greatest) in self.sizes.iter().zip(&mut self.squares).zip(&mut self.greatest) {
            let (height, width) = area.size(size);
            for (row, column, (score, information)) in area.patches((height, width)) {
                let chi2 = score * score / information;
                squares.push(chi2);
                if greatest.as_ref().is_none_or(|of_size| chi2 > of_size.chi2) {
                    let (rows, columns) = ((row, row + height - 1), (column, column + width - 1));
                    *greatest = Some(Rectangle { size, rows, columns, part, chi2 });
                }
            }
        }
    }

    /// What is greatest of each size.
    pub fn end(self) -> impl Iterator<Item = Rectangle<P>> {
        let over_usual = |(mut squares, greatest): (Vec<f64>, Option<Rectangle<P>>)| {
            greatest.map(|of| Rectangle { chi2: of.chi2 / inflation(&mut squares), ..of })
        };
        self.squares.into_iter().zip(self.greatest).filter_map(over_usual)
    }
}

/// All spans of parts that follow one another, of so many: the first and the last of each.
pub fn spans(parts: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..parts).flat_map(move |from| (from..parts).map(move |to| (from, to)))
}

/// What a pixel says beside its own numbers, of which `inverse` is that of their normal equations: `score` and `raw` information, and what they share with these.
pub fn beside_own(score: f64, raw: f64, shared: Vector4<f64>, inverse: &Matrix4<f64>) -> Said {
    let information = raw - shared.dot(&(inverse * shared));
    if information > SEEN * raw { (score, information) } else { (0.0, 0.0) }
}

/// Takes from what pixels say what all of the target, or of the background, do, and of each what is beyond some standard deviations.
pub fn leave_common(said: &mut [Said], target: &[bool]) {
    for is_target in [false, true] {
        let here = |pixel: usize| target[pixel] == is_target;
        // A patch that is far off is no part of what all do: the median.
        let of = said.iter().enumerate().filter(|(pixel, said)| here(*pixel) && said.1 > 0.0);
        let mut off: Vec<f64> = of.map(|(_, (score, information))| score / information).collect();
        let middle = off.len() / 2;
        if off.is_empty() {
            continue;
        }
        let common = *off.select_nth_unstable_by(middle, f64::total_cmp).1;
        for (_, said) in said.iter_mut().enumerate().filter(|(pixel, _)| here(*pixel)) {
            let most = MOST_SIGMAS * said.1.sqrt();
            said.0 = (said.0 - common * said.1).clamp(-most, most);
        }
    }
}

/// By how much rectangles say more than noise makes them, where most of them do, or many.
fn inflation(squares: &mut [f64]) -> f64 {
    let count = squares.len();
    let usual = |(share, of_noise): (f64, f64)| {
        let place = ((1.0 - share) * (count - 1) as f64) as usize;
        *squares.select_nth_unstable_by(place, f64::total_cmp).1 / of_noise
    };
    USUAL.map(usual).into_iter().fold(1.0, f64::max)
}

/// Sums over all pixels above and to the left.
struct Area {
    width: usize,
    height: usize,
    /// `[row][column]`, with a first row and column of zeros.
    sums: Vec<Said>,
}

impl Area {
    fn of(said: &[Said], width: usize) -> Self {
        let (height, line) = (said.len() / width, width + 1);
        let mut sums = vec![(0.0, 0.0); (height + 1) * line];
        for row in 0..height {
            let mut of_row = (0.0, 0.0);
            for column in 0..width {
                let (score, information) = said[row * width + column];
                of_row = (of_row.0 + score, of_row.1 + information);
                let above = sums[row * line + column + 1];
                sums[(row + 1) * line + column + 1] = (above.0 + of_row.0, above.1 + of_row.1);
            }
        }
        Self { width, height, sums }
    }

    /// So many rows and columns, or all of them.
    fn size(&self, (rows, columns): (usize, usize)) -> (usize, usize) {
        (if rows == 0 { self.height } else { rows }, if columns == 0 { self.width } else { columns })
    }

    /// Those of so many rows and columns of which anything is known: first row and column, and the sum.
    fn patches(&self, (height, width): (usize, usize)) -> impl Iterator<Item = (usize, usize, Said)> {
        let line = self.width + 1;
        let (rows, columns) =
            ((self.height + 1).saturating_sub(height), (self.width + 1).saturating_sub(width));
        let at = move |row: usize, column: usize| self.sums[row * line + column];
        let of = move |row: usize, column: usize| {
            let (a, b) = (at(row, column), at(row + height, column + width));
            let (c, d) = (at(row, column + width), at(row + height, column));
            (row, column, (a.0 + b.0 - c.0 - d.0, a.1 + b.1 - c.1 - d.1))
        };
        let all = (0..rows).flat_map(move |row| (0..columns).map(move |column| of(row, column)));
        // Of the whole, what is left of nothing by rounding is nothing.
        let least = 1e-9 * self.sums.last().map_or(0.0, |all| all.1);
        all.filter(move |(_, _, (_, information))| *information > least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a sum over a rectangle nothing but the corners is asked.
    #[test]
    fn sums_over_areas_are_those_of_their_pixels() {
        let said: Vec<Said> = (0..12).map(|pixel| (f64::from(pixel * pixel % 7), 1.0)).collect();
        let area = Area::of(&said, 4);
        let by_hand = |row: usize, column: usize, (height, width): (usize, usize)| -> f64 {
            let rows = (row..row + height).flat_map(|row| (column..column + width).map(move |c| row * 4 + c));
            rows.map(|pixel| said[pixel].0).sum()
        };
        for size in [(2, 2), area.size((1, 0)), area.size((0, 3)), (3, 3)] {
            let patches: Vec<_> = area.patches(size).collect();
            assert_eq!(patches.len(), (4 - size.0) * (5 - size.1));
            for (row, column, (score, information)) in patches {
                assert_eq!((score, information), (by_hand(row, column, size), (size.0 * size.1) as f64));
            }
        }
        assert_eq!(area.size((1, 0)), (1, 4));
        assert_eq!(area.patches((4, 4)).count(), 0);
    }

    /// Of a normal distribution half of the squares are above 0.455, and three tenths above 1.074: twice as much scatter has four times that.
    #[test]
    fn what_most_patches_say_is_taken_from_each() {
        let squares = |scale: f64| -> Vec<f64> {
            crate::physics::Draws::of(3, 1).normal(20_000).iter().map(|z| scale * z * z).collect()
        };
        assert!((1.0..1.05).contains(&inflation(&mut squares(1.0))));
        assert!((3.9..4.2).contains(&inflation(&mut squares(4.0))));
        assert_eq!(inflation(&mut squares(0.5)), 1.0);
    }
}
