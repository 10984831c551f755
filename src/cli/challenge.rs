//! `vuris challenge`

use super::fingerprint::fingerprint;
use super::place::at;
use super::print::{counted, say};
use super::progress;
use crate::artifact::write_file;
use crate::challenge::{
    Answer, LabelFile, Seal, SealFile, Simpler, drawn, entropy, opened, scored, sealed, summary, table,
};
use crate::problem::{Problem, Result};
use crate::recording::{Staging, write_campaign};
use clap::{Args, Subcommand};
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Campaigns with concealed effects from a second, independent generator: make them, answer them, score the answers
#[derive(Debug, Args)]
pub(super) struct Challenge {
    #[command(subcommand)]
    step: Step,
}

#[derive(Debug, Subcommand)]
enum Step {
    Make(Make),
    Answer(Answers),
    Score(Score),
}

/// Draw campaigns; seals go with them, labels into a file beside the folder
#[derive(Debug, Args)]
struct Make {
    /// Number of campaigns
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    cases: u32,
    /// The seed that everything follows from
    #[arg(
        long,
        value_name = "S",
        required_unless_present = "seed_from_entropy",
        conflicts_with = "seed_from_entropy"
    )]
    seed: Option<u64>,
    /// Take a seed that nobody knows; it is written to the file of labels
    #[arg(long)]
    seed_from_entropy: bool,
    /// The new folder of the challenge
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// File of the labels, outside of DIR [default: DIR-labels.json]
    #[arg(long, value_name = "FILE")]
    labels: Option<PathBuf>,
    /// The smallest sensor and few sets: for a trial
    #[arg(long)]
    tiny: bool,
}

/// Diagnose every campaign, each in a process that has only that campaign's folder
#[derive(Debug, Args)]
struct Answers {
    /// The folder of the challenge
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Check the seals, open the labels, and judge the answers
#[derive(Debug, Args)]
struct Score {
    /// The folder of the challenge
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// File of the labels
    #[arg(long, value_name = "FILE")]
    labels: PathBuf,
    /// Write the score as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

const SEALS: &str = "seals.json";
const CAMPAIGNS: &str = "campaigns";
const ANSWERS: &str = "answers";

impl Challenge {
    pub(super) fn run(self) -> Result<ExitCode> {
        match self.step {
            Step::Make(step) => step.run(),
            Step::Answer(step) => step.run(),
            Step::Score(step) => step.run(),
        }
    }
}

impl Make {
    fn run(self) -> Result<ExitCode> {
        let out = &self.out;
        let name = out.file_name().unwrap_or_default();
        let labels_file = self
            .labels
            .clone()
            .unwrap_or_else(|| out.with_file_name(format!("{}-labels.json", name.to_string_lossy())));
        for path in [out, &labels_file] {
            if path.symlink_metadata().is_ok() {
                return Err(Problem::in_file(path, "is there already")
                    .expected("a new challenge")
                    .remedy("name another --out or --labels, or remove it"));
            }
        }
        if at(&labels_file).starts_with(at(out)) {
            return Err(Problem::in_file(&labels_file, "lies in the challenge's own folder")
                .expected("a file that whoever answers does not have")
                .remedy(format_args!("take a place outside of {}", out.display())));
        }
        let seed = self.seed.unwrap_or_else(entropy);
        let cases = drawn(self.cases as usize, seed, self.tiny);
        let staging = Staging::beside(out)?;
        let new = staging.path();
        let labels = progress::steps(cases.len(), |done| {
            cases
                .par_iter()
                .map(|case| {
                    let (label, recordings) = case.made()?;
                    let camera = recordings.first().and_then(|recording| recording.camera.clone());
                    let campaigns = new.join(CAMPAIGNS);
                    write_campaign(&recordings, camera.as_ref(), &campaigns.join(case.name()))?;
                    let fingerprint = fingerprint(&campaigns, &case.name())?;
                    done("campaigns");
                    Ok((label, fingerprint))
                })
                .collect::<Result<Vec<_>>>()
        })?;
        let (labels, seals) = sealed(&labels, seed)?;
        staging.write_text(SEALS, &json_text(&seals)?)?;
        write_file(&labels_file, &json_text(&labels)?)?;
        staging.publish_new()?;
        say!("written: {}, {} with {SEALS}", out.display(), counted(cases.len(), "campaign"));
        say!("written: {}", labels_file.display());
        Ok(ExitCode::SUCCESS)
    }
}

fn json_text(value: &impl Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Problem::at("a file of JSON", error))?;
    Ok(text + "\n")
}

fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let text = fs::read_to_string(path).map_err(|error| Problem::io(path, "read", &error))?;
    serde_json::from_str(&text).map_err(|error| Problem::in_file(path, error))
}

/// The seals of the challenge in `folder`, one a campaign.
fn seals(folder: &Path) -> Result<SealFile> {
    let file = folder.join(SEALS);
    let seals: SealFile = read_json(&file).map_err(|problem| {
        problem
            .expected("the seals that `vuris challenge make` has written beside the campaigns")
            .remedy("give the folder that it was told as --out")
    })?;
    seals.checked(&file.display().to_string())
}

/// Refuses a campaign in `folder` that is not the one that was sealed.
fn is_sealed(folder: &Path, seal: &Seal) -> Result<()> {
    let campaigns = folder.join(CAMPAIGNS);
    if fingerprint(&campaigns, &seal.case)? == seal.campaign_sha256 {
        return Ok(());
    }
    let what = if campaigns.join(&seal.case).is_dir() { "does not fit its seal" } else { "is not there" };
    Err(Problem::in_file(&campaigns.join(&seal.case), format_args!("the campaign {what}"))
        .expected(format_args!("files whose fingerprint is {}", seal.campaign_sha256))
        .remedy("take the campaigns as `vuris challenge make` wrote them"))
}

