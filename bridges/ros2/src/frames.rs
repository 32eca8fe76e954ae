//! Where one frame stands in another, by the transforms that were heard.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use crate::messages::TransformStamped;

/// On the plane: metres and radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) yaw: f64,
}

impl Place {
    const ORIGIN: Self = Self { x: 0.0, y: 0.0, yaw: 0.0 };

    /// What stands at `inner` in this frame, in the frame in which this one stands.
    pub(crate) fn then(self, inner: Self) -> Self {
        let (sin, cos) = self.yaw.sin_cos();
        Self {
            x: self.x + cos * inner.x - sin * inner.y,
            y: self.y + sin * inner.x + cos * inner.y,
            yaw: self.yaw + inner.yaw,
        }
    }
}

#[derive(Debug)]
struct Link {
    parent: String,
    place: Place,
    /// When it was heard; none of one that stays.
    heard: Option<Instant>,
}

/// The tree of frames.
#[derive(Debug, Default)]
pub(crate) struct Frames {
    links: BTreeMap<String, Link>,
}

impl Frames {
    pub(crate) fn hear(&mut self, transforms: &[TransformStamped], stays: bool) {
        for told in transforms {
            let at = &told.transform.translation;
            let place = Place { x: at.x, y: at.y, yaw: told.transform.rotation.yaw() };
            if ![place.x, place.y, place.yaw].iter().all(|number| number.is_finite()) {
                continue;
            }
            let heard = (!stays).then(Instant::now);
            let name = |frame: &str| frame.trim_start_matches('/').to_owned();
            let link = Link { parent: name(&told.header.frame_id), place, heard };
            self.links.insert(name(&told.child_frame_id), link);
        }
    }

    /// Where a frame stands in another above it, by what was heard no longer ago than `patience`; else what is missing.
    pub(crate) fn place(
        &self,
        of: &str,
        within: &str,
        patience: Duration,
    ) -> Result<Place, String> {
        let (mut frame, mut place) = (of, Place::ORIGIN);
        // A ring of frames is no tree.
        for _ in 0..=self.links.len() {
            if frame == within {
                return Ok(place);
            }
            let Some(link) = self.links.get(frame) else { break };
            if let Some(silent) = link.heard.map(|heard| heard.elapsed()).filter(|s| *s > patience)
            {
                let (parent, seconds) = (&link.parent, silent.as_secs_f64());
                return Err(format!("no transform {parent} → {frame} for {seconds:.1} s"));
            }
            place = link.place.then(place);
            frame = &link.parent;
        }
        Err(format!("no transform leads from {within} to {of}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::{Point, Transform, header, turn};

    fn link(parent: &str, child: &str, x: f64, y: f64, yaw: f64) -> TransformStamped {
        let transform = Transform { translation: Point { x, y, z: 0.0 }, rotation: turn(yaw) };
        TransformStamped { header: header(parent), child_frame_id: child.to_owned(), transform }
    }

    #[test]
    fn frames_are_followed_up_to_the_map_and_a_silent_one_is_told() {
        let mut frames = Frames::default();
        let quarter = std::f64::consts::FRAC_PI_2;
        frames.hear(
            &[link("map", "odom", 1.0, 2.0, quarter), link("odom", "base", 3.0, 0.0, quarter)],
            false,
        );
        frames.hear(&[link("base", "laser", 0.5, 0.0, 0.0)], true);
        let long = Duration::from_secs(60);
        let place = frames.place("laser", "map", long).unwrap();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        // The base stands 3 m up from the odometry's origin and looks back along x.
        assert!(
            near(place.x, 0.5) && near(place.y, 5.0) && near(place.yaw, 2.0 * quarter),
            "{place:?}"
        );
        assert!(frames.place("wheel", "map", long).is_err());
        assert!(frames.place("base", "map", Duration::ZERO).unwrap_err().contains("odom → base"));
        frames.hear(&[link("base", "map", 0.0, 0.0, 0.0)], false);
        assert!(frames.place("base", "moon", long).is_err(), "a ring ends");
    }
}
