//! Forms in which an effect that is named may be there, other than its usual one.

pub mod bits;
pub mod in_common;
pub mod lamp_overtones;
pub mod one_frame;
pub mod other_camera;
pub mod other_choices;
pub mod overtones;
pub mod refined;
pub mod roundings;
pub mod soft_wells;
pub mod uneven;
pub mod uneven_walls;
pub mod whole_rounding;
