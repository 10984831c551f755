//! Errors that samples share, in words.

use super::clusters::Cluster;
use super::levels::{Level, MODES};

/// The coordinate of a verdict in which errors that samples share are located.
pub fn coordinate(cluster: &Cluster) -> &'static str {
    match cluster.level {
        Level::Set if MODES[cluster.mode] == "velocity" => "velocity_m_s",
        Level::Set if matches!(MODES[cluster.mode], "phase" | "position") => "encoder",
        Level::Set => "set",
        Level::Frame => "frame",
        Level::Row | Level::RowOfSet => "row",
        Level::Column | Level::ColumnOfSet => "column",
        Level::Neighbours => "neighbours",
        Level::Pixel => "amplitude",
    }
}

/// `size` with three significant digits, without an exponent where it needs none.
fn plain(size: f64) -> String {
    if !(1e-4..1e4).contains(&size) {
        return format!("{size:.2e}");
    }
    let digits = (2.0 - size.log10().floor()).max(0.0) as usize;
    format!("{size:.digits$}")
}

/// What the errors are, in words.
pub fn words(cluster: &Cluster) -> String {
    let common = cluster.level.name();
    let unit = match (MODES[cluster.mode], cluster.level) {
        ("offset", _) => " DN",
        ("gain" | "light", _) => "",
        ("phase", _) => " rad",
        ("position", Level::Set) => " m",
        ("position", _) => " s of movement",
        _ => " m/s",
    };
    format!("random {} of {}{unit}, common to a {common}", MODES[cluster.mode], plain(cluster.sigma))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_plain_numbers() {
        let words = [3.7301, 0.037_301, 812.3, 3.73e-4, 3.73e-7].map(plain);
        assert_eq!(words, ["3.73", "0.0373", "812", "0.000373", "3.73e-7"]);
    }
}
