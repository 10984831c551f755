//! What the tests of `vuris diagnose` share: the program run, its verdict on a campaign, the names in it.

mod form;

use assert_cmd::Command;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Whether `vuris` succeeds with these arguments, and all that it says.
pub fn vuris(arguments: &[&str]) -> (bool, String) {
    let output = Command::cargo_bin("vuris").unwrap().args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    (output.status.success(), text.into_owned())
}

/// A campaign, simulated into `folder` with these `options`. Some have theirs from elsewhere.
#[allow(dead_code)]
pub fn simulated(folder: PathBuf, options: &[&str]) -> PathBuf {
    let (good, text) = vuris(&[&["simulate", "--out", folder.to_str().unwrap()], options].concat());
    assert!(good, "{text}");
    folder
}

/// The options of `effects` that are concealed.
#[allow(dead_code)]
pub fn concealed<'a>(effects: &[&'a str]) -> Vec<&'a str> {
    effects.iter().flat_map(|effect| ["--effect", effect]).collect()
}

/// What is said of `campaign`, in the form that other programs read.
pub fn verdict(campaign: &Path) -> Value {
    let (good, text) = vuris(&["diagnose", campaign.to_str().unwrap(), "--json", "-"]);
    assert!(good, "{text}");
    let verdict = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    form::check(&verdict);
    verdict
}

/// The same of a campaign, simulated with these `options`, as `change` leaves it. Not every test changes one.
#[allow(dead_code)]
pub fn verdict_on_changed(options: &[&str], change: impl Fn(&Path)) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let campaign = simulated(folder.path().join("campaign"), options);
    change(&campaign);
    verdict(&campaign)
}

/// Value and standard deviation of a parameter of an effect that is asserted. Not every test asks for one.
#[allow(dead_code)]
pub fn parameter(verdict: &Value, name: &str) -> (f64, f64) {
    let effects = verdict["effects"].as_array().unwrap();
    let mut rows = effects.iter().flat_map(|effect| effect["parameters"].as_array().unwrap());
    let row = rows.find(|row| row["name"] == name).unwrap_or_else(|| panic!("no {name}: {verdict}"));
    (row["value"].as_f64().unwrap(), row["sigma"].as_f64().unwrap())
}

/// The effects that are asserted, by their names' order.
pub fn names(verdict: &Value) -> Vec<String> {
    let effects = verdict["effects"].as_array().unwrap();
    let mut names: Vec<String> =
        effects.iter().map(|effect| effect["name"].as_str().unwrap().to_owned()).collect();
    names.sort();
    names
}
