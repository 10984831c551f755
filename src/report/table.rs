//! Tables as text: Markdown with columns of one width, and CSV.

use crate::problem::{Problem, Result};
use comfy_table::{ContentArrangement, Row, Table, presets};

/// A Markdown table whose columns are as wide as their widest cell.
pub fn aligned<H: Into<Row>, R: Into<Row>>(header: H, rows: impl IntoIterator<Item = R>) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header);
    table.add_rows(rows);
    table
}

/// CSV text, a line a row, quoted where it has to be.
///
/// # Errors
/// Rows that are not equally long.
pub fn csv_text<C: AsRef<[u8]>, R: IntoIterator<Item = C>>(
    rows: impl IntoIterator<Item = R>,
) -> Result<String> {
    let cannot = |error: csv::Error| {
        Problem::at("CSV", format_args!("cannot be written: {error}")).expected("rows of equal length")
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(row).map_err(cannot)?;
    }
    let bytes = writer.into_inner().map_err(|error| Problem::at("CSV", error))?;
    String::from_utf8(bytes).map_err(|error| Problem::at("CSV", error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_quotes_and_refuses_a_ragged_table() {
        assert_eq!(csv_text([["a", "b, c"], ["1", "2"]]).unwrap(), "a,\"b, c\"\n1,2\n");
        let refusal = csv_text([vec!["a", "b"], vec!["1"]]).unwrap_err().to_string();
        assert!(refusal.contains("rows of equal length"), "{refusal}");
    }
}
