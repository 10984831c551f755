//! How far x and y can come in exact arithmetic, iteration by iteration.
//!
//! Iteration i maps x to x + metric · 2^−i |y| and y to |y| − 2^−i x: continuous, and linear between the rays on which some y
//! was 0. Over the square of normalised vectors, 0 ≤ x, y ≤ 2, every |x| and |y| is therefore largest at a corner of the
//! square or where such a ray leaves it.

/// Iterations up to which all rays are walked: 2^iterations of them. After it the simple bound |y| ≤ 2^−i x is tight.
const WALKED: u32 = 9;

/// Bounds in units of 1.0, the least larger coordinate of a normalised vector.
pub(super) struct Reach {
    /// Largest x after iteration i.
    pub x: Vec<f64>,
    /// Largest |y| after iteration i.
    pub y: Vec<f64>,
}

/// Iterations 0 to `iterations` − 1; x stays as it is after iteration `x_iterations`.
pub(super) fn reach(metric: i64, iterations: u32, x_iterations: u32) -> Reach {
    let root = (metric as f64).sqrt();
    let mut reach = Reach { x: vec![0.0; iterations as usize], y: vec![0.0; iterations as usize] };
    // Directions of the rays: the angle of iteration 0, then every one of its descendants.
    let mut rays = vec![root.atan()];
    let mut generation = rays.clone();
    for i in 1..iterations.min(WALKED) {
        let step = (root * f64::from(i).exp2().recip()).atan();
        generation = generation.iter().flat_map(|ray| [ray - step, ray + step]).collect();
        rays.extend(&generation);
    }
    let corners = [(2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
    let exits = rays.iter().filter(|ray| (0.0..=std::f64::consts::FRAC_PI_2).contains(*ray)).map(|ray| {
        let (x, y) = (ray.cos(), ray.sin() / root);
        (2.0 * x / x.max(y), 2.0 * y / x.max(y))
    });
    for (x, y) in corners.into_iter().chain(exits) {
        walk(&mut reach, metric as f64, x_iterations, x, y);
    }
    // No path is longer than the longest vector times all gains.
    for i in 1..iterations as usize {
        reach.x[i] = reach.x[i].max(reach.x[i - 1]);
        if i as u32 >= WALKED {
            reach.y[i] = reach.x[i - 1] * (i as f64).exp2().recip() * (1.0 + 1e-9);
        }
    }
    reach
}

fn walk(reach: &mut Reach, metric: f64, x_iterations: u32, x: f64, y: f64) {
    let (mut x, mut y) = (x, y);
    for i in 0..reach.x.len() {
        let part = (i as f64).exp2().recip();
        let larger = if i as u32 <= x_iterations { x + metric * part * y.abs() } else { x };
        (x, y) = (larger, y.abs() - part * x);
        reach.x[i] = reach.x[i].max(x);
        reach.y[i] = reach.y[i].max(y.abs());
    }
}
