//! The architecture, asserted by reading the source: which module sees which, and what is absent on purpose.
//!
//! Every check is a function from sources to violations, so that beside each test on `src/` another one feeds it a snippet
//! that breaks the rule, and sees it caught. Comments, the contents of strings, and what is `#[cfg(test)]` are not code.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

type Edges<'a> = [(&'a str, &'a str)];

/// Which module may see which others. An edge that is not here is refused, and so is one here that nobody needs.
const EDGES: &Edges = &[
    ("main", "cli"),
    (
        "cli",
        "algorithms artifact bench challenge cosim diagnose frames hdl import model package paper physics problem proof ranging recording reference report spec \
         study sweep synthesis units",
    ),
    ("challenge", "frames problem recording study time_domain"),
    ("time_domain", "frames recording units"),
    ("study", "bench diagnose frames physics problem recording"),
    ("package", "artifact hdl report spec units"),
    ("report", "algorithms bench diagnose frames hdl paper physics problem spec sweep synthesis units"),
    ("algorithms", "problem spec units"),
    ("bench", "fields frames physics problem recording spec units"),
    ("paper", "algorithms frames physics problem units"),
    ("diagnose", "bench frames physics problem recording spec units widest"),
    ("import", "frames problem recording"),
    ("ranging", "problem recording reference units"),
    ("proof", "artifact cosim frames hdl problem spec"),
    ("sweep", "model physics problem spec units"),
    ("synthesis", "artifact cosim hdl problem spec"),
    ("cosim", "artifact frames hdl model problem spec"),
    ("hdl", "artifact frames model spec units"),
    ("physics", "frames problem spec units widest"),
    ("recording", "fields frames problem spec units"),
    ("model", "frames spec"),
    ("reference", "frames problem spec units"),
    ("spec", "fields frames problem units"),
    ("frames", ""),
    ("units", ""),
    ("widest", ""),
    ("artifact", "problem"),
    ("fields", "problem"),
    ("problem", ""),
];

/// Which room of the diagnosis may see which others. A room sees those of the lines below its own; where it sees one of a line above, both see each other.
const ROOMS: &Edges = &[
    (
        "answering",
        "judging unseen naming forms set_aside locating shared_errors periodic fitting tangents reading statistics",
    ),
    ("judging", "unseen naming forms locating shared_errors periodic fitting tangents reading statistics"),
    ("unseen", "shared_errors fitting tangents reading"),
    ("naming", "forms shared_errors periodic fitting tangents reading statistics"),
    ("forms", "judging naming shared_errors periodic fitting tangents reading statistics"),
    ("set_aside", "locating periodic fitting tangents reading statistics"),
    ("locating", "shared_errors periodic fitting tangents reading statistics"),
    ("shared_errors", "locating periodic fitting tangents reading statistics"),
    ("periodic", "fitting tangents reading statistics"),
    ("fitting", "shared_errors periodic tangents reading statistics"),
    ("tangents", "reading"),
    ("reading", "shared_errors fitting"),
    ("statistics", ""),
];

/// The direction of the design: a module sees those of its own line and of the lines below.
const LAYERS: &[&str] = &[
    "main",
    "cli",
    "challenge package proof report study",
    "diagnose ranging",
    "bench import paper sweep synthesis time_domain",
    "cosim hdl physics recording",
    "algorithms model reference",
    "spec frames units widest",
    "artifact fields",
    "problem",
];

/// Who must not reach whom, not even through others.
const STRANGERS: &[(&str, &str)] = &[
    ("model", "physics"),
    ("physics", "model"),
    ("hdl", "physics"),
    ("time_domain", "physics"),
    ("time_domain", "bench"),
    ("time_domain", "diagnose"),
    ("time_domain", "study"),
    ("physics", "time_domain"),
    ("bench", "time_domain"),
    ("diagnose", "time_domain"),
    ("study", "time_domain"),
];

/// The sentences of the crate's docs on what is absent, each of them checked below.
const ABSENT: &[&str] = &[
    "**No floating point in [`model`]**, no I/O, nothing that can fail. Constants come from [`spec::exact`].",
    "**[`model`] and [`physics`] never see each other**: they meet in frames. [`hdl`] never sees [`physics`].",
    "**[`time_domain`] and the code that it examines never see each other**: [`physics`], [`bench`](mod@bench), [`diagnose`] and [`study`].",
    "**Only [`cli`], [`recording`], [`import`], [`artifact`], [`cosim`], [`proof`], [`synthesis`] and the reading of a \
     specification touch files or processes**; only [`cli`] knows clap, only [`hdl`], [`package`] and [`report`] may know askama.",
];

const MOST_LINES: usize = 400;

// ---------------------------------------------------------------- sources

/// A file of Rust.
struct Source {
    /// From the repository, such as `src/model/cordic.rs`.
    path: String,
    text: String,
    /// The text with everything blanked that is not code; every byte that is left stands where it stood.
    code: String,
}

impl Source {
    fn new(path: &str, text: &str) -> Self {
        Self { path: path.to_owned(), text: text.to_owned(), code: without_tests(&code_of(text)) }
    }

    /// The module that the file is, from the crate's root; `main` for the program, nothing for the root itself.
    fn module(&self) -> Vec<&str> {
        let path = self.path.trim_start_matches("src/").trim_end_matches(".rs").trim_end_matches("/mod");
        if path == "lib" { Vec::new() } else { path.split('/').collect() }
    }

    fn is_in(&self, module: &str) -> bool {
        self.module().join("/") == module || self.path.starts_with(&format!("src/{module}/"))
    }

