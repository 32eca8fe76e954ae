//! Tests of whole capabilities, one binary.

mod words;
