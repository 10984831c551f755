//! Effects that a user adds as formulas in a TOML file.

use crate::fields::{self, Fields};
use crate::physics::{Act, Chance, EFFECTS, Effect, Formula, Parameter, Target};
use crate::problem::{Problem, Result};

/// Reads the text of the file called `file`: `[[effect]]` with name, sentence, `acts_on` (signal, phase, amplitude, ambient), formula, and
/// `[[effect.parameter]]` with name, unit, bounds, typical.
///
/// The effects live as long as the program.
///
/// # Errors
/// A field that is missing or of another type, a name that is taken, a formula that cannot be read.
pub fn library(file: &str, text: &str) -> Result<Vec<&'static Effect>> {
    let table = fields::parse(file, text)?;
    let top = Fields::top(file, &table);
    let mut effects: Vec<&'static Effect> = Vec::new();
    for fields in top.tables("effect")? {
        let effect = effect(&fields)?;
        if EFFECTS.iter().chain(&effects).any(|known| known.name == effect.name) {
            return Err(fields.refuse("name", "a name that no other effect has"));
        }
        // A library is read once, and its effects are used until the program ends.
        effects.push(Box::leak(Box::new(effect)));
    }
    if effects.is_empty() {
        return Err(Problem::at(file, "holds no effect").expected("at least one [[effect]]"));
    }
    Ok(effects)
}

fn leaked(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

fn effect(fields: &Fields) -> Result<Effect> {
    let name = fields.text("name", "the effect's name, such as row_ripple")?;
    let sentence = fields.text("sentence", "one plain sentence that says what it is")?;
    let acts_on = fields.text("acts_on", "signal, phase, amplitude or ambient")?;
    let target = Target::ALL.iter().find(|(known, _)| *known == acts_on).map(|(_, target)| *target);
    let target = target.ok_or_else(|| fields.refuse("acts_on", "signal, phase, amplitude or ambient"))?;
    let parameters: Vec<Parameter> =
        fields.tables("parameter")?.iter().map(parameter).collect::<Result<_>>()?;
    let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name).collect();
    if parameters.iter().all(Parameter::is_shape) {
        return Err(fields.refuse(
            "parameter",
            "at least one strength: a parameter without shapes, with which the effect is off at 0",
        ));
    }
    let formula = Formula::new(target, fields.text("formula", "a formula")?, &names)
        .map_err(|problem| fields.refuse("formula", problem.found()))?;
    let place = target.place();
    let strengths_off: Vec<f64> = parameters.iter().map(|parameter| parameter.off).collect();
    let values = |values: &[f64]| PROBES.map(|probe| probed(&formula, values, probe));
    if values(&strengths_off).iter().any(|value| value.is_some_and(|value| value != 0.0)) {
        return Err(fields
            .refuse("formula", "a formula that is 0 where every strength is 0: there the effect is off"));
    }
    let typical: Vec<f64> = parameters.iter().map(|parameter| parameter.typical).collect();
    if values(&typical).iter().all(Option::is_none) {
        return Err(
            fields.refuse("formula", "a formula that is a number with the typical values of its parameters")
        );
    }
    Ok(Effect {
        name: leaked(name),
        sentence: leaked(sentence),
        reference: "a user's formula",
        parameters: Vec::leak(parameters),
        place,
        chance: Chance::None,
        looks_back: false,
        act: Act::Formula(Box::new(formula)),
    })
}

/// Places at which a formula is tried: what coordinates are there is of no meaning, but that they differ.
const PROBES: [f64; 4] = [0.31, 0.77, 1.9, 3.3];

/// The value of a `formula` at one of them.
fn probed(formula: &Formula, values: &[f64], probe: f64) -> Option<f64> {
    formula.value(values, |number| probe * (number + 1) as f64, &mut Vec::new())
}

fn parameter(fields: &Fields) -> Result<Parameter> {
    let name = leaked(fields.text("name", "the parameter's name")?);
    let unit = leaked(fields.text("unit", "its unit, 1 for a ratio")?);
    let bounds = fields.numbers("bounds", "two numbers: the least and the greatest value")?;
    let &[low, high] = &bounds[..] else { return Err(fields.refuse("bounds", "two numbers")) };
    let typical = fields.number("typical", f64::MIN_POSITIVE..=f64::MAX, unit)?;
    if !fields.has("shapes") {
        if !(low..=high).contains(&0.0) || low >= high {
            return Err(fields.refuse("bounds", "two numbers, 0 between them: there the effect is off"));
        }
        return Ok(Parameter::strength(name, unit, 0.0, (low, high), typical));
    }
    let shapes = fields.numbers("shapes", "numbers from which a search starts")?;
    let inside = shapes.iter().chain([&typical]).all(|shape| (low..=high).contains(shape));
    if shapes.is_empty() || !inside {
        return Err(fields.refuse("shapes", "numbers within the bounds, typical among them"));
    }
    Ok(Parameter::shape(name, unit, typical, (low, high), Vec::leak(shapes)))
}
