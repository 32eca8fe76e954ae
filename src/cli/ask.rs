//! `ortho ask`: one question, one answer.

use crate::engine::{Dialogue, Event};

use super::args::{AskArgs, Common};
use super::fault::Failure;
use super::opened::open;
use super::teller::{Onlookers, Teller};
use super::{Answer, heeded};

pub(super) fn run(common: &Common, args: &AskArgs) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let mut dialogue = Dialogue::new(common.lang.language());
    let mut teller = Teller::of_dialogue(common, Onlookers::default());
    teller.explains = args.explain;
    let reply = dialogue.ask(&engine, &args.question)?;
    teller.tell(&engine, &Event::Replied(&reply));
    teller.end()?;
    Ok(heeded(&reply.outcome))
}
