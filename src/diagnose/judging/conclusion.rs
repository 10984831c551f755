//! The verdict in a word, from what is named and what is left.

use crate::diagnose::naming::found::{Named, are_many};
use crate::diagnose::naming::pass::DISBELIEF;
use crate::diagnose::naming::tolerated::form_share;

/// The verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Simulation and recordings agree.
    Clean,
    /// The named effects bring the fit to the noise.
    Explained,
    /// Something named, something left.
    PartlyExplained,
    /// A mismatch, and nothing known that makes it.
    Unexplained,
}

/// What the verdict depends on.
pub struct Case<'a> {
    /// Effects that the search found and that stand.
    pub named: &'a [Named],
    /// Whether some did not stand.
    pub are_dropped: bool,
    /// Random effects that are named beside them, and whether one explains what is left.
    pub at_random: (usize, bool),
    /// Whether a coordinate is a simpler answer than the names.
    pub are_outvoted: bool,
    /// Whether something is there that looks like an effect and is not.
    pub is_misnamed: bool,
    /// Whether the fit is far from the baseline.
    pub is_far: bool,
    /// Of the mismatch, the share that is left; 0 where nothing stands out.
    pub remainder: f64,
    /// Whether what is left leads in the coordinate in which the mismatch led.
    pub stays: bool,
    /// In the coordinate in which most is left, the share of what it showed of the mismatch that is left.
    pub left_there: f64,
    /// Whether the camera is described.
    pub is_described: bool,
}