    /// `file:line: what`, as editors understand it.
    fn at(&self, position: usize, what: impl std::fmt::Display) -> String {
        let line = self.text[..position].matches('\n').count() + 1;
        format!("{}:{line}: {what}", self.path)
    }

    /// Identifiers, keywords and numbers of the code, with their positions.
    fn words(&self) -> Vec<(usize, &str)> {
        let (mut words, mut start) = (Vec::new(), None);
        for (position, byte) in self.code.bytes().chain([b' ']).enumerate() {
            match start {
                None if is_word(byte) => start = Some(position),
                Some(from) if !is_word(byte) => {
                    words.push((from, &self.code[from..position]));
                    start = None;
                }
                _ => {}
            }
        }
        words
    }

    /// Every path that begins with `root`, braces expanded: `use std::{fs, io::Read}` gives `std::fs` and
    /// `std::io::Read`.
    fn paths(&self, root: &str) -> Vec<(usize, Vec<&str>)> {
        let mut found = Vec::new();
        for (position, word) in self.words() {
            let before = self.code[..position].trim_end();
            if word == root && !before.ends_with("::") && !before.ends_with('.') {
                let mut cursor = position;
                self.path_tree(&mut cursor, &[], &mut found);
            }
        }
        found
    }

    /// Reads the path at `cursor`, which continues `prefix`.
    fn path_tree<'a>(
        &'a self,
        cursor: &mut usize,
        prefix: &[&'a str],
        found: &mut Vec<(usize, Vec<&'a str>)>,
    ) {
        let skip_space = |cursor: &mut usize| {
            *cursor += self.code[*cursor..].len() - self.code[*cursor..].trim_start().len();
        };
        skip_space(cursor);
        if self.code[*cursor..].starts_with('{') {
            while !self.code[*cursor..].starts_with('}') && *cursor + 1 < self.code.len() {
                *cursor += 1;
                skip_space(cursor);
                if !self.code[*cursor..].starts_with('}') {
                    self.path_tree(cursor, prefix, found);
                    // What may stand here is `as name`.
                    let rest = &self.code[*cursor..];
                    *cursor += rest.find([',', '}']).unwrap_or(rest.len() - 1);
                }
            }
            *cursor += 1;
            return;
        }
        let start = *cursor;
        let end = self.code[start..].bytes().position(|byte| !is_word(byte) && byte != b'*');
        let end = end.map_or(self.code.len(), |length| start + length);
        let mut path = prefix.to_vec();
        path.push(&self.code[start..end]);
        *cursor = end;
        skip_space(cursor);
        if self.code[*cursor..].starts_with("::") {
            *cursor += 2;
            self.path_tree(cursor, &path, found);
        } else {
            found.push((start, path));
        }
    }

    /// Paths into this crate that the file names, from the crate's root.
    fn absolute(&self) -> Vec<(usize, Vec<&str>)> {
        let mut found = Vec::new();
        for root in ["crate", "super", "vuris"] {
            for (position, path) in self.paths(root) {
                let mut absolute = if root == "super" { self.module() } else { Vec::new() };
                let mut rest = &path[..];
                while let Some((&first, others)) = rest.split_first() {
                    match first {
                        "super" => drop(absolute.pop()),
                        "crate" | "vuris" => {}
                        _ => break,
                    }
                    rest = others;
                }
                absolute.extend(rest);
                // `pub(crate)` and `pub(super)` are no paths.
                if path.len() > 1 {
                    found.push((position, absolute));
                }
            }
        }
        found
    }

    /// Top-level modules of this crate that the file names.
    fn sees(&self) -> Vec<(usize, String)> {
        let first = |path: Vec<&str>| path.first().copied().unwrap_or("").to_owned();
        self.absolute().into_iter().map(|(position, path)| (position, first(path))).collect()
    }

    /// The room of the module `parent` in which the file is, and the rooms of it that it names.
    fn rooms(&self, parent: &str) -> Option<(String, Vec<(usize, String)>)> {
        let of = |path: &[&str]| match path {
            [first, room, _, ..] if *first == parent => Some(room.to_string()),
            _ => None,
        };
        let own = of(&self.module())?;
        let seen = self.absolute().into_iter().filter_map(|(position, path)| Some((position, of(&path)?)));
        Some((own, seen.collect()))
    }
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// `text` with comments, and the contents of strings and characters, blanked.
fn code_of(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut code = bytes.to_vec();
    let blank = |code: &mut Vec<u8>, from: usize, to: usize| {
        for byte in &mut code[from..to.min(bytes.len())] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
    };
    // Where `pattern` next ends, from `from` on.
    let after = |from: usize, pattern: &str| {
        text.get(from..)
            .and_then(|rest| rest.find(pattern))
            .map_or(bytes.len(), |at| from + at + pattern.len())
    };
    // Where a string or character that is open at `from` ends: behind its closing `quote`.
    let closed = |mut from: usize, quote: u8| {
        while from < bytes.len() && bytes[from] != quote {
            from += if bytes[from] == b'\\' { 2 } else { 1 };
        }
        from + 1
    };
    let mut at = 0;
    while at < bytes.len() {
        let rest = &bytes[at..];
        let within_word = at > 0 && is_word(bytes[at - 1]);
        let hashes = rest.iter().skip(1).take_while(|&&byte| byte == b'#').count();
        at = if rest.starts_with(b"//") {
            let end = after(at, "\n");
            blank(&mut code, at, end);
            end
        } else if rest.starts_with(b"/*") {
            let (mut end, mut depth) = (at + 2, 1);
            while depth > 0 && end < bytes.len() {
                let (open, close) = (after(end, "/*"), after(end, "*/"));
                depth = if open < close { depth + 1 } else { depth - 1 };
                end = open.min(close);
            }
            blank(&mut code, at, end);
            end
        } else if rest[0] == b'r' && !within_word && rest.get(1 + hashes) == Some(&b'"') {
            let end = after(at + 2 + hashes, &format!("\"{}", "#".repeat(hashes)));
            blank(&mut code, at + 2 + hashes, end - 1 - hashes);
            end
        } else if rest[0] == b'"' {
            let end = closed(at + 1, b'"');
            blank(&mut code, at + 1, end - 1);
            end
        } else if rest[0] == b'\'' {
            // A lifetime has no closing quote behind its first character.
            let character = text[at + 1..].chars().next().map_or(1, char::len_utf8);
            if rest.get(1) == Some(&b'\\') || rest.get(1 + character) == Some(&b'\'') {
                let end = closed(at + 1, b'\'');
                blank(&mut code, at + 1, end - 1);
                end
            } else {
                at + 1
            }
        } else {
            at + 1
        };
    }
    String::from_utf8(code).unwrap()
}

/// `code` with every item blanked that is only compiled for tests.
fn without_tests(code: &str) -> String {
    let mut code = code.to_owned();
    while let Some(start) = code.find("#[cfg(test)]") {
        let mut depth = 0;
        let mut end = code.len();
        for (at, byte) in code.bytes().enumerate().skip(start) {
            match byte {
                b'{' => depth += 1,
                b'}' => depth -= 1,
                _ => {}
            }
            if depth == 0 && (byte == b'}' || byte == b';') {
                end = at + 1;
                break;
            }
        }
        let blank: String =
            code[start..end].bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' }).collect();
        code.replace_range(start..end, &blank);
    }
    code
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The text files below `folder` of the repository, by path.
fn files(folder: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(root().join(folder)).unwrap() {
        let entry = entry.unwrap();
        let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.file_type().unwrap().is_dir() {
            found.extend(files(&path));
        } else {
            found.push((path, fs::read_to_string(entry.path()).unwrap()));
        }
    }
    found.sort();
    found
}

/// The program's sources; files that are only compiled for tests have no code.
fn sources() -> Vec<Source> {
    let files = files("src");
    let texts: Vec<(String, String)> =
        files.iter().map(|(path, text)| (path.clone(), code_of(text))).collect();
    let mut sources = Vec::new();
    for (path, text) in files.iter().filter(|(path, _)| path.ends_with(".rs")) {
        let mut source = Source::new(path, text);
        let module = source.module();
        let (name, parent) = module.split_last().map_or(("", &[][..]), |(name, parent)| (*name, parent));
        let declared = format!("#[cfg(test)]\nmod {name};");
        let parents = [format!("src/{}/mod.rs", parent.join("/")), "src/lib.rs".to_owned()];
        if texts.iter().any(|(path, code)| parents.contains(path) && code.contains(&declared)) {
            source.code = " ".repeat(source.code.len());
        }
        sources.push(source);
    }
    assert!(sources.len() > 40, "only {} sources found", sources.len());
    sources
}

fn assert_none(violations: Vec<String>) {
    assert!(violations.is_empty(), "{}", violations.join("\n"));
}

/// Asserts that `violations` is one, at `place` and saying `what`.
fn assert_caught(violations: Vec<String>, place: &str, what: &str) {
    assert_eq!(violations.len(), 1, "{place} {what}: {violations:?}");
    assert!(
        violations[0].starts_with(place) && violations[0].contains(what),
        "{place} {what}: {violations:?}"
    );
}

fn snippet(path: &str, text: &str) -> Vec<Source> {
    vec![Source::new(path, text)]
}

// ---------------------------------------------------------------- what is code

#[test]
fn comments_strings_and_tests_are_not_code() {
    let text = "/* a /* b */ c */ fn f<'a>(x: &'a str) -> char { '\\'' } // d\nlet s = \"e \\\" f\"; let r = r#\"g\"h\"#;\n\
                let q = '\"'; let é = 1;\n#[cfg(test)]\nmod tests {\n  fn i() { { } }\n}\nfn j() {}\n#[cfg(test)]\nmod k;\nfn l() {}\n";
    let source = Source::new("src/x.rs", text);
    assert_eq!(source.code.len(), text.len());
    for gone in [" a ", " b ", " c ", " d", "e ", " f\"", "g", "h\"", "tests", "fn i", "mod k"] {
        assert!(!source.code.contains(gone), "{gone:?} is left:\n{}", source.code);
    }
    for kept in [
        "fn f<'a>(x: &'a str) -> char { '",
        "let s = \"",
        "let r = r#\"",
        "let é = 1;",
        "fn j() {}",
        "fn l() {}",
    ] {
        assert!(source.code.contains(kept), "{kept:?} is gone:\n{}", source.code);
        assert_eq!(source.code.find(kept), text.find(kept));
    }
}

#[test]
fn paths_are_read_through_braces_and_supers() {
    let text = "use crate::{a::{self, B, c::D as E}, f};\nuse super::super::g::H;\nfn i(_: super::J, _: crate::k::L<M>) {}\n\
                pub(crate) fn n() { crate::o::<P>(); }\nuse super::*;";
    let source = Source::new("src/x/y.rs", text);
    let seen: Vec<String> = source.sees().into_iter().map(|(_, module)| module).collect();
    assert_eq!(seen, ["a", "a", "a", "f", "k", "o", "g", "x", "x"]);
    let paths = Source::new("src/x.rs", "use std::{fs, io::{self, Read}};\nlet a = b.std;");
    let paths: Vec<String> = paths.paths("std").into_iter().map(|(_, path)| path.join("::")).collect();
    assert_eq!(paths, ["std::fs", "std::io::self", "std::io::Read"]);
}

// ---------------------------------------------------------------- who sees whom

/// The names of a list that is separated by spaces.
fn names(list: &str) -> impl Iterator<Item = &str> {
    list.split_whitespace()
}

/// A file with the name of what it is part of, and what it sees of the same kind.
type Sight<'a> = (&'a Source, String, Vec<(usize, String)>);

/// Files as parts of top-level modules.
fn of_modules(sources: &[Source]) -> Vec<Sight<'_>> {
    let own = |source: &Source| Some(source.module().first()?.to_string());
    sources.iter().filter_map(|source| Some((source, own(source)?, source.sees()))).collect()
}

/// Files as parts of the rooms of the module `parent`.
fn of_rooms<'a>(parent: &str, sources: &'a [Source]) -> Vec<Sight<'a>> {
    let sight = |source: &'a Source| source.rooms(parent).map(|(own, seen)| (source, own, seen));
    sources.iter().filter_map(sight).collect()
}

