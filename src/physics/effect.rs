//! What an effect is: parameters, the place in the chain where it acts, the forward model there.

use super::effects;
use super::exposure::Exposure;
use super::formula::Formula;

/// A parameter of an effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name, with its unit at the end where it has one.
    pub name: &'static str,
    /// Its unit; "1" for a ratio.
    pub unit: &'static str,
    /// Where the effect, or this part of it, is absent.
    pub off: f64,
    /// Least and greatest value for which the forward model stands.
    pub bounds: (f64, f64),
    /// The usual size: one standard deviation of what cameras show.
    pub typical: f64,
    /// Shapes (a frequency, a time constant) change nothing while the effect is off: values from which a search starts.
    pub shapes: &'static [f64],
    /// A shape that takes no values between those.
    pub is_choice: bool,
    /// A strength that says in another way what the others say: off as a rule, and fitted in their place.
    pub is_instead: bool,
    /// A strength that only matters where each recording has its own: off as a rule.
    pub is_of_recording: bool,
    /// A strength of a form that is looked for by itself, as a line is: in the usual ones it is off.
    pub is_looked_for: bool,
    /// The only frame of each set on which it acts, if it is one: recordings of fewer frames have none of it.
    pub frame: Option<usize>,
    /// How far from 0 it may be at most, in full scales; infinite where that does not matter.
    pub most_full_scales: f64,
}

impl Parameter {
    /// A strength: the effect is absent where it is `off`.
    pub const fn strength(
        name: &'static str,
        unit: &'static str,
        off: f64,
        bounds: (f64, f64),
        typical: f64,
    ) -> Self {
        Self {
            name,
            unit,
            off,
            bounds,
            typical,
            shapes: &[],
            is_choice: false,
            is_instead: false,
            is_of_recording: false,
            is_looked_for: false,
            frame: None,
            most_full_scales: f64::INFINITY,
        }
    }

    /// The same in place of the other strengths.
    #[must_use]
    pub const fn instead(self) -> Self {
        Self { is_instead: true, ..self }
    }

    /// The same of one recording: those of all together cannot be seen.
    #[must_use]
    pub const fn of_recording(self) -> Self {
        Self { is_of_recording: true, ..self }
    }

    /// The same of a form that is looked for by itself.
    #[must_use]
    pub const fn looked_for(self) -> Self {
        Self { is_looked_for: true, ..self }
    }

    /// The same of one frame of each set.
    #[must_use]
    pub const fn of_frame(self, frame: usize) -> Self {
        Self { frame: Some(frame), ..self }
    }

    /// The same of a code, with at most so many full scales.
    #[must_use]
    pub const fn within_full_scales(self, most_full_scales: f64) -> Self {
        Self { most_full_scales, ..self }
    }

    /// A shape: it matters only where a strength is not off.
    pub const fn shape(
        name: &'static str,
        unit: &'static str,
        usual: f64,
        bounds: (f64, f64),
        shapes: &'static [f64],
    ) -> Self {
        Self { shapes, ..Self::strength(name, unit, usual, bounds, usual) }
    }

    /// A shape that is one of `shapes`, the first of them as a rule; one above 1 is how many of the strengths there are.
    pub const fn choice(name: &'static str, unit: &'static str, shapes: &'static [f64]) -> Self {
        let (first, last) = (shapes[0], shapes[shapes.len() - 1]);
        let (mut low, mut high, mut number) = (first, first, 1);
        while number < shapes.len() {
            (low, high) = (low.min(shapes[number]), high.max(shapes[number]));
            number += 1;
        }
        Self { is_choice: true, typical: last, ..Self::shape(name, unit, first, (low, high), shapes) }
    }

    /// Least and greatest value where signals go up to `full_scale_dn`.
    pub fn bounds_within(&self, full_scale_dn: f64) -> (f64, f64) {
        let (low, high) = self.bounds;
        let most = self.most_full_scales * full_scale_dn;
        (low.clamp(-most, most), high.clamp(-most, most))
    }

    /// How far from off it may be where signals go up to `full_scale_dn`.
    pub fn reach(&self, full_scale_dn: f64) -> f64 {
        let (low, high) = self.bounds_within(full_scale_dn);
        (high - self.off).max(self.off - low)
    }

    /// Whether it takes no values but its own: bounds of other choices go beyond these.
    pub fn is_of_its_shapes(&self) -> bool {
        self.is_choice && self.shapes.iter().any(|shape| *shape >= self.bounds.1)
    }

    /// Whether it is a strength to which the effect's shapes belong: those that are looked for by themselves have none.
    pub const fn has_shapes(&self) -> bool {
        !self.is_shape() && !self.is_looked_for
    }

    /// Whether it is a strength of the usual form, or, `instead`, of the other one.
    pub const fn is_usual_strength(&self, instead: bool) -> bool {
        !self.is_shape() && !self.is_looked_for && self.is_instead == instead
    }

    /// Whether it is a shape.
    pub const fn is_shape(&self) -> bool {
        !self.shapes.is_empty()
    }
}

/// Where in the chain from the encoder to the code an effect acts, in the order of the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// What the encoder's reading says of the target's position.
    Encoder,
    /// When a frame is taken, at which modulation frequency and phase step.
    Clock,
    /// How far the target is, and with it the phase.
    Path,
    /// How much light comes back, and how much is there anyway.
    Light,
    /// The waveform of the correlation of light and sensor.
    Waveform,
    /// What has been correlated, and what is added to it.
    Correlation,
    /// Charge that goes from pixel to pixel or from frame to frame.
    Charge,
    /// What the pixel and the converter make of the charge.
    Readout,
}

