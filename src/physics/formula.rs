//! An effect as a formula over the coordinates of a sample.

use super::effect::Place;
use super::exposure::Exposure;
use crate::problem::{Problem, Result};
use exmex::{Express, FlatEx};

/// What a formula changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Adds so many DN to the signal.
    Signal,
    /// Adds so many rad to the phase.
    Phase,
    /// Raises the amplitude of the camera's own light by this share.
    Amplitude,
    /// Raises the ambient light by this share.
    Ambient,
}

impl Target {
    /// All, by the names that files use.
    pub const ALL: [(&'static str, Self); 4] = [
        ("signal", Self::Signal),
        ("phase", Self::Phase),
        ("amplitude", Self::Amplitude),
        ("ambient", Self::Ambient),
    ];

    /// Where in the chain it is changed.
    pub fn place(self) -> Place {
        match self {
            Self::Signal => Place::Charge,
            Self::Phase => Place::Path,
            Self::Amplitude | Self::Ambient => Place::Light,
        }
    }
}

/// The value of a coordinate for a pixel of a frame.
type Coordinate = fn(&Exposure, usize) -> f64;

/// So many coordinates has a formula.
pub const COORDINATES: usize = 13;

/// The coordinates, as formulas call them.
const ALL: [(&str, Coordinate); COORDINATES] = [
    ("phase", |e, pixel| e.phase_rad.get(pixel).copied().unwrap_or(0.0)),
    ("angle", |e, _| e.angle_rad),
    ("position_m", |e, _| e.position_m + e.motion_share * e.way_m()),
    ("encoder_m", |e, _| e.moment.position_m),
    ("velocity_m_s", |e, _| e.velocity_m_s),
    ("frame", |e, _| e.moment.frame as f64),
    ("frames", |e, _| e.moment.frames as f64),
    ("set", |e, _| e.moment.set as f64),
    ("time_s", |e, _| e.moment.time_s),
    ("row", |e, pixel| (pixel / e.pixels.geometry.width) as f64),
    ("column", |e, pixel| (pixel % e.pixels.geometry.width) as f64),
    ("signal", |e, pixel| e.signal_dn.get(pixel).copied().unwrap_or(0.0)),
    ("amplitude", |e, pixel| e.amplitude_dn.get(pixel).copied().unwrap_or(0.0)),
];

/// Where a variable's value comes from.
#[derive(Debug, Clone, Copy)]
enum Variable {
    Parameter(usize),
    Coordinate(usize),
}

/// An operand of `text` of which a power is taken, with a minus before it that belongs to no difference: most languages take the power first, the parser takes it last.
fn negated_power(text: &str) -> Option<&str> {
    let is_sign = |at: usize| {
        let before = text[..at].trim_end().chars().next_back();
        before.is_none_or(|before| "(,+-*/%^".contains(before))
    };
    let mut signs = text.match_indices('-').map(|(at, _)| at).filter(|&at| is_sign(at));
    signs.find_map(|at| {
        let (operand, rest) = operand_of(text[at + 1..].trim_start());
        rest.trim_start().starts_with('^').then_some(operand)
    })
}

/// The number, name, call or bracket with which `text` begins, and what comes after it.
fn operand_of(text: &str) -> (&str, &str) {
    let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
    let word = text.find(|c| !is_word(c)).unwrap_or(text.len());
    if !text[word..].starts_with('(') {
        return text.split_at(word);
    }
    let mut depth = 0;
    let close = text[word..].find(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth == 0
    });
    text.split_at(close.map_or(text.len(), |close| word + close + 1))
}

/// A formula, and what it changes.
#[derive(Debug, Clone)]
pub struct Formula {
    target: Target,
    expression: FlatEx<f64>,
    variables: Vec<Variable>,
}

