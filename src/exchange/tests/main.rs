//! Importers and exporters by what they give, in one program.

mod assemble;
mod input;
mod notation;
mod procthor;
mod report;
mod synonyms;
