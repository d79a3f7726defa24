//! The order of the modules: imports only look down.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// Every module, the higher ones first; a module may import those after it.
/// Modules on one line do not know each other.
const ORDER: &[&[&str]] = &[
    &["scene"],
    &["world"],
    &["narrow_phase", "early_out", "broad_phase"],
    &["sweep"],
    &["motion"],
    &["sampling", "raycast"],
    &["curve"],
    &["geometry"],
    &["math"],
    &["tolerance"],
];

/// Errors name ids of the world, and every door answers with one of them.
const ANYWHERE: &[&str] = &["error"];

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.ends_with("target") {
            // What a package of its own, such as `benches/peers`, was built into.
        } else if path.is_dir() {
            rust_files(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

fn rank(module: &str) -> Option<usize> {
    ORDER.iter().position(|modules| modules.contains(&module))
}

/// Modules that a line of code names as `crate::module`, also within `{…}`.
fn imports(line: &str) -> Vec<String> {
    let code = line.split("//").next().unwrap_or_default();
    let mut found = Vec::new();
    for rest in code.split("crate::").skip(1) {
        let name = |text: &str| {
            text.chars()
                .take_while(|c| c.is_alphanumeric() || *c == '_')
                .collect::<String>()
        };
        if let Some(list) = rest.strip_prefix('{') {
            found.extend(list.split(',').map(|item| name(item.trim())));
        } else {
            found.push(name(rest));
        }
    }
    found
}

#[test]
fn imports_only_look_down() -> Result<(), Box<dyn Error>> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files)?;
    let (mut checked, mut wrong) = (0, Vec::new());
    for file in &files {
        let place = file.strip_prefix(&source)?;
        let module = place
            .iter()
            .next()
            .and_then(|name| name.to_str())
            .unwrap_or_default();
        let module = module.trim_end_matches(".rs");
        if module == "lib" || ANYWHERE.contains(&module) {
            continue;
        }
        let own = rank(module).ok_or_else(|| format!("{module} has no place in the order"))?;
        for (number, line) in fs::read_to_string(file)?.lines().enumerate() {
            for import in imports(line) {
                let Some(other) = rank(&import) else {
                    continue;
                };
                checked += 1;
                if other < own || (other == own && import != module) {
                    wrong.push(format!("{}:{}: {import}", place.display(), number + 1));
                }
            }
        }
    }
    assert!(
        checked > 50,
        "only {checked} imports were found: does this test still read the code?"
    );
    assert!(
        wrong.is_empty(),
        "imports that look up or aside:\n{}",
        wrong.join("\n")
    );
    Ok(())
}

#[test]
fn no_file_is_longer_than_it_should_be() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["src", "tests", "examples", "benches"] {
        rust_files(&root.join(folder), &mut files)?;
    }
    for file in files {
        let lines = fs::read_to_string(&file)?.lines().count();
        assert!(lines <= 500, "{} has {lines} lines", file.display());
    }
    Ok(())
}

#[test]
fn the_reader_of_imports_sees_them() {
    assert_eq!(imports("use crate::geometry::Shape;"), ["geometry"]);
    assert_eq!(
        imports("use crate::{error::ShapeError, math::domain};"),
        ["error", "math"]
    );
    assert_eq!(
        imports("    let x = crate::world::step(crate::motion::y);"),
        ["world", "motion"]
    );
    assert!(imports("// see crate::world").is_empty());
}
