//! What may be added to the baseline: effects with values, which of them are fitted, and to which recordings they belong.

use crate::physics::{Active, Effect, Parameter};

/// What has parameters instead of others has one form or the other; these may be of both at once. A response may be neither a polynomial nor a power.
pub const OF_BOTH_FORMS: [&str; 1] = ["intensity_nonlinearity"];

/// An effect at certain values, in some of the recordings.
#[derive(Debug, Clone)]
pub struct Piece {
    /// The effect.
    pub effect: &'static Effect,
    /// One value a parameter.
    pub values: Vec<f64>,
    /// Which of them are fitted.
    pub free: Vec<usize>,
    /// The recordings in which it acts, by their numbers.
    pub takes: Vec<usize>,
    /// Whether its tangent is taken from off to `values`, because it starts with a corner.
    pub finite: bool,
    /// How much of each number the camera's simulation includes where the effect acts, and what may be too much; empty of what begins with a corner.
    pub included: Vec<f64>,
}

impl Piece {
    /// The effect called `name` of the registry, off, of which the numbers `free` are fitted in the recordings `takes`.
    #[cfg(test)]
    pub fn off(name: &str, free: &[usize], takes: &[usize]) -> Self {
        let effect = crate::physics::effects::named(name).expect("an effect of the registry");
        let (free, takes) = (free.to_vec(), takes.to_vec());
        Self { effect, values: effect.off(), free, takes, finite: false, included: Vec::new() }
    }

    /// Whether one of its fitted strengths is one to which shapes belong.
    pub fn has_shapes(&self) -> bool {
        self.free.iter().any(|&number| self.effect.parameters[number].has_shapes())
    }

    /// How many of its shapes are fitted.
    pub fn shapes(&self) -> usize {
        self.free.iter().filter(|&&number| self.effect.parameters[number].is_shape()).count()
    }

    /// Whether its effect may be there in both of two forms at once.
    pub fn may_be_of_both_forms(&self) -> bool {
        OF_BOTH_FORMS.contains(&self.effect.name)
    }

    /// Whether it has numbers of both of two forms.
    fn is_of_both_forms(&self) -> bool {
        let is_instead = |&number: &usize| self.effect.parameters[number].is_instead;
        self.may_be_of_both_forms() && self.free.iter().any(is_instead) && !self.free.iter().all(is_instead)
    }

    /// Least and greatest value of its parameter `number` where signals go up to `full_scale_dn`: together with what the camera includes it is within the
    /// parameter's bounds.
    pub fn bounds_within(&self, number: usize, full_scale_dn: f64) -> (f64, f64) {
        let (low, high) = self.effect.parameters[number].bounds_within(full_scale_dn);
        let included = self.included_of(number);
        (low - included, high - included)
    }

    /// Its parameter `number`, with what the camera includes of it.
    pub fn in_all(&self, number: usize) -> f64 {
        self.values[number] + self.included_of(number)
    }

    /// Whether it takes away of what the camera includes, and adds nothing.
    pub fn takes_away(&self) -> bool {
        let signs = || self.free.iter().map(|&number| self.values[number] * self.included_of(number));
        signs().all(|sign| sign <= 0.0) && signs().any(|sign| sign < 0.0)
    }

    fn included_of(&self, number: usize) -> f64 {
        self.included.get(number).copied().unwrap_or(0.0)
    }

    /// The same with this share of every strength.
    #[must_use]
    pub fn with_share(&self, share: f64) -> Self {
        Self { values: self.effect.with_share(&self.values, share), ..self.clone() }
    }

    /// Whether `other` is the same, whatever is fitted of it.
    pub fn acts_as(&self, other: &Self) -> bool {
        std::ptr::eq(self.effect, other.effect)
            && self.values == other.values
            && self.takes == other.takes
            && self.finite == other.finite
    }
}

/// One way in which an effect may be there: its pieces together.
#[derive(Debug, Clone)]
pub struct Variant {
    /// The pieces, all of the same effect.
    pub pieces: Vec<Piece>,
    /// So many times less likely than other ways, before anything is seen.
    pub rarity: f64,
}

impl Variant {
    /// Whether the effect is there in both of two forms.
    pub fn is_of_both_forms(&self) -> bool {
        self.pieces.iter().any(Piece::is_of_both_forms)
    }

    /// Where recordings have pieces of their own, these begin at their `own` shapes.
    pub fn begin_at(&mut self, own: &[f64]) {
        for piece in self.pieces.iter_mut().filter(|piece| piece.takes.len() == 1) {
            let shape = piece.effect.parameters.iter().position(Parameter::is_shape);
            if let (Some(shape), Some(&value)) = (shape, own.get(piece.takes[0])) {
                piece.values[shape] = value;
            }
        }
    }
}

/// The effects of `pieces` that act in recording `take`.
pub fn active(pieces: &[Piece], take: usize) -> Vec<Active> {
    let here = pieces.iter().filter(|piece| piece.takes.contains(&take));
    here.map(|piece| Active { effect: piece.effect, values: piece.values.clone() }).collect()
}
