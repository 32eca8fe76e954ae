//! Floors of whole buildings, followed and made anew, and ways that keep the law.

mod edited;
mod lawful;
