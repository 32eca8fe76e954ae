//! The one object a program holds.