impl Place {
    /// All, in the order of the chain.
    pub const ALL: [Self; 8] = [
        Self::Encoder,
        Self::Clock,
        Self::Path,
        Self::Light,
        Self::Waveform,
        Self::Correlation,
        Self::Charge,
        Self::Readout,
    ];
}

/// How an effect draws from chance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Chance {
    /// Not at all: the same parameters give the same frames.
    None,
    /// One draw a frame, common to all pixels: its parameter is a standard deviation.
    Frame,
    /// One draw a pixel and frame: its parameter is a standard deviation.
    Pixel,
}

/// How exactly the form of an effect is known: what cameras really do may differ from it by so much.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fidelity {
    /// Geometry, which has no other form, but for places and angles that are off by a hundredth: that, squared.
    Law,
    /// A number that is what it is: an angle, a gain, a length.
    Exact,
    /// A curve or a course in time, of which the first terms are modelled.
    Approximate,
    /// What depends on a pixel's neighbourhood, or on its electronics, in more ways than are modelled.
    Loose,
}

/// What values of an effect's parameters do to a frame that has come to [`Effect::place`].
#[derive(Debug)]
pub enum Act {
    /// What the effect's file says.
    Code(fn(&[f64], &mut Exposure)),
    /// What a user's formula says.
    Formula(Box<Formula>),
}

/// A physical effect. One file each in `effects/`, one line in [`super::EFFECTS`].
#[derive(Debug)]
pub struct Effect {
    /// The name that verdicts and files use.
    pub name: &'static str,
    /// One plain sentence.
    pub sentence: &'static str,
    /// Where its equation comes from.
    pub reference: &'static str,
    /// Its parameters, strengths first.
    pub parameters: &'static [Parameter],
    /// Where it acts.
    pub place: Place,
    /// How it draws from chance.
    pub chance: Chance,
    /// Whether it needs [`Exposure::before`], the light of the frame before.
    pub looks_back: bool,
    /// How exactly its form is known.
    pub fidelity: Fidelity,
    /// The forward model.
    pub act: Act,
}

impl Effect {
    /// Does to `exposure` what these values of the parameters do.
    pub fn act_on(&self, values: &[f64], exposure: &mut Exposure) {
        match &self.act {
            Act::Code(act) => act(values, exposure),
            Act::Formula(formula) => formula.act(values, exposure),
        }
    }

    /// Whether a frame without noise shows what it does: it is neither random nor the camera's own arithmetic, which cuts codes.
    pub fn is_predicted(&self) -> bool {
        self.chance == Chance::None && self.name != effects::FIXED_POINT
    }

    /// Whether its strengths, and which of a few kinds it is, say all of it.
    fn is_told_by_strengths(&self) -> bool {
        self.parameters.iter().all(|parameter| parameter.is_choice || !parameter.is_shape())
    }

    /// The values at which it does nothing.
    pub fn off(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.off).collect()
    }

    /// The values of its usual size, within its bounds.
    pub fn typical(&self) -> Vec<f64> {
        let value = |p: &Parameter| {
            if p.is_usual_strength(false) { (p.off + p.typical).clamp(p.bounds.0, p.bounds.1) } else { p.off }
        };
        self.parameters.iter().map(value).collect()
    }

    /// Values of its usual size that show it: typical ones of both signs. Like values of like parameters, such as the gains of all
    /// frames, would cancel.
    pub fn example(&self) -> Vec<f64> {
        const SIGNS: [f64; 4] = [1.0, -1.0, -1.0, 1.0];
        let value = |(number, p): (usize, &Parameter)| {
            let signed = p.off + SIGNS[number % SIGNS.len()] * p.typical;
            if p.is_usual_strength(false) { signed.clamp(p.bounds.0, p.bounds.1) } else { p.off }
        };
        self.parameters.iter().enumerate().map(value).collect()
    }
}

/// An effect with values for its parameters.
#[derive(Debug, Clone)]
pub struct Active {
    /// The effect.
    pub effect: &'static Effect,
    /// One value a parameter.
    pub values: Vec<f64>,
}

impl Effect {
    /// The `values` of its parameters with this share of every strength.
    #[must_use]
    pub fn with_share(&self, values: &[f64], share: f64) -> Vec<f64> {
        let value = |(parameter, &value): (&Parameter, &f64)| match parameter.is_shape() {
            true => value,
            false => parameter.off + share * (value - parameter.off),
        };
        self.parameters.iter().zip(values).map(value).collect()
    }
}

impl Active {
    /// How much of the parameter `number` of `effect` all of the `active` ones are together; 0 where strengths alone do not tell that: of a path with a length of its
    /// own, of a shape, of what is random.
    pub fn in_all<'a>(active: impl IntoIterator<Item = &'a Self>, effect: &Effect, number: usize) -> f64 {
        let parameter = &effect.parameters[number];
        let is_summed = effect.is_told_by_strengths() && effect.is_predicted() && !parameter.is_shape();
        let of_effect = active.into_iter().filter(|active| is_summed && std::ptr::eq(active.effect, effect));
        of_effect.map(|active| active.values[number] - parameter.off).sum()
    }

    /// Whether every strength is off, so that it does nothing.
    pub fn is_off(&self) -> bool {
        let mut values = self.effect.parameters.iter().zip(&self.values);
        values.all(|(parameter, value)| parameter.is_shape() || *value == parameter.off)
    }
}
