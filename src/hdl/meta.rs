//! What travels through the pipeline beside the data.

use super::Source;

/// Widths of what travels beside the data.
pub(super) struct Meta {
    /// First, last, saturated and the offset sum, up to the normaliser.
    pub vector_bits: u32,
    /// With zero, octant and shift, through the CORDIC.
    pub cordic_bits: u32,
    /// The shift count.
    pub shift_bits: u32,
}

impl Meta {
    pub(super) fn new(source: &Source) -> Self {
        let derived = source.pipeline.derived();
        let vector_bits = 3 + derived.offset_sum.bits;
        let shift_bits = derived.normaliser.shifts.len() as u32;
        Self { vector_bits, cordic_bits: vector_bits + 4 + shift_bits, shift_bits }
    }
}