impl Case<'_> {
    /// The verdict.
    pub fn verdict(&self) -> Verdict {
        let is_random = self.at_random.1;
        let names = self.names();
        let is_known = names > 0 && !self.is_misnamed;
        let may_leave = form_share(self.named);
        // What is left by a form that is not believed to be better than that is so in every coordinate alike.
        // Far from the baseline a coordinate shows less than there is, and of an undescribed camera a part of several things.
        let is_comparable = self.is_described && !self.is_far;
        let is_more_there = is_comparable && self.left_there >= may_leave;
        let is_of_form = self.remainder < may_leave / DISBELIEF || !is_more_there;
        let leaves_little = self.remainder < may_leave && is_of_form && !(self.stays && names > 2);
        // A simulation of which nothing is described leaves out several things at once: what explains most of them is worth its name. Of one that is described, what
        // leaves more than its form may is something else: of thirteen such answers to campaigns of two independent generators not one had the right names. Beside
        // random errors what is left is not known that well, and beside something that looks like an effect and is not, something must be left.
        let knows_rest = !self.is_misnamed && !is_random;
        let most_left = match (self.is_described, knows_rest) {
            (true, true) => 0.0,
            (true, false) => 0.1,
            (false, _) => 0.5,
        };
        if self.are_outvoted || self.are_many() {
            Verdict::Unexplained
        } else if self.remainder == 0.0 {
            if names == 0 { Verdict::Clean } else { Verdict::Explained }
        } else if is_known && (leaves_little || is_random && self.named.is_empty()) {
            Verdict::Explained
        } else if names == 0 || self.remainder > most_left || self.are_dropped || self.is_far || self.stays {
            Verdict::Unexplained
        } else {
            Verdict::PartlyExplained
        }
    }

    /// How many names there are, those of random effects among them.
    fn names(&self) -> usize {
        self.named.len() + self.at_random.0
    }

    /// Whether they are more than were left out.
    fn are_many(&self) -> bool {
        are_many(self.is_described, self.names())
    }

    /// What speaks against all names, in words, where none is asserted.
    pub fn against(&self) -> String {
        let names = self.names();
        match (self.are_outvoted, self.are_many()) {
            (true, _) => "a coordinate alone says as much, with fewer assumptions".to_owned(),
            (false, true) => {
                format!("one of {names} effects at once, which is how something unknown is taken apart")
            }
            (false, false) => {
                let with = if names > 1 { "with the others that were found the fit" } else { "its fit" };
                format!(
                    "{with} leaves {:.1} % of the mismatch, more than its form may",
                    100.0 * self.remainder
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &'static str, chi2: f64) -> Named {
        Named { name, ln_bayes: 0.0, score: (chi2, 1), rivals: Vec::new(), is_trusted: false }
    }

    fn case(named: &[Named], remainder: f64) -> Case<'_> {
        Case {
            named,
            are_dropped: false,
            at_random: (0, false),
            are_outvoted: false,
            is_misnamed: false,
            is_far: false,
            remainder,
            stays: false,
            left_there: 0.0,
            is_described: true,
        }
    }

    #[test]
    fn what_is_left_decides() {
        // A form of one per cent may leave three.
        let one = [named("phase_step_scale", 1000.0)];
        let verdict = |remainder| case(&one, remainder).verdict();
        assert_eq!([0.0, 0.02].map(verdict), [Verdict::Explained; 2]);
        assert_eq!([0.04, 0.2].map(verdict), [Verdict::Unexplained; 2]);
        let two = [named("phase_step_scale", 1000.0), named("phase_drift", 500.0)];
        assert_eq!(case(&two, 0.1).verdict(), Verdict::Unexplained);
        // Of an undescribed camera half may be left.
        for some in [&one[..], &two[..]] {
            let undescribed = |remainder| Case { is_described: false, ..case(some, remainder) }.verdict();
            assert_eq!([0.4, 0.6].map(undescribed), [Verdict::PartlyExplained, Verdict::Unexplained]);
        }
        // Nothing is named.
        assert_eq!(case(&[], 0.0).verdict(), Verdict::Clean);
        assert_eq!(case(&[], 0.9).verdict(), Verdict::Unexplained);
    }

    #[test]
    fn a_weak_loose_form_does_not_excuse_what_an_exact_one_leaves() {
        // The forms of scatter may leave 24 %, of a scale of steps 3 %.
        let weak = [named("phase_step_scale", 1000.0), named("lens_scatter", 50.0)];
        assert_eq!(case(&weak, 0.1).verdict(), Verdict::Unexplained);
        let strong = [named("phase_step_scale", 50.0), named("lens_scatter", 1000.0)];
        assert_eq!(case(&strong, 0.1).verdict(), Verdict::Explained);
    }

    #[test]
    fn names_that_are_not_believed_are_none() {
        let one = [named("phase_step_scale", 1000.0)];
        let verdict = |change: fn(&mut Case), remainder| {
            let mut case = case(&one, remainder);
            change(&mut case);
            case.verdict()
        };
        // A coordinate says as much, whatever is left.
        assert_eq!(verdict(|case| case.are_outvoted = true, 0.0), Verdict::Unexplained);
        // What is left is more than the form may leave.
        for change in [
            |case: &mut Case| case.are_dropped = true,
            |case: &mut Case| case.is_far = true,
            |case: &mut Case| case.stays = true,
        ] {
            assert_eq!(verdict(change, 0.05), Verdict::Unexplained);
            assert_eq!(verdict(change, 0.02), Verdict::Explained);
        }
        assert_eq!(verdict(|case| case.is_misnamed = true, 0.02), Verdict::PartlyExplained);
        // Nor are more than three, random ones among them, where the camera is described.
        assert_eq!(verdict(|case| case.at_random = (2, true), 0.0), Verdict::Explained);
        assert_eq!(verdict(|case| case.at_random = (3, true), 0.0), Verdict::Unexplained);
        let undescribed = |case: &mut Case| (case.at_random, case.is_described) = ((3, true), false);
        assert_eq!(verdict(undescribed, 0.0), Verdict::Explained);
        // Three names must not leave anything where the mismatch led.
        let three = ["phase_step_scale", "phase_drift", "lens_scatter"].map(|name| named(name, 1000.0));
        assert_eq!(case(&three, 0.02).verdict(), Verdict::Explained);
        assert_eq!(Case { stays: true, ..case(&three, 0.02) }.verdict(), Verdict::Unexplained);
    }

    #[test]
    fn a_form_leaves_no_more_in_one_coordinate_than_in_all() {
        // The form of a phase by amplitude may leave 24 %; half of what the columns showed is left by columns.
        let one = [named("intensity_related_phase", 500.0)];
        let verdict = |remainder, left_there| Case { left_there, ..case(&one, remainder) }.verdict();
        assert_eq!(verdict(0.2, 0.2), Verdict::Explained);
        assert_eq!(verdict(0.2, 0.5), Verdict::Unexplained);
        for change in [|case: &mut Case| case.is_far = true, |case: &mut Case| case.is_described = false] {
            let mut case = Case { left_there: 0.5, ..case(&one, 0.2) };
            change(&mut case);
            assert_eq!(case.verdict(), Verdict::Explained);
        }
        // Of next to nothing that is left it does not matter where.
        assert_eq!(verdict(0.07, 0.5), Verdict::Explained);
    }

    #[test]
    fn a_random_effect_explains_what_is_left_where_it_is_the_only_name() {
        let at_random = |named, is_random| Case { at_random: (1, is_random), ..case(named, 0.05) };
        assert_eq!(at_random(&[], true).verdict(), Verdict::Explained);
        assert_eq!(at_random(&[], false).verdict(), Verdict::Unexplained);
        assert_eq!(Case { is_misnamed: true, ..at_random(&[], true) }.verdict(), Verdict::PartlyExplained);
        let one = [named("phase_step_scale", 1000.0)];
        assert_eq!(at_random(&one, true).verdict(), Verdict::PartlyExplained);
    }
}