fn outside(edges: &Edges, sights: &[Sight]) -> Vec<String> {
    let mut violations = Vec::new();
    for (source, own, seen) in sights {
        let Some((_, allowed)) = edges.iter().find(|(from, _)| from == own) else {
            violations.push(source.at(0, format_args!("the module {own} is not in the table")));
            continue;
        };
        for (position, other) in seen {
            if other != own && !names(allowed).any(|name| name == other) {
                violations.push(source.at(*position, format_args!("{own} sees {other}")));
            }
        }
    }
    violations
}

fn edges_outside(edges: &Edges, sources: &[Source]) -> Vec<String> {
    outside(edges, &of_modules(sources))
}

fn unused(edges: &Edges, sights: &[Sight]) -> Vec<String> {
    let used: BTreeSet<(&str, &str)> = sights
        .iter()
        .flat_map(|(_, own, seen)| seen.iter().map(move |(_, other)| (own.as_str(), other.as_str())))
        .collect();
    edges
        .iter()
        .flat_map(|(from, tos)| names(tos).map(move |to| (*from, to)))
        .filter(|edge| !used.contains(edge))
        .map(|(from, to)| format!("{from} does not see {to}: take it out of the table"))
        .collect()
}

fn unused_edges(edges: &Edges, sources: &[Source]) -> Vec<String> {
    unused(edges, &of_modules(sources))
}

