//! Relations against worlds that others made: precision and recall per relation and data set.
//!
//! `cargo run --release --example relation_truth -- ../shared/data [--disagreements]`

#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

mod truth;

use std::error::Error;
use std::path::PathBuf;

use truth::{Comparison, procthor, virtualhome};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let is_option = |a: &&String| a.starts_with("--");
    if let Some(unknown) = arguments.iter().filter(is_option).find(|a| *a != "--disagreements") {
        return Err(format!("unknown option {unknown}; there is --disagreements").into());
    }
    let data = arguments.iter().find(|a| !a.starts_with("--"));
    let data = data.map_or_else(|| PathBuf::from("../shared/data"), PathBuf::from);
    let disagreements = arguments.iter().any(|a| a == "--disagreements");
    println!(
        "{:<12} {:<9} {:<34} {:>6} {:>7} {:>6} {:>6} {:>6}  by",
        "data", "profile", "relation of the data", "truth", "derived", "P", "R", "F"
    );
    for found in [procthor(&data)?, virtualhome(&data)?] {
        for comparison in &found {
            show(comparison, disagreements);
        }
    }
    Ok(())
}

fn show(c: &Comparison, disagreements: bool) {
    let (p, r, f) = (c.precision(), c.recall(), c.f_score());
    let (truth, derived) = (c.both + c.missed.len(), c.both + c.surplus.len());
    println!(
        "{:<12} {:<9} {:<34} {truth:>6} {derived:>7} {p:>6.3} {r:>6.3} {f:>6.3}  {}",
        c.data, c.profile, c.relation, c.by
    );
    if disagreements {
        for pair in &c.missed {
            println!("    missed   {pair}");
        }
        for pair in &c.surplus {
            println!("    surplus  {pair}");
        }
    }
}
