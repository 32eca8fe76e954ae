//! A vehicle written in Python: it speaks the vehicle protocol (docs/vehicle.md) with the mission over two channels of this
//! process, on a thread of its own, so that what it says is checked and what it keeps silent about is noticed.

use std::io::{Read, Write};
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::desk::GLANCE;

/// Lines that may wait to be heard; who says more waits.
const WAITING: usize = 64;

/// The vehicle's end of the conversation; `orthoframe.Vehicle` holds it.
#[pyclass(frozen)]
#[derive(Debug)]
pub(crate) struct Link {
    orders: Mutex<Receiver<String>>,
    said: SyncSender<String>,
}

/// What the mission reads.
#[derive(Debug)]
pub(crate) struct Hears {
    from: Receiver<String>,
    rest: Vec<u8>,
}

/// What the mission writes to.
#[derive(Debug)]
pub(crate) struct Orders {
    to: Sender<String>,
    line: Vec<u8>,
}

/// A vehicle's end and the mission's two.
pub(crate) fn link() -> (Link, Hears, Orders) {
    let ((to, orders), (said, from)) = (channel(), sync_channel(WAITING));
    let link = Link { orders: Mutex::new(orders), said };
    (link, Hears { from, rest: Vec::new() }, Orders { to, line: Vec::new() })
}

impl Read for Hears {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        if self.rest.is_empty() {
            match self.from.recv() {
                Ok(line) => self.rest = line.into_bytes(),
                Err(_gone) => return Ok(0),
            }
        }
        let taken = self.rest.len().min(into.len());
        into[..taken].copy_from_slice(&self.rest[..taken]);
        self.rest.drain(..taken);
        Ok(taken)
    }
}

impl Write for Orders {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.line.extend_from_slice(bytes);
        while let Some(end) = self.line.iter().position(|byte| *byte == b'\n') {
            let line = self.line.drain(..=end).collect::<Vec<u8>>();
            let line = String::from_utf8_lossy(&line).into_owned();
            self.to.send(line).map_err(|_gone| std::io::ErrorKind::BrokenPipe)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[pymethods]
impl Link {
    /// The next order, a line of JSON. An empty text where none came for so many seconds, for ever without a number; None
    /// when the mission is over.
    #[pyo3(signature = (timeout=None))]
    fn receive(&self, py: Python<'_>, timeout: Option<f64>) -> PyResult<Option<String>> {
        let until = timeout
            .and_then(|seconds| Duration::try_from_secs_f64(seconds.max(0.0)).ok())
            .and_then(|whole| Instant::now().checked_add(whole));
        loop {
            let got = py.detach(|| {
                let left = until.map_or(GLANCE, |until| {
                    until.saturating_duration_since(Instant::now()).min(GLANCE)
                });
                let orders = self.orders.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                orders.recv_timeout(left)
            });
            match got {
                Ok(line) => return Ok(Some(line)),
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            }
            if until.is_some_and(|until| Instant::now() >= until) {
                return Ok(Some(String::new()));
            }
        }
    }

    /// Says a line of JSON; false when the mission is over.
    fn send(&self, py: Python<'_>, line: String) -> bool {
        py.detach(|| self.said.send(line + "\n").is_ok())
    }
}
