//! One element of a PLY file, column by column.

use super::header::{Element, Header, Storage, Type};
use super::numbers::Numbers;
use crate::FormatError;

/// The values of one property.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Column {
    /// `uchar`, as it takes the least memory: colours.
    Byte(Vec<u8>),
    /// Any other integer; one over 2^31 keeps its bits.
    Int(Vec<i32>),
    /// `float`, and `double` rounded.
    Float(Vec<f32>),
}

/// The columns of an element by name, in the order of the file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Columns {
    pub(crate) rows: usize,
    columns: Vec<(String, Type, Column)>,
}

impl Columns {
    /// Reads the rows of `element`; its lists are skipped.
    pub(crate) fn read(
        element: &Element,
        header: &Header,
        numbers: &mut Numbers<'_>,
        file: &str,
    ) -> Result<Columns, FormatError> {
        let rows = checked_rows(element, header.storage, numbers, file)?;
        let mut columns: Vec<Option<Column>> = Vec::new();
        for property in &element.properties {
            columns.push(match (property.list, property.item) {
                (Some(_), _) => None,
                (_, Type::U8) => Some(Column::Byte(Vec::with_capacity(rows))),
                (_, item) if item.is_float() => Some(Column::Float(Vec::with_capacity(rows))),
                _ => Some(Column::Int(Vec::with_capacity(rows))),
            });
        }
        for _ in 0..rows {
            for (property, column) in element.properties.iter().zip(&mut columns) {
                match column {
                    Some(Column::Byte(values)) => values.push(numbers.integer(property.item)? as u8),
                    Some(Column::Int(values)) => values.push(numbers.integer(property.item)? as i32),
                    Some(Column::Float(values)) => values.push(numbers.float(property.item)?),
                    None => skip_list(property.list, property.item, numbers)?,
                }
            }
        }
        let named = element.properties.iter().zip(columns);
        let columns = named.filter_map(|(p, column)| Some((p.name.clone(), p.item, column?))).collect();
        Ok(Columns { rows, columns })
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.columns.iter().any(|(found, ..)| found == name)
    }

    pub(crate) fn is_float(&self, name: &str) -> bool {
        self.columns.iter().any(|(found, _, column)| found == name && matches!(column, Column::Float(_)))
    }

    /// Takes the column called `name` out, with its type in the file.
    pub(crate) fn take(&mut self, name: &str) -> Option<(Type, Column)> {
        let index = self.columns.iter().position(|(found, ..)| found == name)?;
        let (_, kind, column) = self.columns.remove(index);
        Some((kind, column))
    }

    /// Takes the column called `name` out as floats: integers as they are.
    pub(crate) fn take_floats(&mut self, name: &str) -> Option<Vec<f32>> {
        self.take(name).map(|(_, column)| Self::floats(column))
    }

    /// A column as floats.
    pub(crate) fn floats(column: Column) -> Vec<f32> {
        match column {
            Column::Float(values) => values,
            Column::Int(values) => values.into_iter().map(|value| value as f32).collect(),
            Column::Byte(values) => values.into_iter().map(f32::from).collect(),
        }
    }

    /// Takes the first column that is left.
    pub(crate) fn take_first(&mut self) -> Option<(String, Column)> {
        if self.columns.is_empty() {
            return None;
        }
        let (name, _, column) = self.columns.remove(0);
        Some((name, column))
    }

    /// The names that are left.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|(name, ..)| name.as_str())
    }
}

/// Leaves out all rows of an element.
pub(crate) fn skip(
    element: &Element,
    header: &Header,
    numbers: &mut Numbers<'_>,
    file: &str,
) -> Result<(), FormatError> {
    let rows = checked_rows(element, header.storage, numbers, file)?;
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..rows {
        for property in &element.properties {
            match property.list {
                Some(_) => skip_list(property.list, property.item, numbers)?,
                None => numbers.skip(property.item, 1)?,
            }
        }
    }
    Ok(())
}

/// The number of rows, once it is known that there are bytes for them.
fn checked_rows(
    element: &Element,
    storage: Storage,
    numbers: &Numbers<'_>,
    file: &str,
) -> Result<usize, FormatError> {
    let each = element.least_bytes(storage);
    // The last number of a text needs nothing behind it.
    let left = numbers.left() as u64 + u64::from(storage == Storage::Ascii);
    match left.checked_div(each) {
        // Rows of nothing take no byte and hold nothing.
        None => Ok(0),
        Some(most) if element.count <= most => Ok(element.count as usize),
        Some(most) => {
            let found = format!("{} rows of the element `{}`", element.count, element.name);
            let expected = format!("no more than {most}, for which there are bytes");
            Err(FormatError::invalid(file, format!("line {}", element.line), found, expected))
        }
    }
}

fn skip_list(length: Option<Type>, item: Type, numbers: &mut Numbers<'_>) -> Result<(), FormatError> {
    let count = numbers.length(length.unwrap_or(Type::U8))?;
    numbers.skip(item, count)
}
