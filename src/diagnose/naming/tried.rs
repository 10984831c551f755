//! The columns of all ways in which candidates may be there.

use super::candidates::Candidate;
use crate::diagnose::statistics::evidence::Block;
use crate::diagnose::tangents::pieces::Piece;

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
    /// All of the `candidates` of which none of the `fitted` pieces is, which have so many columns. What two ways of a candidate have in common is one
    /// column.
    pub fn beside(fitted: &[Piece], fitted_columns: usize, candidates: &[Candidate]) -> Self {
        let parameters = vec![(usize::MAX, 0); fitted_columns];
        let mut tried = Self { pieces: Vec::new(), blocks: Vec::new(), parameters };
        let is_fitted = |of: &Candidate| fitted.iter().any(|piece| piece.effect.name == of.effect.name);
        for (number, candidate) in candidates.iter().enumerate().filter(|(_, of)| !is_fitted(of)) {
            let mut own = Vec::new();
            for (variant, of) in candidate.variants.iter().enumerate() {
                let columns =
                    of.pieces.iter().flat_map(|piece| tried.columns_of(number, piece, &mut own)).collect();
                let variants = candidate.looked * of.rarity;
                tried.blocks.push(Block { candidate: number, variant, variants, columns });
            }
        }
        tried
    }

    /// The columns of a `piece` of the candidate `number`, which has its `own` ones already: pieces, parameters, and their columns.
    fn columns_of<'a>(
        &mut self,
        number: usize,
        piece: &'a Piece,
        own: &mut Vec<(&'a Piece, usize, usize)>,
    ) -> Vec<usize> {
        let known = |parameter: usize| {
            let mut of = own.iter().filter(|(other, number, _)| *number == parameter && other.acts_as(piece));
            of.next().map(|&(.., column)| column)
        };
        let numbers: Vec<(usize, Option<usize>)> =
            piece.free.iter().map(|&parameter| (parameter, known(parameter))).collect();
        let is_new = |&(parameter, column): &(usize, Option<usize>)| column.is_none().then_some(parameter);
        let free: Vec<usize> = numbers.iter().filter_map(is_new).collect();
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
        numbers.into_iter().map(column).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::tangents::pieces::Variant;

    fn candidate(ways: &[&[Piece]]) -> Candidate {
        let variant = |pieces: &&[Piece]| Variant { pieces: pieces.to_vec(), rarity: 1.0 };
        let variants: Vec<Variant> = ways.iter().map(variant).collect();
        Candidate { effect: ways[0][0].effect, looked: 2.0, variants }
    }

    #[test]
    fn ways_share_the_columns_of_what_they_have_in_common() {
        let [all, few, other] = [
            Piece::off("frame_gain", &[0, 1, 2], &[0]),
            Piece::off("frame_gain", &[1, 3], &[0]),
            Piece::off("frame_gain", &[0, 1], &[1]),
        ];
        let gains = candidate(&[&[all.clone(), other.clone()], &[few], &[all]]);
        let drift = candidate(&[&[Piece::off("ambient_drift", &[0], &[0, 1])]]);
        let scale = Piece::off("phase_step_scale", &[0], &[0, 1]);
        let fitted = candidate(&[std::slice::from_ref(&scale)]);
        let tried = Tried::beside(std::slice::from_ref(&scale), 1, &[fitted, gains, drift]);
        let columns: Vec<&[usize]> = tried.blocks.iter().map(|block| &block.columns[..]).collect();
        // The first column is fitted already. Frame 3 is new in the second way, and the same of another recording is another column.
        assert_eq!(columns, [&[1, 2, 3, 4, 5][..], &[2, 6], &[1, 2, 3], &[7]]);
        assert_eq!(tried.parameters[1..], [(1, 0), (1, 1), (1, 2), (1, 0), (1, 1), (1, 3), (2, 0)]);
        let free: Vec<&[usize]> = tried.pieces.iter().map(|piece| &piece.free[..]).collect();
        assert_eq!(free, [&[0, 1, 2][..], &[0, 1], &[3], &[0]]);
    }
}
