//! Effects that a user adds as formulas in a TOML file.

use crate::fields::{self, Fields};
use crate::physics::{Act, COORDINATES, Chance, EFFECTS, Effect, Fidelity, Formula, Parameter, Target};
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
        .map_err(|problem| fields.told_of("formula", problem))?;
    let place = target.place();
    let values = |of: fn(&Parameter) -> f64| -> Vec<Option<f64>> {
        let values: Vec<f64> = parameters.iter().map(of).collect();
        PLACES.iter().map(|place| formula.value(&values, |number| place[number], &mut Vec::new())).collect()
    };
    let is_off = |value: &Option<f64>| value.is_none_or(|value| value == 0.0);
    if !values(|parameter| parameter.off).iter().all(is_off) {
        return Err(fields
            .refuse("formula", "a formula that is 0 where every strength is 0: there the effect is off"));
    }
    // One that is a number nowhere among these may be one elsewhere.
    let typical = values(|parameter| parameter.typical);
    if typical.iter().any(Option::is_some) && typical.iter().all(is_off) {
        return Err(
            fields.refuse("formula", "a formula that its parameters' typical values make something of")
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
        fidelity: Fidelity::Exact,
        act: Act::Formula(Box::new(formula)),
    })
}

/// Places at which a formula is tried: its coordinates, in their order.
const PLACES: [[f64; COORDINATES]; 3] = [
    [0.31, 1.7, 1.2, 1.21, 0.0, 0.0, 4.0, 1.0, 0.4, 3.0, 5.0, 310.0, 120.0],
    [2.9, 4.6, 2.3, 2.29, -1.7, 3.0, 5.0, 42.0, 17.0, 11.0, 2.0, 905.0, 33.0],
    [5.2, 0.4, 3.1, 3.12, 1.9, 2.0, 5.0, 303.0, 140.0, 97.0, 131.0, 2030.0, 410.0],
];

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
