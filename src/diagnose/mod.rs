//! Diagnosis: where recordings and simulation disagree, and which physics was left out.
//!
//! Its rooms, each of which sees mostly those below it:
//!
//! | room | what is in it |
//! | --- | --- |
//! | `answering` | The answer: its rows, what these recordings cannot show, and which would. |
//! | `judging` | From what a search found to what is asserted. |
//! | `unseen` | What sets show to a fit that has not seen them. |
//! | `naming` | The search for the effects that explain a mismatch. |
//! | `forms` | Forms in which an effect that is named may be there, other than its usual one. |
//! | `set_aside` | What is left out before anything is looked for: pixels and sets that are unlike the others, and recordings without light. |
//! | `locating` | Where recordings and a model differ: the coordinates of a residual. |
//! | `shared_errors` | Errors that samples of a set, a frame, a row or a column share at random. |
//! | `periodic` | What is periodic in time or in the encoder's reading, and which source it has. |
//! | `fitting` | The fit of the full forward model, with the noise of its samples. |
//! | `tangents` | What each number that is fitted changes in every sample, by the forward model itself. |
//! | `reading` | The recordings as a fit sees them: which samples, pixels and sets count, and what the encoder says. |
//! | `statistics` | How likely a number, a line or a variance is, whatever it is of. |

mod answering;
mod fitting;
mod forms;
mod judging;
mod locating;
mod naming;
mod periodic;
mod reading;
mod set_aside;
mod shared_errors;
mod statistics;
mod tangents;
mod unseen;

pub use answering::answer::{
    Answer, EffectRow, EvidenceRow, Invisible, LocatedRow, NextRecording, ParameterRow, Remainder, RuledOut,
    Smallest,
};
pub use answering::camera::camera_with;
pub use answering::common_part::CommonPart;
pub use answering::next::ENOUGH_RHO;
pub use answering::verdict::{Diagnosis, diagnose};
pub use fitting::fit::Fit;
pub use fitting::noise::Noise;
pub use judging::conclusion::Verdict;
pub use judging::judge::Judgement;
pub use locating::location::{Located, Location};
pub use locating::mismatch::Place;
pub use locating::profiles::{Point, Profile};
pub use naming::alone::Alone;
pub use naming::found::{Found, Named};
pub use naming::power::Detectable;
pub use reading::data::{Assumed, Data, Take};
pub use set_aside::left_out::LeftOut;
pub use statistics::simpler::Simpler;
pub use unseen::held_out::HeldOut;
pub use unseen::held_out_row::HeldOutRow;
pub use unseen::seen::Agreement;

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
