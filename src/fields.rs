//! Reading a TOML table field by field, so that every refusal names file, field, value and what is allowed.

use crate::problem::{Problem, Result};
use std::fmt::Display;
use std::ops::RangeInclusive;
use toml::{Table, Value};

/// A table of a TOML file, with the file's name and the table's own path in it.
#[derive(Clone)]
pub struct Fields<'a> {
    file: &'a str,
    path: String,
    table: &'a Table,
}

/// Parses the text of the TOML file called `file`.
pub fn parse(file: &str, text: &str) -> Result<Table> {
    text.parse::<Table>().map_err(|error| {
        Problem::at(file, error.to_string().trim_end()).expected("a TOML file (https://toml.io)")
    })
}

impl<'a> Fields<'a> {
    /// The top level of the file called `file`.
    pub fn top(file: &'a str, table: &'a Table) -> Self {
        Self { file, path: String::new(), table }
    }

    /// The field's full name, as `section.field`.
    fn name(&self, field: &str) -> String {
        if self.path.is_empty() { field.to_owned() } else { format!("{}.{field}", self.path) }
    }

    fn missing(&self, field: &str, expected: impl Display) -> Problem {
        Problem::at(self.file, format_args!("{} is missing", self.name(field))).expected(expected)
    }

    /// A refusal of the value that `field` has.
    pub fn refuse(&self, field: &str, expected: impl Display) -> Problem {
        let name = self.name(field);
        match self.table.get(field) {
            Some(value) => Problem::at(self.file, format_args!("{name} = {value}")).expected(expected),
            None => self.missing(field, expected),
        }
    }

    /// A `problem` of the value that `field` has, told of that.
    pub fn told_of(&self, field: &str, problem: Problem) -> Problem {
        problem.moved_to(format_args!("{}: {}", self.file, self.name(field)))
    }

    /// The table `field`, which must be there.
    pub fn section(&self, field: &str) -> Result<Fields<'a>> {
        self.optional_section(field)?
            .ok_or_else(|| self.missing(field, format_args!("a table [{}]", self.name(field))))
    }

    /// The table `field`, where it is there.
    pub fn optional_section(&self, field: &str) -> Result<Option<Fields<'a>>> {
        match self.table.get(field) {
            None => Ok(None),
            Some(Value::Table(table)) => Ok(Some(Fields { file: self.file, path: self.name(field), table })),
            Some(_) => Err(self.refuse(field, format_args!("a table [{}]", self.name(field)))),
        }
    }

    /// Refuses every field that is not one of `known`.
    pub fn only(&self, known: &[&str]) -> Result<()> {
        match self.table.keys().find(|key| !known.contains(&key.as_str())) {
            None => Ok(()),
            Some(key) => {
                Err(Problem::at(self.file, format_args!("{} is not a field of this file", self.name(key)))
                    .expected(format_args!("one of {}", known.join(", ")))
                    .remedy("correct the spelling, or remove the line"))
            }
        }
    }

    /// A string.
    pub fn text(&self, field: &str, expected: &str) -> Result<&'a str> {
        self.table.get(field).and_then(Value::as_str).ok_or_else(|| self.refuse(field, expected))
    }

    /// A whole number within `allowed`.
    pub fn integer(&self, field: &str, allowed: RangeInclusive<i64>) -> Result<i64> {
        self.table.get(field).and_then(Value::as_integer).filter(|value| allowed.contains(value)).ok_or_else(
            || {
                self.refuse(
                    field,
                    format_args!("a whole number from {} to {}", allowed.start(), allowed.end()),
                )
            },
        )
    }

    /// A whole number within `allowed`, or `default` where the field is absent.
    pub fn integer_or(&self, field: &str, allowed: RangeInclusive<i64>, default: i64) -> Result<i64> {
        if self.table.contains_key(field) { self.integer(field, allowed) } else { Ok(default) }
    }

    /// True or false, or `default` where the field is absent.
    pub fn flag_or(&self, field: &str, default: bool) -> Result<bool> {
        match self.table.get(field) {
            None => Ok(default),
            Some(value) => value.as_bool().ok_or_else(|| self.refuse(field, "true or false")),
        }
    }

    /// A finite number within `allowed`; `unit` is said in a refusal.
    pub fn number(&self, field: &str, allowed: RangeInclusive<f64>, unit: &str) -> Result<f64> {
        self.table
            .get(field)
            .and_then(as_number)
            .filter(|value| value.is_finite() && allowed.contains(value))
            .ok_or_else(|| {
                self.refuse(
                    field,
                    format_args!("a number from {:e} to {:e} {unit}", allowed.start(), allowed.end()),
                )
            })
    }

    /// A finite number within `allowed`, or `default` where the field is absent.
    pub fn number_or(
        &self,
        field: &str,
        allowed: RangeInclusive<f64>,
        unit: &str,
        default: f64,
    ) -> Result<f64> {
        if self.table.contains_key(field) { self.number(field, allowed, unit) } else { Ok(default) }
    }

    /// A list of finite numbers.
    pub fn numbers(&self, field: &str, expected: &str) -> Result<Vec<f64>> {
        self.table
            .get(field)
            .and_then(Value::as_array)
            .and_then(|values| {
                values.iter().map(|value| as_number(value).filter(|number| number.is_finite())).collect()
            })
            .ok_or_else(|| self.refuse(field, expected))
    }

    /// The tables `[[field]]`, none where it is absent.
    pub fn tables(&self, field: &str) -> Result<Vec<Fields<'a>>> {
        let expected = format!("tables [[{}]]", self.name(field));
        let Some(value) = self.table.get(field) else { return Ok(Vec::new()) };
        let values = value.as_array().ok_or_else(|| self.refuse(field, &expected))?;
        let table = |(number, value): (usize, &'a Value)| {
            let table = value.as_table().ok_or_else(|| self.refuse(field, &expected))?;
            Ok(Fields { file: self.file, path: format!("{}[{number}]", self.name(field)), table })
        };
        values.iter().enumerate().map(table).collect()
    }

    /// A list of whole numbers.
    pub fn integers(&self, field: &str, expected: &str) -> Result<Vec<i64>> {
        self.table
            .get(field)
            .and_then(Value::as_array)
            .and_then(|values| values.iter().map(Value::as_integer).collect())
            .ok_or_else(|| self.refuse(field, expected))
    }

    /// A list of strings, empty where the field is absent.
    pub fn texts(&self, field: &str) -> Result<Vec<&'a str>> {
        let Some(value) = self.table.get(field) else { return Ok(Vec::new()) };
        value
            .as_array()
            .and_then(|values| values.iter().map(Value::as_str).collect())
            .ok_or_else(|| self.refuse(field, "a list of strings"))
    }

    /// Whether the field is a table.
    pub fn is_table(&self, field: &str) -> bool {
        self.table.get(field).is_some_and(Value::is_table)
    }

    /// Whether the field is there.
    pub fn has(&self, field: &str) -> bool {
        self.table.contains_key(field)
    }
}

/// TOML tells 30 from 30.0; a physical quantity may be written either way.
fn as_number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|integer| integer as f64))
}
