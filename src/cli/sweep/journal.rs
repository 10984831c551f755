//! The journal of a sweep: a line for each finished configuration, so that a run that was killed goes on where it was.

use super::output;
use crate::problem::{Problem, Result};
use crate::sweep::{Configuration, Coverage, Record, Shard, Tally};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

const FIRST_LINE: &str = "vuris-sweep-journal/1";

/// A journal that is open to be continued; nobody else can open it meanwhile.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    records: Vec<Record>,
}

/// What a sum is of, beside its shard.
pub(super) struct Subject {
    pub configuration: Configuration,
    pub coverage: Coverage,
    pub fingerprint: u64,
}

impl Subject {
    fn is_of(&self, record: &Record) -> bool {
        (self.configuration, self.coverage, self.fingerprint)
            == (record.configuration, record.coverage, record.fingerprint)
    }
}

/// The journal of `shard` in `folder`.
pub(super) fn path_in(folder: &Path, shard: Shard) -> PathBuf {
    folder.join(format!("sweep-{}-of-{}.journal", shard.index, shard.count))
}

/// All journals of `folder`, in the order of their names.
pub(super) fn paths_in(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = match std::fs::read_dir(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(|error| Problem::io(folder, "list", &error))?,
    };
    let mut paths = Vec::new();
    for entry in entries {
        let path = entry.map_err(|error| Problem::io(folder, "list", &error))?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if name.starts_with("sweep-") && name.ends_with(".journal") {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

/// The whole records of the journal at `path`, and whether anything else is in it: a line that a kill has cut off.
pub(super) fn read(path: &Path) -> Result<(Vec<Record>, bool)> {
    let bytes = std::fs::read(path).map_err(|error| Problem::io(path, "read", &error))?;
    let text = String::from_utf8_lossy(&bytes);
    let mut lines = text.lines();
    if lines.next().is_some_and(|first| first != FIRST_LINE && !FIRST_LINE.starts_with(first)) {
        return Err(Problem::in_file(path, "is no journal of a sweep")
            .expected(format_args!("\"{FIRST_LINE}\" in its first line"))
            .remedy("choose another folder"));
    }
    let lines: Vec<&str> = lines.collect();
    let records: Vec<Record> = lines.iter().filter_map(|line| Record::parse(line)).collect();
    let whole = records.len() == lines.len() && text.ends_with('\n');
    Ok((records, !whole))
}

impl Journal {
    /// Opens the journal of `shard` in `folder`, which is made where it is not there.
    pub(super) fn open(folder: &Path, shard: Shard) -> Result<Self> {
        std::fs::create_dir_all(folder).map_err(|error| Problem::io(folder, "make the folder", &error))?;
        let path = path_in(folder, shard);
        let cannot = |error: std::io::Error| Problem::io(&path, "write", &error);
        if path.symlink_metadata().is_ok() {
            // Where a kill has left half a line, the whole ones are written beside, and then take the file's place.
            let (records, damaged) = read(&path)?;
            if damaged {
                Self::locked(&path)?;
                let beside = output::stage(&path, text_of(&records).as_bytes())?;
                beside.persist(&path).map_err(|error| cannot(error.error))?;
            }
            let file = Self::locked(&path)?;
            return Ok(Self { file, records, path });
        }
        let beside = output::stage(&path, text_of(&[]).as_bytes())?;
        beside.persist_noclobber(&path).map_err(|error| cannot(error.error))?;
        let file = Self::locked(&path)?;
        Ok(Self { file, records: Vec::new(), path })
    }

    /// The file, to be appended to by nobody else.
    fn locked(path: &Path) -> Result<File> {
        let file =
            OpenOptions::new().append(true).open(path).map_err(|error| Problem::io(path, "open", &error))?;
        match file.try_lock() {
            Ok(()) => Ok(file),
            Err(TryLockError::WouldBlock) => Err(Problem::in_file(path, "another sweep is writing it")
                .remedy("wait for it, or choose another --out or --shard")),
            Err(TryLockError::Error(error)) => Err(Problem::io(path, "lock", &error)),
        }
    }

    /// The sums of `subject` over `shard`, if an earlier run has finished them.
    pub(super) fn find(&self, subject: &Subject, shard: Shard) -> Option<&Tally> {
        let record = self.records.iter().find(|record| subject.is_of(record) && record.shard == shard);
        record.map(|record| &record.tally)
    }

    /// Writes a finished configuration down.
    pub(super) fn add(&mut self, subject: &Subject, shard: Shard, tally: &Tally) -> Result<()> {
        let &Subject { configuration, coverage, fingerprint } = subject;
        let record = Record { configuration, coverage, shard, fingerprint, tally: tally.clone() };
        // One write at the file's end: it survives the program's death, and a line that it does not survive whole is noticed.
        let line = format!(
            "{}
",
            record.line()
        );
        self.file.write_all(line.as_bytes()).map_err(|error| Problem::io(&self.path, "write", &error))
    }
}

fn text_of(records: &[Record]) -> String {
    let lines = records.iter().map(Record::line);
    std::iter::once(FIRST_LINE.to_owned()).chain(lines).map(|line| line + "\n").collect()
}

/// The sums of `subject` over all shards, from `records` of any journals; a refusal that says which are missing.
pub(super) fn merged(folder: &Path, records: &[Record], subject: &Subject) -> Result<Tally> {
    let own: Vec<&Record> = records.iter().filter(|record| subject.is_of(record)).collect();
    let mut missing = "all shards are missing".to_owned();
    for count in own.iter().map(|record| record.shard.count) {
        let shard = |index| own.iter().find(|record| record.shard == Shard { index, count });
        let found: Vec<&Tally> = (1..=count).filter_map(shard).map(|record| &record.tally).collect();
        if found.len() as u64 == count {
            return Ok(found.into_iter().fold(Tally::default(), |sum, tally| sum.merged(tally)));
        }
        let absent: Vec<String> = (1..=count)
            .filter(|&index| shard(index).is_none())
            .map(|index| format!("{index}/{count}"))
            .collect();
        missing = format!("shard {} is missing", absent.join(", "));
    }
    Err(Problem::in_file(folder, format_args!("{}: {missing}", subject.configuration))
        .expected("journals of all shards of a sweep with the same options")
        .remedy("run the missing shards with --shard and the same --out, or copy their journals here"))
}
