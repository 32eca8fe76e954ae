//! What a bad line makes of a robot's frames.

use std::path::Path;

use orthoframe_fleet::FleetError;
use orthoframe_fleet::push::Line;
use orthoframe_store::shipping::{Following, frames_after};

/// Sends what the centre lacks, badly: batches twice, backwards, a later one first.
pub fn push_badly(line: &Line, store: &Path, rng: &mut fastrand::Rng) -> Result<i64, FleetError> {
    let mut at = line.position()?;
    loop {
        let size = rng.usize(500..60_000);
        let have = u64::try_from(at.sequence).expect("a number");
        let frames = match frames_after(store, have, at.checksum, size)? {
            Following::Frames(frames) if frames.is_empty() => return Ok(at.sequence),
            Following::Frames(frames) => frames,
            Following::Broken => {
                line.push(store)?;
                at = line.position()?;
                continue;
            }
        };
        let mut sent = frames.clone();
        match rng.u32(..5) {
            0 => sent.reverse(),
            1 => sent.extend(frames.clone()),
            2 => rng.shuffle(&mut sent),
            _ => {}
        }
        if rng.u32(..4) == 0 && frames.len() > 2 {
            // One that comes too early is not taken, and what lies between is asked for.
            let early = line.send(&frames[frames.len() - 1..]);
            if let Err(FleetError::Gap { have: told, .. }) = &early {
                assert!(*told >= at.sequence, "what was acknowledged is there");
            } else {
                early?;
            }
        }
        at = line.send(&sent)?;
        if rng.u32(..3) == 0 {
            assert_eq!(line.send(&frames)?, at, "what is there already changes nothing");
        }
    }
}