/// Everything that `from` reaches.
fn reach<'a>(edges: &Edges<'a>, from: &'a str) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(module) = open.pop() {
        for &(_, tos) in edges.iter().filter(|(own, _)| *own == module) {
            open.extend(names(tos).filter(|to| reached.insert(*to)));
        }
    }
    reached
}

/// What the table itself must not allow.
fn wrong_directions(edges: &Edges) -> Vec<String> {
    let layer = |module: &str| LAYERS.iter().position(|modules| names(modules).any(|name| name == module));
    let mut violations = Vec::new();
    for (from, tos) in edges {
        for to in names(tos) {
            match (layer(from), layer(to)) {
                (Some(above), Some(below)) if above <= below => {}
                (Some(_), Some(_)) => {
                    violations.push(format!("{from} sees {to}: against the direction of the design"))
                }
                _ => violations.push(format!("{from} sees {to}: not both have a layer")),
            }
        }
        if reach(edges, from).contains(from) {
            violations.push(format!("{from} reaches itself"));
        }
    }
    for (one, other) in STRANGERS {
        if reach(edges, one).contains(other) {
            violations.push(format!("{one} reaches {other}"));
        }
    }
    violations
}

#[test]
fn every_module_sees_only_those_that_the_table_allows() {
    assert_none(edges_outside(EDGES, &sources()));
}

#[test]
fn every_room_of_the_diagnosis_sees_only_those_that_its_table_allows() {
    let sources = sources();
    assert_none(outside(ROOMS, &of_rooms("diagnose", &sources)));
    assert_none(unused(ROOMS, &of_rooms("diagnose", &sources)));
    for text in ["\nuse crate::diagnose::naming::pass;", "\nuse super::super::naming::{pass::DISBELIEF};"] {
        let sources = snippet("src/diagnose/statistics/median.rs", text);
        let violations = outside(ROOMS, &of_rooms("diagnose", &sources));
        assert_caught(violations, "src/diagnose/statistics/median.rs:2:", "statistics sees naming");
    }
    let own = snippet("src/diagnose/statistics/median.rs", "use super::evidence::of_variance;");
    assert_none(outside(ROOMS, &of_rooms("diagnose", &own)));
    let new = snippet("src/diagnose/novelty/median.rs", "");
    assert_caught(outside(ROOMS, &of_rooms("diagnose", &new)), "src/diagnose/novelty/", "not in the table");
    assert_eq!(unused(&[("statistics", "naming")], &of_rooms("diagnose", &own)).len(), 1);
}

#[test]
fn the_table_of_modules_holds_no_edge_that_nobody_needs() {
    assert_none(unused_edges(EDGES, &sources()));
}

