//! The columns of all ways in which candidates may be there.

use super::evidence::Block;
use super::fit::Fit;
use super::pieces::{Candidate, Piece};

/// What a pass tries.
pub struct Tried {
    /// Pieces, each number of them a column.
    pub pieces: Vec<Piece>,
    /// One way each in which a candidate may be there.
    pub blocks: Vec<Block>,
    /// Of each column its candidate, and the number of the parameter; none of those that are fitted already, which come first.
    pub parameters: Vec<(usize, usize)>,
}

impl Tried {
    /// All of the `candidates` that are not fitted in `base`. What two ways of a candidate have in common is one column.
    pub fn beside(base: &Fit, candidates: &[Candidate]) -> Self {
        let fitted = vec![(usize::MAX, 0); base.columns.len()];
        let mut tried = Self { pieces: Vec::new(), blocks: Vec::new(), parameters: fitted };
        let is_fitted = |of: &Candidate| base.pieces.iter().any(|piece| piece.effect.name == of.effect.name);
        for (number, candidate) in candidates.iter().enumerate().filter(|(_, of)| !is_fitted(of)) {
            let mut own = Vec::new();
            for (variant, of) in candidate.variants.iter().enumerate() {
                let columns =
                    of.pieces.iter().flat_map(|piece| tried.columns(number, piece, &mut own)).collect();
                let variants = candidate.looked * of.rarity;
                tried.blocks.push(Block { candidate: number, variant, variants, columns });
            }
        }
        tried
    }

    /// The columns of a `piece` of the candidate `number`, which has its `own` ones already: pieces, parameters, and their columns.
    fn columns<'a>(
        &mut self,
        number: usize,
        piece: &'a Piece,
        own: &mut Vec<(&'a Piece, usize, usize)>,
    ) -> Vec<usize> {
        let known = |parameter: usize| {
            let mut of = own.iter().filter(|(other, number, _)| *number == parameter && other.acts_as(piece));
            of.next().map(|&(.., column)| column)
        };
        let columns: Vec<(usize, Option<usize>)> =
            piece.free.iter().map(|&parameter| (parameter, known(parameter))).collect();
        let is_new = |&(parameter, column): &(usize, Option<usize>)| column.is_none().then_some(parameter);
        let free: Vec<usize> = columns.iter().filter_map(is_new).collect();
        if !free.is_empty() {
            self.pieces.push(Piece { free, ..piece.clone() });
        }
        let column = |(parameter, known): (usize, Option<usize>)| {
            known.unwrap_or_else(|| {
                let column = self.parameters.len();
                self.parameters.push((number, parameter));
                own.push((piece, parameter, column));
                column
            })
        };
        columns.into_iter().map(column).collect()
    }
}
