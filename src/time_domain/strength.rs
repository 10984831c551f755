//! How strong a flaw is: the norm of what it changes, in the noise, beyond what each pixel's own numbers could be.

use super::exposure::{Movie, movie};
use super::flaws::Flaw;
use super::scene::Pixel;
use super::world::{Known, World};
use nalgebra::{Matrix4, SymmetricEigen, Vector4};

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
        ruler.inverses = (0..world.scene.pixels.len()).map(|pixel| ruler.inverse(pixel)).collect();
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

    fn inverse(&self, pixel: usize) -> Matrix4<f64> {
        let mut normal = Matrix4::zeros();
        for frame in 0..self.clean.len() {
            let slope = self.slope(frame, pixel);
            normal += self.weight(frame, pixel) * slope * slope.transpose();
        }
        let scale = normal.diagonal().map(|value| if value > 0.0 { 1.0 / value.sqrt() } else { 0.0 });
        let scale = Matrix4::from_diagonal(&scale);
        let eigen = SymmetricEigen::new(scale * normal * scale);
        let most = eigen.eigenvalues.max();
        let inverted = eigen.eigenvalues.map(|value| if value > CUT * most { 1.0 / value } else { 0.0 });
        let vectors = eigen.eigenvectors;
        scale * vectors * Matrix4::from_diagonal(&inverted) * vectors.transpose() * scale
    }

    /// What `flaws` change in the codes before rounding, of a camera whose simulation knows `known`, DN.
    fn change(&self, known: Known, flaws: &[&Flaw]) -> Movie {
        let mut with = movie(self.world, Known::BOTH, flaws, None);
        // What the simulation does not know is a flaw, too: the difference from what it would predict.
        let predicted = if known == Known::BOTH { None } else { Some(movie(self.world, known, &[], None)) };
        let predicted = predicted.as_ref().unwrap_or(&self.clean);
        for (with, clean) in with.iter_mut().flatten().zip(predicted.iter().flatten()) {
            *with -= clean;
        }
        with
    }

    /// The strength of `flaws` together: the norm of their change, in standard deviations of the whole campaign, with what
    /// each pixel's own numbers can take up taken away.
    pub fn rho(&self, known: Known, flaws: &[&Flaw]) -> f64 {
        self.norm(&self.change(known, flaws))
    }

    /// The norm of the difference `change` of all frames.
    pub fn norm(&self, change: &Movie) -> f64 {
        let square = |pixel: usize| {
            let (mut all, mut along) = (0.0, Vector4::zeros());
            for (frame, change) in change.iter().enumerate() {
                let weighted = self.weight(frame, pixel) * change[pixel];
                all += weighted * change[pixel];
                along += weighted * self.slope(frame, pixel);
            }
            (all - along.dot(&(self.inverses[pixel] * along))).max(0.0)
        };
        (0..self.inverses.len()).map(square).sum::<f64>().sqrt()
    }

    /// `flaw` with the size at which it has the strength `rho` (within 3 %), and that strength; `None` where its mechanism
    /// cannot be as strong or as weak.
    pub fn sized(&self, flaw: &Flaw, rho: f64) -> Option<(Flaw, f64)> {
        const TRIALS: usize = 14;
        let (mut low, mut high) = (0.0, flaw.mechanism.most);
        let mut size = flaw.mechanism.usual;
        for _ in 0..TRIALS {
            let flaw = flaw.sized(size);
            let found = self.rho(Known::BOTH, &[&flaw]);
            if !found.is_finite() {
                return None;
            }
            if (found / rho - 1.0).abs() < 0.03 {
                return Some((flaw, found));
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
