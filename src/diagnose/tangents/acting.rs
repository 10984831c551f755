//! Columns in one frame. Many differ there by a factor alone: they are so much of a few patterns.

/// So much of a pattern that a column is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Number of the column.
    pub column: usize,
    /// Number of the pattern.
    pub pattern: usize,
    /// How much of it.
    pub factor: f64,
}

impl Share {
    /// The same where so many columns and patterns come before.
    pub fn after(self, columns: usize, patterns: usize) -> Self {
        Self { column: columns + self.column, pattern: patterns + self.pattern, ..self }
    }
}

/// The columns that act in a frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Acting {
    /// Patterns: a value a pixel, each.
    pub patterns: Vec<Vec<f64>>,
    /// What columns have of them, one column after the other.
    pub shares: Vec<Share>,
}

impl Acting {
    /// One more pattern, and its number.
    pub fn pattern(&mut self, values: Vec<f64>) -> usize {
        self.patterns.push(values);
        self.patterns.len() - 1
    }

    /// A column, after those that there are, of which a pattern has the values.
    pub fn column(&mut self, column: usize, values: Vec<f64>) {
        let pattern = self.pattern(values);
        self.share(column, pattern, 1.0);
    }

    /// A column that has a share of a pattern, the last one or a further one: columns come in their order.
    pub fn share(&mut self, column: usize, pattern: usize, factor: f64) {
        self.shares.push(Share { column, pattern, factor });
    }
}