#[test]
fn the_table_of_modules_points_one_way_and_keeps_strangers_apart() {
    assert_none(wrong_directions(EDGES));
}

#[test]
fn a_forbidden_edge_is_caught_in_every_spelling() {
    for text in [
        "\nuse crate::physics::Scene;",
        "\nuse crate::{spec::Pipeline, physics::{Scene, Sensor as Physics}};",
        "\nfn f() { super::super::physics::simulate() }",
        "\nfn f(_: &crate::physics::Scene) {}",
        "\nuse crate::physics;",
    ] {
        let mut violations = edges_outside(EDGES, &snippet("src/model/cordic.rs", text));
        violations.dedup();
        assert_caught(violations, "src/model/cordic.rs:2:", "model sees physics");
    }
    let physics = snippet("src/physics/scene.rs", "use crate::model::pixel;");
    assert_caught(edges_outside(EDGES, &physics), "src/physics/scene.rs:1:", "physics sees model");
    let hdl = snippet("src/hdl/golden.rs", "use crate::physics::Scene;");
    assert_caught(edges_outside(EDGES, &hdl), "src/hdl/golden.rs:1:", "hdl sees physics");
    let all = snippet("src/units.rs", "use crate::*;");
    assert_caught(edges_outside(EDGES, &all), "src/units.rs:1:", "units sees *");
    let new = snippet("src/novelty.rs", "");
    assert_caught(edges_outside(EDGES, &new), "src/novelty.rs:1:", "not in the table");
    let main = snippet("src/main.rs", "use vuris::spec::Pipeline;");
    assert_caught(edges_outside(EDGES, &main), "src/main.rs:1:", "main sees spec");
    assert_none(edges_outside(
        EDGES,
        &snippet("src/model/mod.rs", "//! crate::physics\nuse crate::spec::Word;"),
    ));
}

#[test]
fn a_table_that_is_unused_upside_down_or_round_is_caught() {
    let model = snippet("src/model/mod.rs", "use crate::spec::Word;");
    assert_caught(unused_edges(&[("model", "frames spec")], &model), "model does not see frames", "");
    assert_caught(wrong_directions(&[("spec", "model")]), "spec sees model", "against the direction");
    assert_caught(wrong_directions(&[("spec", "novelty")]), "spec sees novelty", "layer");
    assert_eq!(wrong_directions(&[("spec", "units"), ("units", "spec")]).len(), 2);
    let through = wrong_directions(&[("hdl", "recording"), ("recording", "physics")]);
    assert_caught(through, "hdl reaches physics", "");
}

// ---------------------------------------------------------------- what is absent

/// Uses of the paths `std::…` and crates in `roots`, outside the modules `allowed`.
fn uses_outside(roots: &[&str], allowed: &[&str], sources: &[Source]) -> Vec<String> {
    let mut violations = Vec::new();
    for source in sources.iter().filter(|source| !allowed.iter().any(|module| source.is_in(module))) {
        for root in roots {
            let parts: Vec<&str> = root.split("::").collect();
            let paths = source.paths(parts[0]);
            let hits = paths.into_iter().filter(|(_, path)| {
                path.starts_with(&parts)
                    || path.get(parts.len() - 1) == Some(&"*") && path.len() == parts.len()
            });
            violations.extend(hits.map(|(position, path)| source.at(position, path.join("::"))));
        }
    }
    violations
}

/// Words of the code in `modules` that are among `forbidden`.
fn words_in(modules: &[&str], forbidden: &dyn Fn(&str) -> bool, sources: &[Source]) -> Vec<String> {
    let mut violations = Vec::new();
    for source in sources.iter().filter(|source| modules.iter().any(|module| source.is_in(module))) {
        let hits = source.words().into_iter().filter(|(_, word)| forbidden(word));
        violations.extend(hits.map(|(position, word)| source.at(position, word)));
    }
    violations
}

/// Floating-point types and literals in the model.
fn floats_in_model(sources: &[Source]) -> Vec<String> {
    let is_float = |word: &str| {
        let number = word.starts_with(|c: char| c.is_ascii_digit());
        let radix = ["0x", "0b", "0o"].iter().any(|prefix| word.starts_with(prefix));
        ["f32", "f64"].contains(&word)
            || number
                && !radix
                && (word.contains(['e', 'E']) || word.ends_with("f32") || word.ends_with("f64"))
    };
    let mut violations = words_in(&["model"], &is_float, sources);
    for source in sources.iter().filter(|source| source.is_in("model")) {
        let code = source.code.as_bytes();
        for (position, word) in source.words() {
            let end = position + word.len();
            let point = code.get(end) == Some(&b'.') && code.get(end + 1) != Some(&b'.');
            let field = position > 0 && code[position - 1] == b'.';
            let method = code.get(end + 1).is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_');
            if word.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_')
                && word.starts_with(|c: char| c.is_ascii_digit())
                && point
                && !field
                && !method
            {
                violations.push(source.at(position, format_args!("the literal {word}.…")));
            }
        }
    }
    violations
}

/// Input, output, and whatever can fail, in the model.
fn effects_in_model(sources: &[Source]) -> Vec<String> {
    const WORDS: &[&str] = &[
        "print",
        "println",
        "eprint",
        "eprintln",
        "dbg",
        "write",
        "writeln",
        "File",
        "Result",
        "Err",
        "panic",
        "assert",
        "assert_eq",
        "assert_ne",
        "unreachable",
        "unwrap",
        "expect",
        "unsafe",
        "static",
    ];
    let outside_model: Vec<&str> =
        EDGES.iter().map(|(module, _)| *module).filter(|m| *m != "model").collect();
    let mut violations = words_in(&["model"], &|word| WORDS.contains(&word), sources);
    let roots = ["std::fs", "std::io", "std::process", "std::env", "std::net", "std::time", "std::thread"];
    violations.extend(uses_outside(&roots, &outside_model, sources));
    violations
}

