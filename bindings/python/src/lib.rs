//! orthoframe in Python: the [`Engine`](engine::Engine) as a class, what it answers as dicts, errors as exceptions.
//!
//! **Invariants.** The interpreter is let go for whatever may take time, and nothing of Python's is held meanwhile. A
//! panic is an exception; an engine that panicked while it wrote is used no more. By hand nothing here is `unsafe`.

mod arrays;
mod desk;
mod dialogue;
mod dict;
mod engine;
mod task;
mod vehicle;

use pyo3::pymodule;

/// What `orthoframe/__init__.py` is made of.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::dialogue::Dialogue;
    #[pymodule_export]
    use super::engine::Engine;
    #[pymodule_export]
    use super::task::Task;
    #[pymodule_export]
    use super::vehicle::Link;
}
