//! What the states of doors and devices are called.

use super::said::Said;

/// What a state is called, and the orders that bring it about.
pub(super) const STATES: [(&[&str], &str, &str); 6] = [
    (&["closed", "shut", "закрыт", "закрыта", "закрыто", "закрыты"], "закрой", "close"),
    (&["open", "opened", "открыт", "открыта", "открыто", "открыты"], "открой", "open"),
    (&["locked", "заперт", "заперта", "заперты", "заперто"], "запри", "lock"),
    (&["unlocked", "отперт", "отперта", "отперты"], "отопри", "unlock"),
    (
        &[
            "on",
            "switched on",
            "turned on",
            "включен",
            "включена",
            "включено",
            "включены",
            "горит",
            "горел",
            "горела",
            "горели",
            "работал",
        ],
        "включи",
        "switch on",
    ),
    (
        &[
            "off",
            "switched off",
            "turned off",
            "выключен",
            "выключена",
            "выключено",
            "выключены",
            "погашен",
            "погашена",
            "не горит",
            "не горел",
            "не горела",
        ],
        "выключи",
        "switch off",
    ),
];

/// How many words at one are a state: "switched on".
pub(super) fn state_at(said: &Said, at: usize) -> Option<usize> {
    STATES.iter().filter_map(|(called, ..)| said.phrase(at, called)).max()
}
