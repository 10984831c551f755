//! How strong a flaw is: the norm of what it changes, in the noise, beyond what each pixel's own numbers could be.

use super::exposure::{Movie, movie};
use super::flaws::Flaw;
use super::scene::Pixel;
use super::world::{Known, World};
use nalgebra::{DMatrix, Matrix4, SymmetricEigen, Vector4};

/// Steps of a pixel's own numbers, relative or in rad.
const STEP: f64 = 0.01;
/// Directions in which a pixel's numbers matter less than this, relative to the most, are left out.
const CUT: f64 = 1e-9;
/// Variance of rounding to whole codes, DN².
const ROUNDING: f64 = 1.0 / 12.0;

/// Measures flaws of one world.
pub struct Ruler<'a> {
    world: &'a World,
    clean: Movie,
    /// Per nuisance, frame and pixel: the derivative.
    slopes: [Movie; 4],
    /// Per pixel, the inverse of the nuisances' normal equations.
    inverses: Vec<Matrix4<f64>>,
}

/// A pixel's own numbers: its delay, amplitude, ambient light and undivided light.
const NUISANCES: [fn(&mut Pixel, f64); 4] = [
    |pixel, step| pixel.delay_rad += step,
    |pixel, step| pixel.amplitude_e *= 1.0 + step,
    |pixel, step| pixel.ambient_e *= 1.0 + step,
    |pixel, step| pixel.constant_e += step * pixel.amplitude_e,
];

impl<'a> Ruler<'a> {
    /// For flaws of `world`, whose flawless frames are those of a camera that knows everything else.
    pub fn of(world: &'a World) -> Self {
        let clean = movie(world, Known::BOTH, &[], None);
        let slopes = NUISANCES.map(|nudge| {
            let moved = |step: f64| {
                let mut world = world.clone();
                world.scene.pixels.iter_mut().for_each(|pixel| nudge(pixel, step));
                movie(&world, Known::BOTH, &[], None)
            };
            let (mut up, down) = (moved(STEP), moved(-STEP));
            for (up, down) in up.iter_mut().flatten().zip(down.iter().flatten()) {
                *up = (*up - down) / (2.0 * STEP);
            }
            up
        });
        let mut ruler = Self { world, clean, slopes, inverses: Vec::new() };
        let mut normals = vec![Matrix4::zeros(); world.scene.pixels.len()];
        for frame in 0..ruler.clean.len() {
            for (pixel, normal) in normals.iter_mut().enumerate() {
                let slope = ruler.slope(frame, pixel);
                *normal += ruler.weight(frame, pixel) * slope * slope.transpose();
            }
        }
        ruler.inverses = normals.iter().map(inverse_of_four).collect();
        ruler
    }

    /// The frames without flaw and noise, DN.
    pub fn clean(&self) -> &Movie {
        &self.clean
    }

    /// One over the variance of a pixel's code in a frame: photons, read noise and rounding.
    fn weight(&self, frame: usize, pixel: usize) -> f64 {
        let sensor = &self.world.sensor;
        let read_dn = sensor.read_noise_e / sensor.gain_e_per_dn;
        let photons = (self.clean[frame][pixel] - sensor.pedestal_dn).max(0.0) / sensor.gain_e_per_dn;
        1.0 / (photons + read_dn * read_dn + ROUNDING)
    }

    fn slope(&self, frame: usize, pixel: usize) -> Vector4<f64> {
        Vector4::from_fn(|nuisance, _| self.slopes[nuisance][frame][pixel])
    }

    /// What `flaws` change in the codes before rounding, of a camera whose simulation knows `known`, DN.
    pub fn change(&self, known: Known, flaws: &[&Flaw]) -> Movie {
        self.beyond(known, movie(self.world, Known::BOTH, flaws, None))
    }

    /// What `frames` are beyond what a camera predicts whose simulation knows `known`, DN.
    pub fn beyond(&self, known: Known, mut frames: Movie) -> Movie {
        // What the simulation does not know is a flaw, too: the difference from what it would predict.
        let unknowing = (known != Known::BOTH).then(|| movie(self.world, known, &[], None));
        let predicted = unknowing.as_ref().unwrap_or(&self.clean);
        for (code, predicted) in frames.iter_mut().flatten().zip(predicted.iter().flatten()) {
            *code -= predicted;
        }
        frames
    }

    /// The strength of the difference `change` of all frames: its norm in standard deviations of the whole campaign, with what
    /// each pixel's own numbers can take up taken away.
    pub fn norm(&self, change: &Movie) -> f64 {
        self.products(&[change])[(0, 0)].max(0.0).sqrt()
    }

