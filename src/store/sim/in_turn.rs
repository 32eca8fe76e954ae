//! Two programs that write one store in turn, and what becomes of it when calls fail and the power goes.

use super::*;
use crate::vault::Meanwhile;

/// Whether it is taken up, with all that was acknowledged.
fn is_taken_up(run: &mut Run, vault: &mut Vault) -> bool {
    let is_sound = run.disk.inner().fails_in.is_none();
    let found = match vault.take_up() {
        Ok(Meanwhile::Apart) => run.open().map(|(anew, _)| *vault = anew),
        found => found.map(|_| ()),
    };
    if found.is_ok() && vault.read_only().is_none() {
        run.check(vault, run.acknowledged);
        return true;
    }
    assert!(!is_sound || vault.read_only().is_some(), "a sound store is taken up: {found:?}");
    false
}

/// What others wrote is known, where nothing failed before: a `head` that could not be written tells of less.
fn follows(run: &mut Run, vault: &mut Vault, fails: bool) {
    let is_sound = run.disk.inner().fails_in.is_none();
    let found = match vault.follow() {
        Ok(Meanwhile::Apart) => {
            let disk = Arc::new(run.disk.clone());
            let read = Vault::open_read_only(disk, dir(), &run.shelf);
            read.map(|(anew, _)| *vault = anew.in_place_of(vault))
        }
        found => found.map(|_| ()),
    };
    assert!(found.is_ok() || !is_sound, "a sound store is followed: {found:?}");
    let lsn = vault.lsn();
    assert!(
        fails || lsn == run.acknowledged,
        "{} was acknowledged, {lsn} is there",
        run.acknowledged
    );
    if is_sound {
        let now = content(vault).expect("the disk is sound");
        assert_eq!(now, run.past[lsn as usize], "the content after transaction {lsn}");
    }
}

fn in_turn(seed: u64, fails: bool) {
    let mut run = Run::new(seed);
    for _ in 0..3 {
        let mut vaults = Vec::new();
        for _ in 0..2 {
            let (mut vault, _) = run.open().expect("one fault at a time is mended");
            run.check(&vault, run.acknowledged);
            vault.put_down(&mut run.shelf);
            vaults.push(vault);
        }
        if fails {
            let mut inner = run.disk.inner();
            inner.fails_in = Some(run.dice.roll(150));
            inner.stays_broken = run.dice.roll(2) == 0;
        }
        for _ in 0..run.dice.roll(16) {
            let vault = &mut vaults[run.dice.roll(2)];
            if run.dice.roll(4) == 0 {
                follows(&mut run, vault, fails);
                continue;
            }
            if vault.is_put_down() {
                assert!(vault.commit(Vec::new()).is_err(), "the other may be writing");
            }
            if is_taken_up(&mut run, vault) {
                let count = run.dice.roll(5);
                run.work(vault, count);
            }
            vault.put_down(&mut run.shelf);
        }
        if run.dice.roll(2) == 0 && is_taken_up(&mut run, &mut vaults[0]) {
            run.work(&mut vaults[0], 3);
        }
        drop(vaults);
        run.disk.inner().fails_in = None;
        if run.dice.roll(3) > 0 {
            run.crash();
        }
    }
    let (vault, _) = run.open().expect("one fault at a time is mended");
    run.check(&vault, run.acknowledged);
}

#[test]
fn nothing_acknowledged_is_lost_between_two_that_write_in_turn() {
    seeds(2000, |seed| in_turn(seed, false));
}

#[test]
fn nothing_acknowledged_is_lost_in_turn_when_any_call_fails() {
    seeds(2000, |seed| in_turn(seed, true));
}
