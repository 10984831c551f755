//! Sums of parts that are made side by side: the same to the last bit on any number of threads.

use crate::diagnose::reading::data::Data;
use rayon::prelude::*;

/// So many parts are made for each thread before they are joined.
const AHEAD: usize = 2;

/// What `of` makes of every so many `items`, joined from the first to the last; nothing where there are none.
///
/// No more parts are in memory than are made at a time.
pub fn joined<T: Sync, R: Send>(
    items: &[T],
    many: usize,
    of: impl Fn(&[T]) -> R + Sync,
    mut join: impl FnMut(R, R) -> R,
) -> Option<R> {
    let mut all = None;
    for some in items.chunks(many * AHEAD * rayon::current_num_threads()) {
        for part in some.par_chunks(many).map(&of).collect::<Vec<R>>() {
            all = Some(match all {
                Some(before) => join(before, part),
                None => part,
            });
        }
    }
    all
}

/// Frames are summed in so many chunks.
const CHUNKS: usize = 16;

/// What `with` makes, one after the other, of every frame (recording, and number of the frame within it) of the sets of which `counts` is true (number of the
/// set, over all recordings), from `none` on.
pub fn summed<R: Clone + Send + Sync>(
    data: &Data,
    counts: &(dyn Fn(usize) -> bool + Sync),
    none: &R,
    with: impl Fn(R, usize, usize) -> R + Sync,
    join: impl FnMut(R, R) -> R,
) -> R {
    let counted = data.sets().into_iter().enumerate().filter(|&(number, _)| counts(number));
    let indices = |(_, (take, set)): (usize, (usize, usize))| {
        let frames = data.takes[take].frames;
        (set * frames..(set + 1) * frames).map(move |index| (take, index))
    };
    let frames: Vec<(usize, usize)> = counted.flat_map(indices).collect();
    let of_chunk = |frames: &[(usize, usize)]| {
        frames.iter().fold(none.clone(), |sum, &(take, index)| with(sum, take, index))
    };
    joined(&frames, frames.len().div_ceil(CHUNKS).max(1), of_chunk, join).unwrap_or_else(|| none.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_the_same_on_any_number_of_threads() {
        let parts: Vec<f64> = (1..1000).map(|n| f64::from(n).recip().powi(3)).collect();
        let in_a_row = parts.iter().fold(0.0, |sum, part| sum + part);
        for threads in [1, 2, 3, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let sum = pool.install(|| joined(&parts, 1, |part| part[0], |a, b| a + b));
            assert_eq!(sum, Some(in_a_row), "{threads}");
        }
        assert_eq!(joined(&[0.0; 0], 1, |part| part[0], |a, b| a + b), None);
    }
}