/// Files and processes outside the modules that may touch them. The program itself only has an exit code.
fn files_and_processes(sources: &[Source]) -> Vec<String> {
    const ALLOWED: &[&str] =
        &["cli", "recording", "import", "artifact", "cosim", "proof", "synthesis", "spec/file"];
    const METHODS: &[&str] = &[
        "exists",
        "try_exists",
        "is_file",
        "is_dir",
        "is_symlink",
        "canonicalize",
        "read_dir",
        "read_link",
        "metadata",
        "symlink_metadata",
    ];
    let mut violations = uses_outside(&["std::fs", "std::process", "tempfile"], ALLOWED, sources);
    violations
        .retain(|violation| !(violation.starts_with("src/main.rs:") && violation.ends_with("::ExitCode")));
    for source in sources.iter().filter(|source| !ALLOWED.iter().any(|module| source.is_in(module))) {
        let method = |&(position, word): &(usize, &str)| {
            METHODS.contains(&word)
                && source.code[..position].ends_with('.')
                && source.code[position + word.len()..].starts_with("()")
        };
        let hits = source.words().into_iter().filter(method);
        violations.extend(hits.map(|(position, word)| source.at(position, word)));
    }
    violations
}

fn command_line_outside_cli(sources: &[Source]) -> Vec<String> {
    uses_outside(&["clap"], &["cli", "main"], sources)
}

fn templates_outside_hdl_and_report(sources: &[Source]) -> Vec<String> {
    uses_outside(&["askama"], &["hdl", "package", "report"], sources)
}

#[test]
fn the_model_has_no_floating_point() {
    assert_none(floats_in_model(&sources()));
}

#[test]
fn floating_point_in_the_model_is_caught() {
    for (code, what) in [
        ("x as f64", "f64"),
        ("let x: f32;", "f32"),
        ("1.5", "1"),
        ("let x = 2. ;", "2"),
        ("1e5", "1e5"),
        ("1_000f64", "1_000f64"),
    ] {
        let text = format!("//! no f64\nfn f() {{ {code} }}");
        assert_caught(floats_in_model(&snippet("src/model/phase.rs", &text)), "src/model/phase.rs:2:", what);
        assert_none(floats_in_model(&snippet("src/spec/derived.rs", &text)));
    }
    let integers = "fn f() { for i in 0..16 { a.0.b + 0x1e5 + 1_000i64 + pair.1 .0 + 7.pow(2) } }\n\
                    #[cfg(test)]\nmod tests { fn g() -> f64 { 1.0 } }";
    assert_none(floats_in_model(&snippet("src/model/phase.rs", integers)));
}

#[test]
fn the_model_has_no_input_or_output_and_nothing_that_can_fail() {
    assert_none(effects_in_model(&sources()));
}

#[test]
fn input_output_and_failure_in_the_model_are_caught() {
    for (code, what) in [
        ("use std::fs;", "std::fs"),
        ("use std::{fmt, io};", "std::io"),
        ("use std::*;", "std::*"),
        ("fn f() { std::process::abort() }", "std::process::abort"),
        ("fn f() { println!(\"1\") }", "println"),
        ("fn f() -> Result<i64, ()> { g() }", "Result"),
        ("fn f() { a.unwrap() }", "unwrap"),
        ("fn f() { assert!(a) }", "assert"),
    ] {
        let mut violations = effects_in_model(&snippet("src/model/offset.rs", &format!("\n{code}")));
        violations.dedup();
        assert_caught(violations, "src/model/offset.rs:2:", what);
    }
    assert_none(effects_in_model(&snippet(
        "src/model/offset.rs",
        "use std::fmt; fn f() { debug_assert!(a) }",
    )));
}

#[test]
fn only_the_named_modules_touch_files_and_processes() {
    assert_none(files_and_processes(&sources()));
}

#[test]
fn files_and_processes_elsewhere_are_caught() {
    for (path, code, what) in [
        ("src/hdl/mod.rs", "fn f() { std::fs::read(p) }", "std::fs::read"),
        ("src/spec/mod.rs", "use std::fs::File;", "std::fs::File"),
        ("src/report/svg.rs", "use std::process::Command;", "std::process::Command"),
        ("src/physics/mod.rs", "use std::{fmt, process};", "std::process"),
        ("src/ranging.rs", "fn f() { tempfile::tempdir() }", "tempfile::tempdir"),
        ("src/reference.rs", "fn f(p: &Path) -> bool { p.exists() }", "exists"),
        ("src/main.rs", "use std::process::Command;", "std::process::Command"),
    ] {
        assert_caught(files_and_processes(&snippet(path, code)), path, what);
    }
    for path in [
        "src/cli/scene.rs",
        "src/recording/npy.rs",
        "src/artifact.rs",
        "src/cosim/run.rs",
        "src/synthesis/flow.rs",
        "src/spec/file.rs",
    ] {
        assert_none(files_and_processes(&snippet(path, "use std::{fs, process::Command};")));
    }
    assert_none(files_and_processes(&snippet("src/main.rs", "use std::process::ExitCode;")));
}

