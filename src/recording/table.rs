//! A table of comma-separated values, so that every refusal names file, line, column and value.

use crate::problem::{Problem, Result};
use csv::StringRecord;
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::Path;

/// A table whose rows all have as many cells as its header.
pub(super) struct Table {
    file: String,
    header: Vec<String>,
    rows: Vec<Row>,
}

struct Row {
    line: u64,
    cells: StringRecord,
}

impl Table {
    /// Reads the file at `path`, which must have the `required` columns (in any order, among others) and `rows` rows;
    /// `why` says where that number comes from.
    pub fn read(path: &Path, required: &[&str], rows: usize, why: &str) -> Result<Self> {
        let file = path.display().to_string();
        let columns = format!("the columns {}, separated by commas", required.join(","));
        let failed = |error: csv::Error| {
            let line =
                error.position().map_or(String::new(), |position| format!(", line {}", position.line()));
            Problem::at(format_args!("{file}{line}"), format_args!("cannot read: {error}"))
                .expected(format_args!("a table in UTF-8 with {columns}"))
        };
        let mut reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).from_path(path).map_err(failed)?;
        let header: Vec<String> = reader.headers().map_err(failed)?.iter().map(str::to_owned).collect();
        let first_line = format!("{file}, line 1");
        if let Some(missing) = required.iter().find(|&&name| !header.iter().any(|column| column == name)) {
            let found = format_args!("column {missing} is missing (there are: {})", header.join(" | "));
            return Err(Problem::at(first_line, found).expected(columns));
        }
        if let Some((_, twice)) = (1..).zip(&header).find(|(after, name)| header[*after..].contains(name)) {
            return Err(Problem::at(first_line, format_args!("column \"{twice}\" occurs twice"))
                .expected("every column once"));
        }
        let mut read_rows = Vec::new();
        for record in reader.records() {
            let cells = record.map_err(failed)?;
            let line = cells.position().map_or(0, csv::Position::line);
            if cells.len() != header.len() {
                return Err(Problem::at(
                    format_args!("{file}, line {line}"),
                    format_args!("{} cells", cells.len()),
                )
                .expected(format_args!("{}, one for each column of line 1", header.len())));
            }
            read_rows.push(Row { line, cells });
        }
        if read_rows.len() != rows {
            let found = format_args!("{} rows below the header", read_rows.len());
            return Err(Problem::at(&file, found).expected(format_args!("{rows} rows: {why}")));
        }
        Ok(Self { file, header, rows: read_rows })
    }

    /// Names of the columns that are not among `known`, in the file's order.
    pub fn others(&self, known: &[&str]) -> Vec<String> {
        self.header.iter().filter(|name| !known.contains(&name.as_str())).cloned().collect()
    }

    /// The text of a cell; empty where there is none.
    pub fn text(&self, row: usize, column: &str) -> &str {
        let index = self.header.iter().position(|name| name == column);
        self.rows.get(row).zip(index).and_then(|(row, index)| row.cells.get(index)).unwrap_or("")
    }

    /// A refusal of a cell.
    pub fn refuse(&self, row: usize, column: &str, expected: impl Display) -> Problem {
        let line = self.rows.get(row).map_or(0, |row| row.line);
        Problem::at(
            format_args!("{}, line {line}", self.file),
            format_args!("{column} = \"{}\"", self.text(row, column)),
        )
        .expected(expected)
    }

    /// A finite number within `allowed`; `unit` is said in a refusal.
    pub fn number(&self, row: usize, column: &str, allowed: &RangeInclusive<f64>, unit: &str) -> Result<f64> {
        let value = self.text(row, column).parse::<f64>().ok();
        value.filter(|value| allowed.contains(value)).ok_or_else(|| {
            let (low, high) = (allowed.start(), allowed.end());
            self.refuse(row, column, format_args!("a number from {low:e} to {high:e} {unit}"))
        })
    }

    /// Refuses a cell that is not the whole number `index`.
    pub fn index(&self, row: usize, column: &str, index: usize) -> Result<()> {
        if self.text(row, column).parse() == Ok(index) {
            return Ok(());
        }
        Err(self
            .refuse(row, column, format_args!("{index}: rows stand in the order of frames.npy, from 0 on"))
            .remedy("sort and complete the rows"))
    }
}
