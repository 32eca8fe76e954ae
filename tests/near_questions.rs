//! What is offered where a question is not understood: in its own words, answered by the map, and by a yes as if it had been
//! asked.

use orthoframe::engine::{Dialogue, Memory, Outcome};

use crate::chatter::golden;
use crate::talk::engine;

/// Words that nothing knows, around a question.
const NOISE: [(&str, &str); 2] = [
    ("Blorp fnord zibble: ", ", ozwick trundlewise"),
    ("Бырк шлындра пумкает: ", ", зюмбель трындвал"),
];

#[test]
#[expect(clippy::print_stdout, reason = "how many are offered is worth seeing")]
fn the_question_within_noise_is_offered_and_answered_by_a_yes() {
    for (case, (before, behind)) in ["rb2-en", "rb2-ru"].into_iter().zip(NOISE) {
        let mut engine = engine("maps/rb2.toml").expect("part of the crate");
        let yes = if case == "rb2-en" { "yes" } else { "да" };
        let (mut asked, mut offered, mut wrong) = (0, 0, Vec::new());
        for question in golden(case).iter().step_by(9) {
            let Ok(plain) = engine.ask(question, &mut Memory::default()).unwrap() else { continue };
            let noisy = format!("{before}{}{behind}?", question.trim_end_matches(['?', '.', '!']));
            let mut dialogue = Dialogue::default().keeping_nothing();
            let heard = dialogue.hear(&mut engine, &noisy, &mut |_, _| {}).unwrap();
            let [reply] = &heard.replies[..] else { continue };
            let Outcome::Unanswered(unanswered) = &reply.outcome else { continue };
            asked += 1;
            let [only] = &unanswered.offers[..] else { continue };
            offered += 1;
            let asked_so =
                engine.ask(only, &mut Memory::default()).unwrap().expect("it has an answer");
            let agreed = dialogue.hear(&mut engine, yes, &mut |_, _| {}).unwrap().text();
            if agreed != asked_so.text {
                wrong.push(format!("{noisy}: {only}: {agreed}, but {}", asked_so.text));
            }
            if asked_so.symbols != plain.symbols {
                println!("{noisy} → {only}");
            }
        }
        println!("{case}: {offered} of {asked} that were not understood are offered");
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        assert!(offered * 3 > asked, "{case}: {offered} of {asked}");
    }
}
