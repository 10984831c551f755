//! Is a survivor a fault at all? Yosys proves, where it can, that the instance around the cell computes the same with the mutant as
//! without: its outputs and registers, for all inputs and all states, by induction over [`DEPTH`] clocks.
//!
//! Where that fails, [`outputs`] looks at the module's outputs alone. What only the rest of the core makes harmless (a word that never takes a value, data of a clock in which nothing is valid)
//! is not proved here: it counts against the benches unless it is explained.

use super::netlist::Netlist;
use super::{Mutant, outputs};
use crate::problem::Result;
use crate::proof::yosys::attempt;

/// Clocks of the induction.
pub const DEPTH: u32 = 3;

/// Whether the mutant is proved equivalent.
pub(super) fn proved(netlist: &Netlist, mutant: &Mutant) -> Result<bool> {
    let cells = match mutant.instance() {
        // The top's own cells.
        "" => "c:* c:u_* %d".to_owned(),
        instance => format!("c:{instance}*"),
    };
    // Cells of like shape first become one, which shortens long arithmetic; it also asks that what enters them be the same, which an
    // equivalent mutant need not keep (an OR whose other input is 1): so once more without.
    for shapes in ["equiv_struct -icells\n", ""] {
        if attempt(netlist.folder, &script(netlist, mutant, &cells, shapes))?.0 {
            return Ok(true);
        }
    }
    outputs::proved(netlist, mutant)
}

/// The commands that fail where the `cells` around the mutant are not proved to be what they were.
fn script(netlist: &Netlist, mutant: &Mutant, cells: &str, shapes: &str) -> String {
    // Down to bits and without what nothing reads: a bit that is not used is no difference.
    let bits = "memory_map\nopt_clean\nsimplemap\nsplitnets\nopt_clean -purge\n";
    format!(
        "read_rtlil flat.il\nsubmod -name part {cells}\ndelete {top}\nhierarchy -top part\ndesign -save part\n\
         {bits}rename part gold\ndesign -stash gold\n\
         design -load part\n{mutation}{bits}rename part gate\ndesign -stash gate\n\
         design -copy-from gold -as gold gold\ndesign -copy-from gate -as gate gate\n\
         equiv_make gold gate equiv\nhierarchy -top equiv\nopt_expr\nopt_merge\n{shapes}\
         equiv_simple -seq 1\nequiv_induct -seq {DEPTH}\nequiv_status -assert\n",
        top = netlist.top,
        mutation = mutant.command("part", ""),
    )
}
