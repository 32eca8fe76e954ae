//! A dialogue: whatever a person says, heard against what was said before.

use std::sync::{Arc, Mutex, PoisonError};

use orthoframe::engine::{self, json};
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::desk::Desk;

/// What was said so far, and what waits for an answer. The simulated robot carries out what is ordered.
#[pyclass(frozen)]
#[derive(Debug)]
pub(crate) struct Dialogue {
    pub(crate) desk: Arc<Desk>,
    pub(crate) talk: Mutex<engine::Dialogue>,
}

#[pymethods]
impl Dialogue {
    /// Hears a line, answers it, and does what it orders; a dict for all that came of it, in its order.
    fn hear<'py>(&self, py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let _robot = self.desk.take_robot()?;
            let mut talk = self.talk.lock().unwrap_or_else(PoisonError::into_inner);
            self.desk.write(|engine| {
                let heard = talk.hear(engine, text, &mut |_, _| {})?;
                let mut views = json::heard(engine, &heard)?;
                for (view, reply) in views.iter_mut().zip(&heard.replies) {
                    view["text"] = json!(reply.text);
                    view["language"] = json!(reply.language.pick("ru", "en"));
                }
                Ok(Value::Array(views))
            })
        })
    }
}