impl Formula {
    /// Reads `text`, whose variables are `parameters` and coordinates.
    ///
    /// # Errors
    /// A text that is no formula, or a variable that is neither.
    pub fn new(target: Target, text: &str, parameters: &[&str]) -> Result<Self> {
        if let Some((name, _)) = ALL.iter().find(|(name, _)| parameters.contains(name)) {
            return Err(Problem::at(
                "formula",
                format_args!("{text}: {name} is a parameter, and a coordinate"),
            )
            .expected("parameters that are not called as a coordinate")
            .remedy("give the parameter another name"));
        }
        if let Some(operand) = negated_power(text) {
            return Err(Problem::at(
                "formula",
                format_args!(
                    "{text}: -{operand}^ may be the negative of a power, or the power of a negative"
                ),
            )
            .expected(format_args!("(0 - {operand}^...) or (-{operand})^..."))
            .remedy("write which of them it is"));
        }
        let expression: FlatEx<f64> = exmex::parse(text).map_err(|error| {
            Problem::at("formula", format_args!("{text}: {error}"))
                .expected("a formula such as a * sin(6.28 * row / 5)")
        })?;
        let variables = expression.var_names().iter().map(|name| {
            if let Some(number) = parameters.iter().position(|parameter| parameter == name) {
                return Ok(Variable::Parameter(number));
            }
            let number = ALL.iter().position(|(known, _)| known == name);
            number.map(Variable::Coordinate).ok_or_else(|| {
                let names: Vec<&str> = ALL.iter().map(|(name, _)| *name).collect();
                Problem::at("formula", format_args!("{text}: {name} is neither a parameter nor a coordinate"))
                    .expected(format_args!("parameters ({}) and {}", parameters.join(", "), names.join(", ")))
            })
        });
        let variables: Vec<Variable> = variables.collect::<Result<_>>()?;
        let unused = |name: &&&str| expression.var_names().iter().all(|used| used != **name);
        if let Some(name) = parameters.iter().find(unused) {
            return Err(Problem::at("formula", format_args!("{text} does not use the parameter {name}"))
                .expected("a formula that each of its parameters changes"));
        }
        Ok(Self { target, expression, variables })
    }

    /// The value with these values of the parameters, where coordinate number n, in the order of formulas' coordinates, is `coordinate(n)`; nothing where it is not
    /// finite. `arguments` is for its own use.
    pub fn value(
        &self,
        values: &[f64],
        coordinate: impl Fn(usize) -> f64,
        arguments: &mut Vec<f64>,
    ) -> Option<f64> {
        let of = |variable: &Variable| match *variable {
            Variable::Parameter(number) => values[number],
            Variable::Coordinate(number) => coordinate(number),
        };
        arguments.clear();
        arguments.extend(self.variables.iter().map(of));
        self.expression.eval(arguments).ok().filter(|value| value.is_finite())
    }

    /// Does to `exposure` what the formula says with these values of the parameters. Where it has no finite value, it does nothing.
    pub fn act(&self, values: &[f64], exposure: &mut Exposure) {
        let mut arguments = Vec::new();
        let mut change = |pixel: usize| {
            let coordinate = |number: usize| (ALL[number].1)(exposure, pixel);
            self.value(values, coordinate, &mut arguments).unwrap_or(0.0)
        };
        let changes: Vec<f64> = (0..exposure.pixels.count()).map(&mut change).collect();
        let (values, is_share): (&mut [&mut [f64]], bool) = match self.target {
            Target::Signal => (&mut [&mut exposure.signal_dn], false),
            Target::Phase => (&mut [&mut exposure.phase_rad], false),
            Target::Amplitude => (&mut [&mut exposure.amplitude_dn, &mut exposure.constant_dn], true),
            Target::Ambient => (&mut [&mut exposure.ambient_dn], true),
        };
        for values in values {
            for (value, change) in values.iter_mut().zip(&changes) {
                *value += if is_share { *value * change } else { *change };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a minus before a power means is asked; where it is said, the formula is what it says.
    #[test]
    fn a_minus_before_a_power_is_refused_and_no_other() {
        for (text, operand) in [
            ("a * exp(-((time_s - 9) / 3)^2)", "((time_s - 9) / 3)"),
            ("-row ^2 * a", "row"),
            ("a * -1.5^2", "1.5"),
            ("a + (row * - cos(angle)^2)", "cos(angle)"),
            ("2^-a^2", "a"),
        ] {
            assert_eq!(negated_power(text), Some(operand), "{text}");
            let refused = Formula::new(Target::Signal, text, &["a"]).unwrap_err();
            assert!(refused.to_string().contains(&format!("-{operand}^")), "{refused}");
        }
        let value = |text: &str| {
            let formula = Formula::new(Target::Signal, text, &["a"]).unwrap();
            formula.value(&[3.0], |_| 2.0, &mut Vec::new()).unwrap()
        };
        for (text, expected) in [
            ("0 - a^2", -9.0),
            ("(-a)^2", 9.0),
            ("-(a^2)", -9.0),
            ("row - a^2", -7.0),
            ("(row) - a^2", -7.0),
            ("0.1 * a - 2 * a^2", -17.7),
            ("a^-1", 1.0 / 3.0),
            ("-a * row", -6.0),
        ] {
            assert!((value(text) - expected).abs() < 1e-12, "{text}: {}", value(text));
        }
    }

    #[test]
    fn odd_texts_have_no_negated_power() {
        for text in ["", "-", "-(", "--", "-)", "- (a", "é-", "-é(", "-1", "^-"] {
            assert_eq!(negated_power(text), None, "{text}");
        }
    }
}
