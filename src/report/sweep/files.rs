//! A sweep's columns as CSV and as Parquet.

use super::super::table::csv_text;
use super::columns::{Column, Values};
use crate::problem::{Problem, Result};
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::sync::Arc;

/// The columns as CSV text. Numbers read back as they are.
pub fn sweep_csv(columns: &[Column]) -> Result<String> {
    let rows = columns.first().map_or(0, |column| match &column.values {
        Values::Integers(values) => values.len(),
        Values::Reals(values) => values.len(),
        Values::Texts(values) => values.len(),
    });
    let cell = |column: &Column, row: usize| match &column.values {
        Values::Integers(values) => values[row].to_string(),
        Values::Reals(values) => values[row].to_string(),
        Values::Texts(values) => values[row].clone(),
    };
    let header: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
    let line = |row| columns.iter().map(|column| cell(column, row)).collect();
    csv_text(std::iter::once(header).chain((0..rows).map(line)))
}

/// The columns as a Parquet file of one row group, every column required, texts as UTF-8, without compression.
pub fn sweep_parquet(columns: &[Column]) -> Result<Vec<u8>> {
    written(columns).map_err(|error| Problem::at("Parquet", format_args!("cannot be written: {error}")))
}

fn written(columns: &[Column]) -> std::result::Result<Vec<u8>, ParquetError> {
    let field = |column: &Column| {
        let (physical, logical) = match column.values {
            Values::Integers(_) => (Physical::INT64, None),
            Values::Reals(_) => (Physical::DOUBLE, None),
            Values::Texts(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        Type::primitive_type_builder(&column.name, physical)
            .with_repetition(Repetition::REQUIRED)
            .with_logical_type(logical)
            .build()
            .map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<std::result::Result<Vec<_>, _>>()?;
    let schema = Arc::new(Type::group_type_builder("sweep").with_fields(fields).build()?);
    let properties =
        WriterProperties::builder().set_created_by(concat!("vuris ", env!("CARGO_PKG_VERSION")).to_owned());
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    for column in columns {
        let Some(mut writer) = group.next_column()? else { break };
        match &column.values {
            Values::Integers(values) => writer.typed::<Int64Type>().write_batch(values, None, None)?,
            Values::Reals(values) => writer.typed::<DoubleType>().write_batch(values, None, None)?,
            Values::Texts(values) => {
                let texts: Vec<ByteArray> =
                    values.iter().map(|text| ByteArray::from(text.as_str())).collect();
                writer.typed::<ByteArrayType>().write_batch(&texts, None, None)?
            }
        };
        writer.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;
    use std::io::Write;

    fn columns() -> Vec<Column> {
        let column = |name: &str, values| Column { name: name.to_owned(), values };
        vec![
            column("n", Values::Integers(vec![-3, i64::MAX])),
            column("r", Values::Reals(vec![0.1, -1e-300])),
            column("t", Values::Texts(vec!["a,\"b\"".to_owned(), "π".to_owned()])),
        ]
    }

    #[test]
    fn csv_quotes_and_keeps_numbers() {
        let text = sweep_csv(&columns()).unwrap();
        assert!(text.starts_with("n,r,t\n-3,0.1,\"a,\"\"b\"\"\"\n9223372036854775807,-0.000"), "{text}");
        let last = text.lines().last().unwrap().split(',').nth(1).unwrap();
        assert_eq!(last.parse::<f64>().unwrap(), -1e-300);
        assert_eq!(sweep_csv(&[]).unwrap().trim(), "\"\"");
    }

    #[test]
    fn parquet_is_read_back_by_its_reader() {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&sweep_parquet(&columns()).unwrap()).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(|row| row.unwrap()).collect();
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[1].get_long(0).unwrap(), rows[1].get_double(1).unwrap()), (i64::MAX, -1e-300));
        assert_eq!(rows[0].get_string(2).unwrap(), "a,\"b\"");
    }
}
