//! Effects that the registry has not, as formulas: what should be unexplained, and where it should be found.

use crate::bench::library;
use crate::physics::Effect;
use crate::problem::Result;

/// An effect, and the coordinates where it lives: to lead with any of them is right.
pub type Outside = (&'static Effect, &'static [&'static str]);

const LIVES: [(&str, &[&str]); 7] = [
    ("ripple_of_rows", &["row", "set"]),
    ("thermostat", &["time_s", "set", "encoder"]),
    ("gain_of_every_other_set", &["set"]),
    ("shade", &["position_m"]),
    ("pulse_in_a_frame", &["frame"]),
    ("phase_of_velocity", &["velocity_m_s", "encoder"]),
    ("step_over_the_light", &["code", "amplitude"]),
];

const FORMULAS: &str = r#"
[[effect]]
name = "ripple_of_rows"
sentence = "The supply's ripple stands on the rows while they are read, the same in every second set."
acts_on = "signal"
formula = "amplitude_dn * sin(1.9 * row) * cos(PI * set)"
parameter = [{ name = "amplitude_dn", unit = "DN", bounds = [-500, 500], typical = 1 }]

[[effect]]
name = "thermostat"
sentence = "The phase swings with the temperature."
acts_on = "phase"
formula = "swing_rad * sin(2 * PI * time_s / 7.3)"
parameter = [{ name = "swing_rad", unit = "rad", bounds = [-1, 1], typical = 0.001 }]

[[effect]]
name = "gain_of_every_other_set"
sentence = "Two capacitors take turns."
acts_on = "signal"
formula = "relative * signal * cos(PI * set)"
parameter = [{ name = "relative", unit = "1", bounds = [-1, 1], typical = 0.001 }]

[[effect]]
name = "shade"
sentence = "Something shades the target where it passes."
acts_on = "amplitude"
formula = "0 - share * exp(0 - ((position_m - 1.9) / 0.2)^2)"
parameter = [{ name = "share", unit = "1", bounds = [-1, 1], typical = 0.01 }]

[[effect]]
name = "pulse_in_a_frame"
sentence = "A pulse reaches the read-out in the second frame of every set."
acts_on = "signal"
formula = "amplitude_dn * exp(0 - 10 * (frame - 1)^2)"
parameter = [{ name = "amplitude_dn", unit = "DN", bounds = [-500, 500], typical = 1 }]

[[effect]]
name = "phase_of_velocity"
sentence = "The phase is off while the carriage moves, by its velocity."
acts_on = "phase"
formula = "relative_rad * velocity_m_s"
parameter = [{ name = "relative_rad", unit = "rad s/m", bounds = [-3, 3], typical = 0.01 }]

[[effect]]
name = "step_over_the_light"
sentence = "A pixel takes charge away as soon as it has so much, and not all of it comes back."
acts_on = "signal"
formula = "amplitude_dn / (1 + exp((500 - signal) / 5))"
parameter = [{ name = "amplitude_dn", unit = "DN", bounds = [-500, 500], typical = 1 }]
"#;

/// All of them.
///
/// # Errors
/// None, as long as the formulas are.
pub fn outside() -> Result<Vec<Outside>> {
    let effects = library("src/study/outside.rs", FORMULAS)?;
    Ok(effects.into_iter().map(|effect| (effect, lives(effect.name))).collect())
}

/// Where the effect called `name` lives; nowhere, if it is none of these.
pub fn lives(name: &str) -> &'static [&'static str] {
    LIVES.iter().find(|(known, _)| *known == name).map_or(&[], |(_, lives)| *lives)
}

#[cfg(test)]
mod tests {
    use super::outside;

    #[test]
    fn each_effect_lives_somewhere() {
        let effects = outside().unwrap();
        assert_eq!(effects.len(), super::LIVES.len());
        assert!(effects.iter().all(|(_, lives)| !lives.is_empty()));
    }
}