#[test]
fn only_the_command_line_knows_clap_and_only_verilog_and_reports_know_askama() {
    assert_none(command_line_outside_cli(&sources()));
    assert_none(templates_outside_hdl_and_report(&sources()));
}

#[test]
fn clap_and_askama_elsewhere_are_caught() {
    let clap = snippet("src/recording/matching.rs", "#[derive(clap::ValueEnum)]\nenum Choice {}");
    assert_caught(command_line_outside_cli(&clap), "src/recording/matching.rs:1:", "clap::ValueEnum");
    assert_none(command_line_outside_cli(&snippet("src/cli/mod.rs", "use clap::Parser;")));
    let askama = snippet("src/model/mod.rs", "use askama::{Template};");
    assert_caught(templates_outside_hdl_and_report(&askama), "src/model/mod.rs:1:", "askama::Template");
    assert_none(templates_outside_hdl_and_report(&snippet("src/report/page.rs", "use askama::Template;")));
}

// ---------------------------------------------------------------- files and their names

fn unwieldy(sources: &[Source]) -> Vec<String> {
    let mut violations = Vec::new();
    for source in sources {
        let lines = source.text.lines().count();
        if lines > MOST_LINES {
            violations.push(source.at(0, format_args!("{lines} lines, {MOST_LINES} are allowed")));
        }
        if source
            .module()
            .iter()
            .any(|name| ["util", "utils", "helper", "helpers", "misc", "common"].contains(name))
        {
            violations.push(source.at(0, "a name that says nothing"));
        }
    }
    violations
}

/// Files of the model and templates of the hardware that have no counterpart.
fn nouns_apart(model: &[&str], templates: &[&str]) -> Vec<String> {
    // The model's own: its list of files, and the stream that drives it.
    const ONLY_MODEL: &[&str] = &["mod", "poly", "stream"];
    // Parts of the angle unit, which the model has in one file; registers that only time; memories; a file's first lines.
    const ONLY_HARDWARE: &[&str] = &[
        "angle_iterative",
        "angle_poly",
        "banner",
        "cordic_folded",
        "cordic_unrolled",
        "delay",
        "normaliser",
        "phase",
        "phase_memory",
        "poly_arctangent",
        "poly_multiplier",
        "poly_octant",
        "poly_reciprocal",
        "stream_register",
        "sum_memory",
    ];
    let apart = |ones: &[&str], others: &[&str], alone: &[&str], what: &str| -> Vec<String> {
        let missing = ones.iter().filter(|noun| !others.contains(noun) && !alone.contains(noun));
        missing.map(|noun| format!("{noun}: {what}")).collect()
    };
    let mut violations = apart(model, templates, ONLY_MODEL, "in the model, without a template");
    violations.extend(apart(templates, model, ONLY_HARDWARE, "a template, without a model"));
    violations
}

#[test]
fn source_files_are_short_and_named_after_what_they_hold() {
    assert_none(unwieldy(&sources()));
}

#[test]
fn long_and_vaguely_named_files_are_caught() {
    let long = "\n".repeat(MOST_LINES + 1);
    assert_caught(unwieldy(&snippet("src/spec/word.rs", &long)), "src/spec/word.rs:1:", "401 lines");
    assert_none(unwieldy(&snippet("src/spec/word.rs", &long[1..])));
    for path in ["src/utils.rs", "src/hdl/helpers.rs", "src/misc/mod.rs"] {
        assert_caught(unwieldy(&snippet(path, "")), path, "says nothing");
    }
}

#[test]
fn model_and_templates_have_the_same_nouns() {
    let nouns = |folder: &str| -> Vec<String> {
        let path = |(path, _): (String, String)| path.rsplit('/').next().unwrap_or("").to_owned();
        files(folder)
            .into_iter()
            .map(path)
            .map(|name| name.split('.').next().unwrap_or("").to_owned())
            .collect()
    };
    let (model, templates) = (nouns("src/model"), nouns("hdl-templates"));
    assert!(model.len() > 5 && templates.len() > 5);
    let of = |nouns: &'_ [String]| -> Vec<&'static str> {
        nouns.iter().map(|noun| &*Box::leak(noun.clone().into_boxed_str())).collect()
    };
    assert_none(nouns_apart(&of(&model), &of(&templates)));
}

#[test]
fn a_noun_on_one_side_only_is_caught() {
    assert_none(nouns_apart(&["mod", "stream", "cordic"], &["cordic", "banner", "delay"]));
    assert_caught(nouns_apart(&["cordic", "sorter"], &["cordic"]), "sorter:", "without a template");
    assert_caught(nouns_apart(&["cordic"], &["cordic", "divider"]), "divider:", "without a model");
}

// ---------------------------------------------------------------- nothing unfinished

/// Notes to oneself, and macros that stand for what is not written.
fn unfinished(sources: &[Source]) -> Vec<String> {
    let mut violations = Vec::new();
    for source in sources {
        for (number, line) in (1..).zip(source.text.lines()) {
            let mut words = line.split(|c: char| !c.is_alphanumeric() && c != '_');
            if let Some(word) = words.find(|word| ["TODO", "FIXME", "XXX", "HACK"].contains(word)) {
                violations.push(format!("{}:{number}: {word}", source.path));
            }
        }
        for (position, word) in source.words() {
            let called = source.code[position + word.len()..].starts_with('!');
            if called && ["todo", "unimplemented", "dbg"].contains(&word) {
                violations.push(source.at(position, format_args!("{word}!")));
            }
        }
    }
    violations
}

