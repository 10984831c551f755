//! Optical flow: raw frames are taken back to the set's middle along the motion that intensity images show.
//!
//! Brightness must be the same in all frames, whatever their phase step: that is so of the sum of both taps of a pixel (Lindner and Kolb
//! 2009). Motion is taken for constant within a set, and estimated in the middle's own pixels, by all pairs of frames that lie
//! symmetrically about it: Σ (S_n'(x + k v) − S_n(x − k v))² over a window and over the pairs is made least (Lucas and Kanade 1981), from
//! coarse to fine (Bouguet 2001). Lindner and Kolb took a variational flow (Zach, Pock, Bischof 2007) between one frame and the next.

use super::image::Image;
use crate::frames::Geometry;

/// Pixels to every side of a window.
const REACH: i64 = 4;
/// Images of halved size, the whole one among them.
const LEVELS: usize = 3;
/// Steps of Gauss and Newton a level.
const STEPS: usize = 5;
/// A step of fewer pixels a frame is the last.
const ENOUGH: f64 = 0.01;
/// Added to the squared slopes, summed over window and pairs, DN²: what noise of 7 DN makes of them. Without slopes nothing moves.
const NOISE_DN2: f64 = 8000.0;

/// Columns and rows a frame by which the image moves at each pixel, of the sums of taps `sums_dn`, one image a frame.
pub fn motion(sums_dn: &[Image]) -> [Image; 2] {
    let mut levels = vec![sums_dn.to_vec()];
    while levels.len() < LEVELS {
        let halved = levels[levels.len() - 1].iter().map(Image::halved).collect();
        levels.push(halved);
    }
    let still = |geometry| Image::of(geometry, |_, _| 0.0);
    let coarsest = levels[LEVELS - 1][0].geometry;
    let mut motion = [still(coarsest), still(coarsest)];
    for images in levels.iter().rev() {
        motion = refined(images, motion.map(|part| finer(&part, images[0].geometry)));
    }
    motion
}

/// A part of the motion in an image of twice the size; as it is, where the size is the same.
fn finer(part: &Image, geometry: Geometry) -> Image {
    // A pixel's centre lies at (column − 1/2) / 2 of the image of half the size.
    let half = |index: usize| (index as f64 - 0.5) / 2.0;
    match part.geometry == geometry {
        true => part.clone(),
        false => Image::of(geometry, |column, row| 2.0 * part.sample(half(column), half(row))),
    }
}

/// `motion` after steps of Gauss and Newton, each pixel by its own window, all of which moves as that pixel.
fn refined(images: &[Image], motion: [Image; 2]) -> [Image; 2] {
    let geometry = images[0].geometry;
    let slopes: Vec<[Image; 2]> = images.iter().map(Image::slopes).collect();
    let pairs: Vec<Pair> = (0..images.len() / 2)
        .map(|first| {
            let last = images.len() - 1 - first;
            let of = |frame: usize| [&images[frame], &slopes[frame][0], &slopes[frame][1]];
            Pair { first: of(first), last: of(last), half: (last - first) as f64 / 2.0 }
        })
        .collect();
    let refined = |pixel: usize| {
        let (row, column) = geometry.row_column(pixel);
        let mut a_frame = [motion[0].values[pixel], motion[1].values[pixel]];
        for _ in 0..STEPS {
            let step = step(&pairs, [column as f64, row as f64], a_frame);
            a_frame = [a_frame[0] + step[0], a_frame[1] + step[1]];
            if step[0].hypot(step[1]) < ENOUGH {
                break;
            }
        }
        a_frame
    };
    let found: Vec<[f64; 2]> = (0..geometry.pixels()).map(refined).collect();
    [0, 1].map(|part: usize| Image { geometry, values: found.iter().map(|a_frame| a_frame[part]).collect() })
}

