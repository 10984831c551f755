//! Diagnosis: where recordings and simulation disagree, and which physics was left out.

mod acting;
mod again;
mod alias;
mod alone;
mod amplitudes;
mod answer;
mod areas;
mod arrived;
mod backgrounds;
mod beats;
mod bits;
mod block;
mod bounds;
mod camera;
mod charges;
mod chosen_anew;
mod clusters;
mod codes;
mod columns;
mod common_phase;
mod completed;
mod conclusion;
mod contest;
mod coordinates;
mod coupled;
mod covered;
mod data;
mod effect_row;
mod encoder_noise;
mod evidence;
mod exchange;
mod finished;
mod fit;
mod fittest;
mod found;
mod frequencies;
mod gains;
mod gaps;
mod gram;
mod grid;
mod held_frames;
mod held_out;
mod held_out_row;
mod hops;
mod images;
mod improvement;
mod in_common;
mod in_order;
mod in_time;
mod included;
mod inverse;
mod jitters;
mod judge;
mod lamp_overtones;
mod lamps;
mod left_out;
mod line_ways;
mod lines;
mod lines_at_signals;
mod location;
mod marginal;
mod mismatch;
mod misnamed;
mod near_full;
mod needless;
mod neighbours;
mod next;
mod noise;
mod noisy_pixels;
mod one_frame;
mod other_camera;
mod other_choices;
mod overtones;
mod own_phases;
mod panels;
mod parts;
mod pass;
mod patches;
mod patterns;
mod periodogram;
mod periods;
mod pieces;
mod places;
mod power;
mod power_at_random;
mod products;
mod profiles;
mod projected;
mod promised;
mod proposals;
mod random;
mod ranges;
mod read_anew;
mod refined;
mod refused;
mod resting;
mod ripples;
mod roundings;
mod ruled_out;
mod search;
mod searched;
mod seen;
mod set_errors;
mod settle;
mod settling;
mod shared_variance;
mod sides;
mod signals;
mod simpler;
mod soft_wells;
mod source;
mod split;
mod start;
mod steady;
mod steps;
mod stride;
mod swings;
mod tamed;
mod together;
mod tolerated;
mod tones;
mod tried;
mod trust;
mod uneven;
mod untold;
mod velocities;
mod verdict;
mod vote;
mod watchdog;
mod waves;
mod white;
mod whiten;
mod whole_rounding;

pub use alone::Alone;
pub use answer::{
    Answer, EffectRow, EvidenceRow, Invisible, LocatedRow, NextRecording, ParameterRow, Remainder, RuledOut,
    Smallest,
};
pub use camera::camera_with;
pub use conclusion::Verdict;
pub use data::{Assumed, Data, Take};
pub use fit::Fit;
pub use found::{Found, Named};
pub use held_out::HeldOut;
pub use held_out_row::HeldOutRow;
pub use judge::Judgement;
pub use left_out::LeftOut;
pub use location::{Located, Location};
pub use mismatch::Place;
pub use next::ENOUGH_RHO;
pub use noise::Noise;
pub use power::Detectable;
pub use profiles::{Point, Profile};
pub use seen::Agreement;
pub use simpler::Simpler;
pub use verdict::{Diagnosis, diagnose};

/// The noise that the camera's description gives: read noise, quantisation, shot noise, and what it includes of noise and errors at random.
pub fn stated_noise(data: &Data) -> Noise {
    let camera = &data.camera;
    let read_dn = camera.read_noise_e / camera.gain_e_per_dn;
    // Of codes that have low bits cut off, too, the unit is what they are rounded to.
    let unit_dn = data.unit_dn();
    Noise {
        floor: read_dn * read_dn + unit_dn * unit_dn / 12.0,
        slope: camera.gain_e_per_dn.recip(),
        square: data.unpredicted.square,
        jitter: data.unpredicted.jitter,
    }
}
