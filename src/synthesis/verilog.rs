//! What is synthesised: a top module, its clock, and the files that it needs.

use crate::artifact::Artifact;
use crate::problem::{Problem, Result};
use sha2::{Digest, Sha256};

/// Verilog to be synthesised.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verilog {
    top: String,
    clock: String,
    files: Vec<Artifact>,
}

/// Whether a tool's script takes `name` for one plain word.
fn is_plain(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || "_.-".contains(c))
}

impl Verilog {
    /// The module `top` with the clock input `clock`, of `files`: Verilog (`.v`), SystemVerilog (`.sv`), anything else is
    /// data that they read. Folders do not count; two files of one name, and names that a script would misread, are refused.
    pub fn new(top: &str, clock: &str, files: Vec<Artifact>) -> Result<Self> {
        for (what, name) in [("top module", top), ("clock", clock)] {
            if !is_plain(name) || name.contains(['.', '-']) {
                return Err(Problem::at(what, format_args!("`{name}`"))
                    .expected("a Verilog identifier of letters, digits and underscores"));
            }
        }
        let mut plain: Vec<Artifact> = Vec::with_capacity(files.len());
        for Artifact { path, text } in files {
            let name = path.rsplit('/').next().unwrap_or(&path).to_owned();
            if !is_plain(&name) {
                return Err(Problem::at(&path, "has a name that a script would misread")
                    .expected("letters, digits, `_`, `-` and `.`")
                    .remedy("rename the file"));
            }
            if plain.iter().any(|other| other.path == name) {
                return Err(Problem::at(&path, format_args!("is the second file named {name}"))
                    .expected("files whose names differ, since they are copied to one folder")
                    .remedy("rename one of them"));
            }
            plain.push(Artifact { path: name, text });
        }
        if !plain.iter().any(|file| file.path.ends_with(".v") || file.path.ends_with(".sv")) {
            return Err(
                Problem::at(top, "comes without a Verilog file").expected("at least one .v or .sv file")
            );
        }
        Ok(Self { top: top.to_owned(), clock: clock.to_owned(), files: plain })
    }

    /// The top module.
    pub fn top(&self) -> &str {
        &self.top
    }

    /// Its clock input.
    pub fn clock(&self) -> &str {
        &self.clock
    }

    /// Its files, without folders.
    pub fn files(&self) -> &[Artifact] {
        &self.files
    }

    /// Yosys' commands that read the files.
    pub(super) fn reading(&self) -> String {
        let mut script = String::new();
        for Artifact { path, .. } in &self.files {
            match path.rsplit('.').next() {
                Some("v") => script += &format!("read_verilog {path}; "),
                Some("sv") => script += &format!("read_verilog -sv {path}; "),
                _ => {}
            }
        }
        script
    }

    /// SHA-256 of everything that the tools read, in hexadecimal.
    pub fn digest(&self) -> String {
        let parts = self.files.iter().flat_map(|file| [file.path.as_str(), file.text.as_str()]);
        digest([self.top.as_str(), self.clock.as_str()].into_iter().chain(parts))
    }
}

/// SHA-256 of `parts`, each with its length, in hexadecimal.
pub(super) fn digest<'a>(parts: impl IntoIterator<Item = &'a str>) -> String {
    let mut hash = Sha256::new();
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part.as_bytes());
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> Artifact {
        Artifact::new(path, text)
    }

    #[test]
    fn the_digest_changes_with_everything_that_the_tools_read() {
        let verilog = |top, clock, files: &[(&str, &str)]| {
            let files = files.iter().map(|(path, text)| file(path, text)).collect();
            Verilog::new(top, clock, files).unwrap().digest()
        };
        let base = verilog("a", "clk", &[("rtl/a.v", "x"), ("rtl/b.v", "yz")]);
        assert_eq!(base, verilog("a", "clk", &[("elsewhere/a.v", "x"), ("rtl/b.v", "yz")]));
        for other in [
            verilog("b", "clk", &[("rtl/a.v", "x"), ("rtl/b.v", "yz")]),
            verilog("a", "clk_i", &[("rtl/a.v", "x"), ("rtl/b.v", "yz")]),
            verilog("a", "clk", &[("rtl/a.v", "xy"), ("rtl/b.v", "z")]),
            verilog("a", "clk", &[("rtl/b.v", "yz"), ("rtl/a.v", "x")]),
            verilog("a", "clk", &[("rtl/a.v", "x")]),
        ] {
            assert_ne!(base, other);
        }
        // The published digest of "abc" proves the algorithm; the length stands in front of it.
        let abc = Sha256::digest("abc");
        assert_eq!(abc[..4], [0xba, 0x78, 0x16, 0xbf]);
    }

    #[test]
    fn what_a_script_would_misread_is_refused() {
        for (top, clock, path, said) in [
            ("a;b", "clk", "a.v", "top module"),
            ("a", "", "a.v", "clock"),
            ("a", "clk", "a b.v", "misread"),
            ("a", "clk", "-q.v", "misread"),
            ("a", "clk", "a.hex", "without a Verilog file"),
        ] {
            let problem = Verilog::new(top, clock, vec![file(path, "")]).unwrap_err().to_string();
            assert!(problem.contains(said), "{problem}");
        }
        let twice = Verilog::new("a", "clk", vec![file("x/a.v", ""), file("y/a.v", "")]);
        assert!(twice.unwrap_err().to_string().contains("second file named a.v"));
        let read =
            Verilog::new("a", "clk", vec![file("p.sv", ""), file("a.v", ""), file("t.hex", "")]).unwrap();
        assert_eq!(read.reading(), "read_verilog -sv p.sv; read_verilog a.v; ");
    }
}
