//! Public cores that compute the same angle: what they took, how fast and how exact they were.
//!
//! The figures in `peers.csv` were measured once, with the tool versions, the parts, the options and the wrapper's idea of this
//! module: Yosys 0.70, nextpnr-ecp5 0.11.1, nextpnr-ice40 0.4, three to five seeds. They are not measured again here, and nothing
//! of those cores is in this crate.
//!
//! Errors are those of the phase against `atan2` in double precision, in 2^-16 turn whatever the width of the core's phase is:
//! every vector shorter than 64 codes, then random vectors of every octave of the length, axes, diagonals and powers of two; no
//! coordinate is the most negative one.

use serde::Deserialize;

/// A public core in one configuration, as it was measured.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Peer {
    /// Whose it is.
    pub project: String,
    /// Which of its cores, and how it was set.
    pub configuration: String,
    /// `unrolled`, `iterative`, or `multipliers` (tables and multipliers).
    pub form: String,
    /// Where it is from.
    pub source: String,
    /// Under what licence.
    pub licence: String,
    /// Bits of either coordinate.
    pub input_bits: u32,
    /// Bits of its phase.
    pub phase_bits: u32,
    /// Whether the measured area holds the amplitude (`yes`) or only the phase (`no`).
    pub amplitude: String,
    /// Clocks from a vector to its phase, where they were counted.
    pub latency_clocks: Option<u32>,
    /// Clocks from a vector to the next, where they were counted.
    pub clocks_per_sample: Option<u32>,
    /// LUT4 of an ECP5.
    pub lut4: u64,
    /// CCU2C of an ECP5.
    pub ccu2c: u64,
    /// Flip-flops of an ECP5.
    pub registers: u64,
    /// DP16KD of an ECP5.
    pub block_rams: u64,
    /// MULT18X18D of an ECP5.
    pub multipliers: u64,
    /// Median frequency on an LFE5U-25F-6, MHz.
    pub fmax_mhz: f64,
    /// The least over the seeds, MHz.
    pub fmax_least_mhz: f64,
    /// The largest over the seeds, MHz.
    pub fmax_largest_mhz: f64,
    /// SB_LUT4 of an iCE40.
    pub ice40_luts: u64,
    /// Flip-flops of an iCE40.
    pub ice40_registers: u64,
    /// Median frequency on an HX8K, MHz.
    pub ice40_fmax_mhz: f64,
    /// The largest error of all, where it was measured, 2^-16 turn.
    pub largest: Option<f64>,
    /// The root of the mean square of all errors, 2^-16 turn.
    pub rms: Option<f64>,
    /// The largest error in the four highest octaves of the length, 2^-16 turn.
    pub largest_strong: Option<f64>,
    /// The largest error of vectors shorter than 16 codes, none of them left out, 2^-16 turn.
    pub largest_weak: Option<f64>,
    /// What one has to know to read the figures.
    pub remark: String,
}

impl Peer {
    /// Look-up tables as [`super::Area::luts`] counts them on an ECP5.
    pub fn luts(&self) -> u64 {
        self.lut4 + 2 * self.ccu2c
    }
}

/// All of them, in the order of the table.
pub fn peers() -> Vec<Peer> {
    let mut table = csv::Reader::from_reader(include_str!("peers.csv").as_bytes());
    table.deserialize().collect::<Result<_, _>>().expect("the table is in the program, and a test reads it")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_whole() {
        let peers = peers();
        assert_eq!(peers.len(), include_str!("peers.csv").lines().count() - 1);
        assert!(peers.len() > 20);
        for peer in &peers {
            assert!(["unrolled", "iterative", "multipliers"].contains(&peer.form.as_str()), "{peer:?}");
            assert!(["yes", "no"].contains(&peer.amplitude.as_str()), "{peer:?}");
            assert!(!peer.source.is_empty() && !peer.licence.is_empty() && !peer.configuration.is_empty());
            assert!(
                peer.fmax_least_mhz <= peer.fmax_mhz && peer.fmax_mhz <= peer.fmax_largest_mhz,
                "{peer:?}"
            );
            assert_eq!(peer.form == "multipliers", peer.multipliers > 0, "{peer:?}");
            // A part of the vectors is no further off than all of them.
            for part in [peer.largest_strong, peer.largest_weak, peer.rms] {
                assert!(part <= peer.largest, "{peer:?}");
            }
        }
    }
}
