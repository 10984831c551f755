//! One number a pixel, shared until it is changed: most effects leave most of a frame in the making as it is.

use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// One number a pixel, row by row. A copy costs nothing until one of the two is changed.
#[derive(Debug, Clone, Default)]
pub struct PerPixel(Arc<Vec<f64>>);

impl Deref for PerPixel {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.0
    }
}

impl DerefMut for PerPixel {
    fn deref_mut(&mut self) -> &mut [f64] {
        Arc::<Vec<f64>>::make_mut(&mut self.0)
    }
}

impl From<Vec<f64>> for PerPixel {
    fn from(values: Vec<f64>) -> Self {
        Self(Arc::new(values))
    }
}

impl FromIterator<f64> for PerPixel {
    fn from_iter<T: IntoIterator<Item = f64>>(values: T) -> Self {
        values.into_iter().collect::<Vec<f64>>().into()
    }
}

impl<'a> IntoIterator for &'a PerPixel {
    type Item = &'a f64;
    type IntoIter = std::slice::Iter<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'a> IntoIterator for &'a mut PerPixel {
    type Item = &'a mut f64;
    type IntoIter = std::slice::IterMut<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}

impl PartialEq for PerPixel {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

/// Root of the mean square of what pixels have; no number where there is no pixel.
pub fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_stays_as_it_is_when_the_other_is_changed() {
        let mut one: PerPixel = vec![1.0, 2.0].into();
        let other = one.clone();
        assert!(one == other && std::ptr::eq(&one[0], &other[0]));
        one[1] = 3.0;
        assert!(one != other);
        assert_eq!((&one[..], &other[..]), (&[1.0, 3.0][..], &[1.0, 2.0][..]));
        assert!(other == vec![1.0, 2.0].into());
    }
}