/// Two frames that lie symmetrically about the middle: each image with its slopes along columns and rows.
struct Pair<'a> {
    first: [&'a Image; 3],
    last: [&'a Image; 3],
    /// Frames from the middle to either.
    half: f64,
}

/// A step of Gauss and Newton for the window around `place`, all of which moves by `a_frame`.
fn step(pairs: &[Pair], place: [f64; 2], a_frame: [f64; 2]) -> [f64; 2] {
    // Squares and products of slopes along columns (x) and rows (y), and of those with the difference.
    let (mut xx, mut xy, mut yy, mut x_apart, mut y_apart) = (NOISE_DN2, 0.0, NOISE_DN2, 0.0, 0.0);
    for pair in pairs {
        let way = a_frame.map(|part| pair.half * part);
        for (across, down) in
            (-REACH..=REACH).flat_map(|down| (-REACH..=REACH).map(move |across| (across, down)))
        {
            let (column, row) = (place[0] + across as f64, place[1] + down as f64);
            let before = pair.first.map(|image| image.sample(column - way[0], row - way[1]));
            let after = pair.last.map(|image| image.sample(column + way[0], row + way[1]));
            let apart = after[0] - before[0];
            let [x, y] = [1, 2].map(|slope: usize| pair.half * (before[slope] + after[slope]));
            xx += x * x;
            xy += x * y;
            yy += y * y;
            x_apart += x * apart;
            y_apart += y * apart;
        }
    }
    let determinant = xx * yy - xy * xy;
    [-(yy * x_apart - xy * y_apart) / determinant, -(xx * y_apart - xy * x_apart) / determinant]
}

/// `frames_dn`, each taken back along `motion` to the middle of the set.
pub fn compensated(frames_dn: &[Image], motion: &[Image; 2]) -> Vec<Image> {
    let middle = (frames_dn.len() as f64 - 1.0) / 2.0;
    let back = |(number, frame): (usize, &Image)| {
        let after = number as f64 - middle;
        Image::of(frame.geometry, |column, row| {
            let pixel = row * frame.geometry.width + column;
            let [across, down] = [0, 1].map(|part: usize| after * motion[part].values[pixel]);
            frame.sample(column as f64 + across, row as f64 + down)
        })
    };
    frames_dn.iter().enumerate().map(back).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GEOMETRY: Geometry = Geometry { width: 64, height: 48 };

    /// A smooth texture that moves by `a_frame` columns and rows a frame.
    fn frames(count: usize, a_frame: [f64; 2]) -> Vec<Image> {
        let texture =
            |x: f64, y: f64| 500.0 + 200.0 * (0.35 * x + 0.1 * y).sin() + 150.0 * (0.4 * y - 0.15 * x).cos();
        let frame = |number: usize| {
            let after = number as f64 - (count as f64 - 1.0) / 2.0;
            Image::of(GEOMETRY, |column, row| {
                texture(column as f64 - after * a_frame[0], row as f64 - after * a_frame[1])
            })
        };
        (0..count).map(frame).collect()
    }

    #[test]
    fn an_image_that_moves_is_followed_and_taken_back() {
        for (count, a_frame) in [(4, [2.3, 0.0]), (5, [-1.7, 0.6]), (4, [0.0, 0.0])] {
            let frames = frames(count, a_frame);
            let found = motion(&frames);
            let back = compensated(&frames, &found);
            let inner = |pixel: &usize| {
                let (row, column) = GEOMETRY.row_column(*pixel);
                // The coarsest windows reach four pixels of four, and no frame shows what comes in over the rim.
                (20..44).contains(&column) && (20..28).contains(&row)
            };
            let middle = super::tests::frames(1, a_frame);
            for pixel in (0..GEOMETRY.pixels()).filter(inner) {
                for part in 0..2 {
                    let off = found[part].values[pixel] - a_frame[part];
                    assert!(off.abs() < 0.03, "{count} {a_frame:?}: {off} at {pixel}");
                }
                // Bilinear interpolation of the finest wave, 0.42 rad a pixel: 0.42²/8 of 200 at most, and 0.03 · 1.5 pixels of slope.
                for frame in &back {
                    let off = frame.values[pixel] - middle[0].values[pixel];
                    assert!(off.abs() < 12.0, "{count} {a_frame:?}: {off} at {pixel}");
                }
            }
        }
    }

    /// Frames of another motion are not taken for these.
    #[test]
    fn another_motion_is_seen() {
        let found = motion(&frames(4, [1.9, 0.0]));
        assert!((found[0].at(32, 24) - 2.3).abs() > 0.3);
        let wrong = compensated(&frames(4, [2.3, 0.0]), &motion(&frames(4, [-2.3, 0.0])));
        assert!((wrong[0].at(32, 24) - frames(1, [0.0; 2])[0].at(32, 24)).abs() > 12.0);
    }
}