/// `unwrap()`, and `expect` without a sentence that says why it cannot fail.
fn unexplained(sources: &[Source]) -> Vec<String> {
    let mut violations = Vec::new();
    for source in sources {
        for (position, word) in source.words() {
            let end = position + word.len();
            if !source.code[..position].trim_end().ends_with('.') {
                continue;
            }
            match word {
                "unwrap" | "unwrap_err" if source.code[end..].starts_with('(') => {
                    violations.push(source.at(position, format_args!("{word}()")));
                }
                "expect" | "expect_err" => {
                    let argument = source.text[end..].trim_start_matches('(').trim_start();
                    let why =
                        argument.strip_prefix('"').and_then(|rest| rest.split('"').next()).unwrap_or("");
                    if why.split_whitespace().count() < 3 {
                        violations.push(
                            source.at(position, format_args!("{word} does not say why it cannot fail")),
                        );
                    }
                }
                _ => {}
            }
        }
    }
    violations
}

#[test]
fn nothing_is_left_unfinished() {
    let mut all = sources();
    for (path, text) in ["hdl-templates", "package-templates", "tb"].into_iter().flat_map(files) {
        all.push(Source { path, code: String::new(), text });
    }
    assert_none(unfinished(&all));
}

#[test]
fn what_is_unfinished_is_caught() {
    for (code, what) in [
        ("// TODO later", "TODO"),
        ("/// FIXME: wrong", "FIXME"),
        ("fn f() { todo!() }", "todo!"),
        ("fn f() { unimplemented!(\"no\") }", "unimplemented!"),
    ] {
        assert_caught(unfinished(&snippet("src/units.rs", &format!("\n{code}"))), "src/units.rs:2:", what);
    }
    assert_none(unfinished(&snippet("src/units.rs", "let mastodon = TODOS; // todo")));
}

#[test]
fn whatever_cannot_fail_says_why() {
    assert_none(unexplained(&sources()));
}

#[test]
fn an_unexplained_unwrap_is_caught() {
    for (code, what) in [
        ("a.unwrap();", "unwrap()"),
        ("a\n  .unwrap();", "unwrap()"),
        ("a.unwrap_err();", "unwrap_err()"),
        ("a.expect(\"\");", "expect"),
        ("a.expect(why);", "expect"),
        ("a.expect(\"never fails\");", "expect"),
    ] {
        assert_caught(unexplained(&snippet("src/units.rs", code)), "src/units.rs:", what);
    }
    let good = "a.unwrap_or(1); a.expect(\"every probe names a vector\");\n#[cfg(test)]\nmod tests { fn f() { a.unwrap() } }\n\
                /// b.unwrap()\nfn unwrap() {}";
    assert_none(unexplained(&snippet("src/units.rs", good)));
}

// ---------------------------------------------------------------- the crate's docs

/// The crate's docs, without the comment marks.
fn docs(lib: &str) -> String {
    lib.lines().filter_map(|line| line.strip_prefix("//!")).map(|line| format!("{}\n", line.trim())).collect()
}

/// Sentences on what is absent that are not the checked ones, and modules that the map leaves out or invents.
fn docs_apart(lib: &str) -> Vec<String> {
    let docs = docs(lib);
    let section = docs.split("# What is absent on purpose").nth(1).unwrap_or("");
    let paragraph = section.trim().split("\n\n").next().unwrap_or("").replace('\n', " ");
    let stated: Vec<String> = format!(" {paragraph}")
        .split(" - ")
        .map(|item| item.trim().to_owned())
        .filter(|i| !i.is_empty())
        .collect();
    let mut violations = Vec::new();
    for sentence in stated.iter().filter(|sentence| !ABSENT.contains(&sentence.as_str())) {
        violations.push(format!("stated, not checked: {sentence}"));
    }
    for sentence in ABSENT.iter().filter(|sentence| !stated.iter().any(|item| item == *sentence)) {
        violations.push(format!("checked, not stated: {sentence}"));
    }
    let declared: BTreeSet<&str> = lib
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ").or(line.strip_prefix("mod "))?.strip_suffix(';'))
        .collect();
    let mapped: BTreeSet<&str> = docs
        .lines()
        .filter(|line| line.starts_with("| ["))
        .filter_map(|line| line.split('|').nth(1))
        .flat_map(|cell| cell.split('`').skip(1).step_by(2))
        .collect();
    violations.extend(
        declared
            .symmetric_difference(&mapped)
            .map(|module| format!("{module}: in the map or the crate only")),
    );
    violations
}

#[test]
fn the_crates_docs_state_what_is_checked_here_and_map_every_module() {
    let lib = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    assert_none(docs_apart(&lib));
    let declared = lib.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    for module in declared {
        assert!(EDGES.iter().any(|(own, _)| *own == module), "{module} is not in the table");
    }
}

#[test]
fn docs_that_say_more_or_less_are_caught() {
    let lib = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let more = lib.replacen(
        "//! `tests/architecture.rs`",
        "//! - **No colours.**\n//!\n//! `tests/architecture.rs`",
        1,
    );
    let more = more.replacen("askama.\n//!\n", "askama.\n", 1);
    assert_caught(docs_apart(&more), "stated, not checked", "No colours");
    let less: String =
        lib.lines().filter(|line| !line.contains("they meet in frames")).map(|l| format!("{l}\n")).collect();
    assert_caught(docs_apart(&less), "checked, not stated", "they meet in frames");
    assert_caught(docs_apart(&format!("{lib}\npub mod novelty;")), "novelty", "in the map or the crate only");
}