    /// What is left of the strength of `change` where any sum of multiples of `others` is taken away, too.
    pub fn norm_beside(&self, change: &Movie, others: &[&Movie]) -> f64 {
        let all: Vec<&Movie> = std::iter::once(change).chain(others.iter().copied()).collect();
        let products = self.products(&all);
        let count = others.len();
        let both = products.view((1, 0), (count, 1)).clone_owned();
        let inverse = inverse(products.view((1, 1), (count, count)).clone_owned());
        (products[(0, 0)] - (both.transpose() * inverse * both)[(0, 0)]).max(0.0).sqrt()
    }

    /// The whitened products of differences with each other, beyond the pixels' own numbers.
    pub fn products(&self, changes: &[&Movie]) -> DMatrix<f64> {
        let (count, pixels) = (changes.len(), self.inverses.len());
        let mut products = DMatrix::zeros(count, count);
        let mut whitened = DMatrix::zeros(pixels, count);
        // Along the pixels' own numbers, number after number.
        let mut along = DMatrix::zeros(self.slopes.len() * pixels, count);
        for frame in 0..self.clean.len() {
            let roots: Vec<f64> = (0..pixels).map(|pixel| self.weight(frame, pixel).sqrt()).collect();
            for (column, change) in changes.iter().enumerate() {
                let mut whitened = whitened.column_mut(column);
                let whitened = whitened.as_mut_slice();
                for ((value, root), change) in whitened.iter_mut().zip(&roots).zip(&change[frame]) {
                    *value = root * change;
                }
                let mut along = along.column_mut(column);
                for (along, slopes) in along.as_mut_slice().chunks_mut(pixels).zip(&self.slopes) {
                    let parts = roots.iter().zip(&slopes[frame]).zip(&*whitened);
                    along
                        .iter_mut()
                        .zip(parts)
                        .for_each(|(sum, ((root, slope), value))| *sum += root * slope * value);
                }
            }
            products.gemm_tr(1.0, &whitened, &whitened, 1.0);
        }
        let mut solved = along.clone();
        for mut column in solved.column_iter_mut() {
            for (pixel, inverse) in self.inverses.iter().enumerate() {
                let solved = inverse * Vector4::from_fn(|number, _| column[number * pixels + pixel]);
                (0..self.slopes.len()).for_each(|number| column[number * pixels + pixel] = solved[number]);
            }
        }
        products.gemm_tr(-1.0, &along, &solved, 1.0);
        products
    }

    /// `flaw` with the size at which it has the strength `rho` (within 3 %); `None` where its mechanism
    /// cannot be as strong or as weak.
    pub fn sized(&self, flaw: &Flaw, rho: f64) -> Option<Flaw> {
        const TRIALS: usize = 14;
        let (mut low, mut high) = (0.0, flaw.mechanism.most);
        let mut size = flaw.mechanism.usual;
        for _ in 0..TRIALS {
            let flaw = flaw.sized(size);
            let found = self.norm(&self.change(Known::BOTH, &[&flaw]));
            if !found.is_finite() {
                return None;
            }
            if (found / rho - 1.0).abs() < 0.03 {
                return Some(flaw);
            }
            if found < rho {
                low = size;
            } else {
                high = size;
            }
            if low >= flaw.mechanism.most {
                return None;
            }
            // In proportion, where that stays in the bracket; from the largest size it is bisected down.
            let next = if found > 0.0 { size * rho / found } else { f64::INFINITY };
            size = if next > low && next < high {
                next
            } else if low == 0.0 || high < flaw.mechanism.most {
                0.5 * (low + high)
            } else {
                flaw.mechanism.most
            };
        }
        None
    }
}

/// The inverse of normal equations, without the directions that do not matter.
fn inverse(normal: DMatrix<f64>) -> DMatrix<f64> {
    let scale = normal.diagonal().map(|value| if value > 0.0 { 1.0 / value.sqrt() } else { 0.0 });
    let scale = DMatrix::from_diagonal(&scale);
    let eigen = SymmetricEigen::new(&scale * normal * &scale);
    let most = eigen.eigenvalues.max();
    let inverted = eigen.eigenvalues.map(|value| if value > CUT * most { 1.0 / value } else { 0.0 });
    let vectors = &scale * eigen.eigenvectors;
    &vectors * DMatrix::from_diagonal(&inverted) * vectors.transpose()
}

fn inverse_of_four(normal: &Matrix4<f64>) -> Matrix4<f64> {
    let inverse = inverse(DMatrix::from_column_slice(4, 4, normal.as_slice()));
    Matrix4::from_column_slice(inverse.as_slice())
}
