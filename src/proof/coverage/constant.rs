//! Bits that are constant by construction: Yosys' optimisation leaves them as constants.

use super::{Kind, Point};
use crate::hdl::{Source, rtl_artifacts};
use crate::problem::{Problem, Result};
use crate::proof::yosys::yosys;
use std::collections::BTreeMap;
use std::path::Path;

/// The constant bits of the core in `folder`/rtl, as a set of points.
pub(super) struct Constants {
    /// By module and signal: for each bit, whether it is constant in every instance.
    bits: BTreeMap<(String, String), Vec<bool>>,
}

impl Constants {
    pub(super) fn contains(&self, point: &Point) -> bool {
        let bits = self.bits.get(&(point.module.clone(), point.signal().to_owned()));
        point.kind == Kind::Toggle && bits.is_some_and(|bits| bits.get(point.bit()).copied().unwrap_or(false))
    }
}

/// Finds them.
pub(super) fn bits(source: &Source, folder: &Path) -> Result<Constants> {
    let artifacts = rtl_artifacts(source);
    let files: Vec<&str> =
        artifacts.iter().map(|file| file.path.as_str()).filter(|path| path.ends_with(".v")).collect();
    let top = source.pipeline.top();
    // Every instance leaves a mark of its module, before the hierarchy goes.
    let mut script =
        format!("read_verilog {}\nhierarchy -check -top {top}\nproc\nopt_clean\n", files.join(" "));
    for file in &files {
        let module = file.trim_start_matches("rtl/").trim_end_matches(".v");
        script += &format!(
            "select {module} $paramod*{module}\\\\* $paramod\\\\{module}\nadd -wire {MARK}{module} 1\nselect -clear\n"
        );
    }
    script += "flatten\nopt -full\nopt_clean\nwrite_json constants.json\n";
    yosys(folder, &script)?;
    let path = folder.join("constants.json");
    let text = std::fs::read_to_string(&path).map_err(|error| Problem::io(&path, "read", &error))?;
    Ok(read(&text))
}

/// Begins the names of the marks.
const MARK: &str = "module_is_";

/// Reads the nets of Yosys' JSON, whose every name and every list of bits is a line of its own.
fn read(json: &str) -> Constants {
    let mut nets: Vec<(&str, Vec<bool>)> = Vec::new();
    let mut name = "";
    for line in json.split("\"netnames\": {").nth(1).unwrap_or("").lines().map(str::trim) {
        if let Some(list) = line.strip_prefix("\"bits\": [") {
            let bits = list.trim_end_matches(',').trim_end_matches(']').split(',').map(str::trim);
            nets.push((name, bits.filter(|bit| !bit.is_empty()).map(|bit| bit.starts_with('"')).collect()));
        } else if let Some(net) = line.strip_prefix('"').and_then(|rest| rest.strip_suffix("\": {")) {
            name = net;
        }
    }
    let split = |net: &'_ str| {
        net.rfind('.')
            .map_or((String::new(), net.to_owned()), |dot| (net[..dot].to_owned(), net[dot + 1..].to_owned()))
    };
    let modules: BTreeMap<String, String> = nets
        .iter()
        .filter_map(|(net, _)| {
            let (instance, wire) = split(net);
            Some((instance, wire.strip_prefix(MARK)?.to_owned()))
        })
        .collect();
    let mut bits: BTreeMap<(String, String), Vec<bool>> = BTreeMap::new();
    for (net, constant) in nets {
        let (instance, wire) = split(net);
        let Some(module) = modules.get(&instance) else { continue };
        bits.entry((module.clone(), wire))
            .and_modify(|all| {
                // Instances of other widths have other bits: those beyond are constant where they are.
                for (bit, constant) in constant.iter().enumerate() {
                    match all.get_mut(bit) {
                        Some(all) => *all &= constant,
                        None => all.push(*constant),
                    }
                }
            })
            .or_insert(constant);
    }
    Constants { bits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bit_is_constant_where_it_is_in_every_instance() {
        let json = "{ \"netnames\": {\n \"u_a.module_is_m\": {\n \"bits\": [ \"x\" ],\n },\n \"u_b.module_is_m\": {\n \
                    \"bits\": [ \"x\" ],\n },\n \"u_a.w\": {\n \"bits\": [ \"0\", 5, \"1\" ],\n },\n \"u_b.w\": {\n \
                    \"bits\": [ \"0\", \"0\", 7 ],\n }\n } }";
        let constants = read(json);
        let point = |bit| Point {
            module: "m".to_owned(),
            kind: Kind::Toggle,
            line: 1,
            what: format!("w[{bit}]:0->1"),
        };
        let found: Vec<bool> = (0..4).map(|bit| constants.contains(&point(bit))).collect();
        assert_eq!(found, [true, false, false, false]);
    }
}
