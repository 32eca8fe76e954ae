//! Whole capabilities, one module each; a single binary links faster than one a file.

mod planning;
//! Tests of whole capabilities, one binary.

mod words;
