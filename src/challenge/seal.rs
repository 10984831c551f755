//! Seals: a salted hash of each label, and one of the campaign that it labels, which lie with the campaigns, while the labels lie elsewhere.

use super::label::Label;
use crate::problem::{Problem, Result};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::hash::{BuildHasher, Hasher};

const LABELS: &str = "vuris-challenge-labels/1";
const SEALS: &str = "vuris-challenge-seals/2";

/// A label with its salt.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SealedLabel {
    /// 32 hexadecimal digits.
    pub salt: String,
    /// The label, as the text that was sealed.
    pub label: serde_json::Value,
}

/// The file of labels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LabelFile {
    /// `vuris-challenge-labels/1`.
    pub format: String,
    /// The seed that all cases follow from.
    pub seed: u64,
    /// A label a case.
    pub cases: Vec<SealedLabel>,
}

/// A seal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seal {
    /// The campaign's folder.
    pub case: String,
    /// SHA-256 of salt, line feed and label, 64 hexadecimal digits.
    pub sha256: String,
    /// The fingerprint of the campaign's files, 64 hexadecimal digits; none in seals of the format before, which is refused by its name.
    #[serde(default)]
    pub campaign_sha256: String,
}

/// The file of seals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SealFile {
    /// `vuris-challenge-seals/2`.
    pub format: String,
    /// A seal a case.
    pub cases: Vec<Seal>,
}

/// 64 bits that nobody can foresee, from the operating system by way of the standard library's hash keys.
pub fn entropy() -> u64 {
    let mut hasher = std::hash::RandomState::new().build_hasher();
    hasher.write_u8(0);
    hasher.finish()
}

/// 16 bytes that follow from a seed and a use of it, in hexadecimal digits.
fn salt(seed: u64, case: &str) -> String {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(b"salt");
    hash.update(case.as_bytes());
    hexadecimal(&hash.finalize()[..16])
}

/// Two digits a byte.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn seal(sealed: &SealedLabel) -> String {
    let mut hash = Sha256::new();
    hash.update(sealed.salt.as_bytes());
    hash.update(b"\n");
    hash.update(sealed.label.to_string().as_bytes());
    hexadecimal(&hash.finalize())
}

/// The two files for labels, each with the fingerprint of its campaign; salts follow from `seed`.
///
/// # Errors
/// A label that is no JSON (a number that is not finite).
pub fn sealed(cases: &[(Label, String)], seed: u64) -> Result<(LabelFile, SealFile)> {
    let (mut labels, mut seals) = (Vec::new(), Vec::new());
    for (label, campaign_sha256) in cases {
        let value = serde_json::to_value(label).map_err(|error| Problem::at("the label", error))?;
        let sealed = SealedLabel { salt: salt(seed, &label.case), label: value };
        seals.push(Seal {
            case: label.case.clone(),
            sha256: seal(&sealed),
            campaign_sha256: campaign_sha256.clone(),
        });
        labels.push(sealed);
    }
    let labels = LabelFile { format: LABELS.to_owned(), seed, cases: labels };
    Ok((labels, SealFile { format: SEALS.to_owned(), cases: seals }))
}

impl SealFile {
    /// Refuses seals of another format; the file is called `name`.
    ///
    /// # Errors
    /// Another format.
    pub fn checked(self, name: &str) -> Result<Self> {
        format_is(name, &self.format, SEALS)?;
        Ok(self)
    }
}

fn format_is(name: &str, format: &str, expected: &str) -> Result<()> {
    if format == expected {
        return Ok(());
    }
    Err(Problem::at(name, format_args!("format = \"{format}\""))
        .expected(expected)
        .remedy("make the challenge anew, or use the program that made it"))
}

/// The labels of `file`, each of which must fit its seal in `seals`, and whose salts must follow from the file's seed. `file` is called `name` in refusals.
///
/// # Errors
/// Another format; a label that does not fit its seal, has none, or is missing; a label that is none; a seed that is not theirs.
pub fn opened(name: &str, file: &LabelFile, seals: &SealFile) -> Result<Vec<Label>> {
    format_is(name, &file.format, LABELS)?;
    let remedy = "take the labels as they were written with these campaigns";
    if file.cases.len() != seals.cases.len() {
        return Err(Problem::at(
            name,
            format_args!("{} labels for {} seals", file.cases.len(), seals.cases.len()),
        )
        .expected("a label for each seal")
        .remedy(remedy));
    }
    let mut labels = Vec::new();
    for (sealed, known) in file.cases.iter().zip(&seals.cases) {
        let place = format!("{name}: case {}", known.case);
        if seal(sealed) != known.sha256 {
            return Err(Problem::at(place, "the label does not fit its seal")
                .expected(format_args!("SHA-256 of salt and label {}", known.sha256))
                .remedy(remedy));
        }
        if sealed.salt != salt(file.seed, &known.case) {
            return Err(Problem::at(place, format_args!("the salt is not that of seed = {}", file.seed))
                .expected("the seed that the challenge was made of")
                .remedy(remedy));
        }
        let label: Label = serde_json::from_value(sealed.label.clone())
            .map_err(|error| Problem::at(&place, error).expected("a label").remedy(remedy))?;
        if label.case != known.case {
            return Err(Problem::at(place, format_args!("the label is that of case {}", label.case))
                .expected("labels in the order of the seals")
                .remedy(remedy));
        }
        labels.push(label);
    }
    Ok(labels)
}