impl Answers {
    fn run(self) -> Result<ExitCode> {
        let seals = seals(&self.folder)?.cases;
        let program = std::env::current_exe()
            .map_err(|error| Problem::at("this program", error).expected("a path to it"))?;
        let open: Vec<&Seal> = seals
            .iter()
            .filter(|Seal { case, .. }| {
                !is_answered::<Answer>(&answer_file(&self.folder, case), &program)
                    || !is_answered::<Simpler>(&simpler_file(&self.folder, case), &program)
            })
            .collect();
        let failures: Vec<Problem> = progress::steps(open.len(), |done| {
            let answer = |seal: &&Seal| {
                let name = &seal.case;
                let texts = is_sealed(&self.folder, seal)
                    .and_then(|()| diagnosed(&program, &self.folder.join(CAMPAIGNS).join(name)));
                let written = texts.and_then(|[answer, simpler]| {
                    write_file(&simpler_file(&self.folder, name), &simpler)?;
                    write_file(&answer_file(&self.folder, name), &answer)
                });
                done("campaigns");
                written.err()
            };
            open.par_iter().filter_map(answer).collect()
        });
        if let Some(first) = failures.first() {
            let others =
                format!("{} of {} were not answered; the first: {first}", failures.len(), seals.len());
            return Err(Problem::in_file(&self.folder, others)
                .expected("an answer to every campaign")
                .remedy("run it again: what is answered stays"));
        }
        say!("{} answered, {} of them now", counted(seals.len(), "campaign"), open.len());
        Ok(ExitCode::SUCCESS)
    }
}

/// The answer to the campaign called `case`.
fn answer_file(folder: &Path, case: &str) -> PathBuf {
    folder.join(ANSWERS).join(format!("{case}.json"))
}

/// What simpler methods name in it.
fn simpler_file(folder: &Path, case: &str) -> PathBuf {
    folder.join(ANSWERS).join(format!("{case}.simpler.json"))
}

/// Whether `file` is a whole answer of this `program` or a later one.
fn is_answered<T: DeserializeOwned>(file: &Path, program: &Path) -> bool {
    let changed = |path: &Path| fs::metadata(path).and_then(|data| data.modified()).ok();
    read_json::<T>(file).is_ok() && changed(file) >= changed(program)
}

/// The diagnosis of the campaign in `folder`, by a process that stands in a copy of it and has nothing else; and what simpler methods
/// name there.
fn diagnosed(program: &Path, folder: &Path) -> Result<[String; 2]> {
    let cannot = |error: std::io::Error| Problem::io(folder, "copy", &error);
    let room = tempfile::Builder::new().prefix("vuris-").tempdir().map_err(cannot)?;
    let copy = room.path().join("campaign");
    copy_folder(folder, &copy).map_err(cannot)?;
    let simpler = room.path().join("simpler.json");
    let output = Command::new(program)
        .args(["diagnose", ".", "--json", "-", "--simpler"])
        .arg(&simpler)
        .current_dir(&copy)
        .env_clear()
        // As many processes run at once as there are processors.
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .map_err(|error| Problem::io(program, "run", &error))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(Problem::in_file(folder, format_args!("the diagnosis failed: {}", said.trim())));
    }
    serde_json::from_str::<Answer>(&text)
        .map_err(|error| Problem::in_file(folder, format_args!("the diagnosis is no answer: {error}")))?;
    let simpler = fs::read_to_string(&simpler).map_err(|error| Problem::io(&simpler, "read", &error))?;
    Ok([text, simpler])
}

fn copy_folder(from: &Path, to: &Path) -> std::io::Result<()> {
    fs::create_dir(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let (path, copy) = (entry.path(), to.join(entry.file_name()));
        if entry.file_type()?.is_dir() {
            copy_folder(&path, &copy)?;
        } else {
            fs::copy(&path, &copy)?;
        }
    }
    Ok(())
}

impl Score {
    fn run(self) -> Result<ExitCode> {
        if let Some(json) = &self.json {
            let is_of_challenge = at(json).starts_with(at(&self.folder)) || at(json) == at(&self.labels);
            if is_of_challenge {
                return Err(Problem::in_file(
                    json,
                    "is the file of labels, or lies in the challenge's own folder",
                )
                .expected("another file for the score")
                .remedy("choose another --json"));
            }
        }
        let seals = seals(&self.folder)?;
        let sealed: LabelFile = read_json(&self.labels).map_err(|problem| {
            problem
                .expected("the file of labels that `vuris challenge make` has written")
                .remedy("give the file that it named; by itself it is called DIR-labels.json")
        })?;
        let labels = opened(&self.labels.display().to_string(), &sealed, &seals)?;
        seals.cases.par_iter().try_for_each(|seal| is_sealed(&self.folder, seal))?;
        let mut cases = Vec::new();
        for label in labels {
            let missing = |problem: Problem| {
                problem
                    .expected("an answer to every campaign")
                    .remedy(format_args!("vuris challenge answer {}", self.folder.display()))
            };
            let answer: Answer = read_json(&answer_file(&self.folder, &label.case)).map_err(missing)?;
            let simpler: Simpler = read_json(&simpler_file(&self.folder, &label.case)).map_err(missing)?;
            cases.push((label, answer, simpler));
        }
        let scored = scored(cases);
        if let Some(file) = &self.json {
            write_file(file, &json_text(&summary(&scored))?)?;
        }
        say!(
            "{} of seed {}, all labels and campaigns fit their seals",
            counted(scored.cases.len(), "case"),
            sealed.seed
        );
        say!("{}", table(&scored).trim_end());
        Ok(ExitCode::SUCCESS)
    }
}
