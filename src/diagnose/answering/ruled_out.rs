//! What is not asserted, and what speaks against it.

use super::answer::{RuledOut, rounded};
use crate::diagnose::judging::conclusion::Verdict;
use crate::diagnose::judging::judge::Judgement;
use crate::diagnose::naming::alone::Alone;

/// Every other candidate, and what speaks against it; what comes nearest first. A share is that of all that is explained, or that stands out.
pub fn ruled_out(judgement: &Judgement) -> Vec<RuledOut> {
    let Judgement { found, named, verdict, .. } = judgement;
    let best = found.alone.iter().map(|alone| alone.chi2).fold(0.0, f64::max);
    let explained = found.baseline.counted() - judgement.fit.counted();
    let places = judgement.places.iter().map(|place| place.chi2.0);
    let all = places.fold(best.max(explained), f64::max).max(1.0);
    let others = found.alone.iter().filter(|alone| {
        !named
            .iter()
            .any(|named| named.name == alone.name || named.rivals.iter().any(|rival| rival == alone.name))
    });
    let mut rows: Vec<RuledOut> = others
        .filter(|alone| !found.invisible.contains(&alone.name))
        .map(|&Alone { name, chi2, degrees, ln_bayes }| {
            let share = if *verdict == Verdict::Clean || ln_bayes < 0.0 { 0.0 } else { chi2 / all };
            let plural = if degrees == 1 { "" } else { "s" };
            let refused = judgement.refused.iter().find(|refused| refused.name == name);
            let by = match (refused, share > 0.0) {
                (Some(refused), _) => refused.why.clone(),
                (None, false) => format!("no trace: chi squared {chi2:.1} for {degrees} number{plural}"),
                (None, true) => {
                    format!("alone it takes {:.0} % of it, and leaves the rest", (100.0 * share).floor())
                }
            };
            RuledOut { name, by, share: rounded(share), is_refused: refused.is_some() }
        })
        .collect();
    rows.sort_by(|one, other| other.share.total_cmp(&one.share));
    rows
}
