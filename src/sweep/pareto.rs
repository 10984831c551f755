//! What was measured of a configuration and what it costs; those that no other beats in both.

use super::area::Area;
use super::configuration::Configuration;
use super::figures::{Figures, Row};
use super::plan::Coverage;

/// A configuration with its errors and its area.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The configuration.
    pub configuration: Configuration,
    /// How its vectors were chosen.
    pub coverage: Coverage,
    /// All octaves together, then one by one.
    pub rows: Vec<Row>,
    /// What it costs.
    pub area: Area,
}

impl Point {
    /// All octaves together.
    pub fn overall(&self) -> Option<&Figures> {
        self.rows.first().map(|row| &row.figures)
    }

    /// The largest error in turns.
    pub fn max_turns(&self) -> f64 {
        self.overall().map_or(f64::INFINITY, |figures| figures.max_turns)
    }
}

/// Places in `points` of those for which no other has a smaller area and no larger maximum error, or the same area and a smaller
/// error; by rising area. Of equal ones the first.
pub fn pareto_front(points: &[Point]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let key = |place: usize| (points[place].area.luts, points[place].max_turns());
        let ((area_a, error_a), (area_b, error_b)) = (key(a), key(b));
        area_a.total_cmp(&area_b).then(error_a.total_cmp(&error_b)).then(a.cmp(&b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&place| {
        let error = points[place].max_turns();
        let better = error < least;
        least = least.min(error);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::super::area::AreaSource;
    use super::super::configuration::tests::word;
    use super::super::tally::{OctaveTally, Tally, Worst};
    use super::*;

    fn point(luts: f64, error: i64) -> Point {
        let worst = Some(Worst { error, x: 1, y: 1 });
        let even = vec![OctaveTally { vectors: 1, worst, ..OctaveTally::default() }];
        Point {
            configuration: word(8, 8),
            coverage: Coverage::Exhaustive,
            rows: Figures::rows(&Tally { even, corners: vec![] }),
            area: Area { luts, source: AreaSource::Fitted },
        }
    }

    #[test]
    fn the_front_by_hand() {
        let points: Vec<Point> =
            [(300.0, 5), (100.0, 50), (200.0, 50), (200.0, 20), (400.0, 5), (250.0, 30), (100.0, 50)]
                .map(|(luts, error)| point(luts, error))
                .into();
        assert_eq!(pareto_front(&points), [1, 3, 0]);
        assert!(pareto_front(&[]).is_empty());
    }
}
