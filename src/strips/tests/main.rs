//! Texts of rules and the tasks that become of them, in one program.

mod conditions;
mod durative;
mod pddl;
mod slips;
mod texts;
mod wishes;
