//! `ortho`: the command line of orthoframe.

fn main() {}
