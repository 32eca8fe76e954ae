//! Zones: regions of the floor with rules of their own (keep-out, closed, slow, one-way), in force for ever or for a time.
//!
//! Beyond the papers; the kinds are those that fleets of robots know: keep-out and speed limits as in Nav2's costmap
//! filters, one-way lanes as in Open-RMF, closures with a reason and a time as people hang out on a door.
//!
//! **Invariant**: a zone without a time is in force on the map as surveyed; one with a time is in force in the world as it is
//! at a moment, which whoever asks names.

use crate::units::{AreaId, Deg, MapId, Point, Timestamp, ZoneId};

use super::Forms;

/// What the robot is to do in a zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ZoneKind {
    /// Never to be entered.
    KeepOut,
    /// Not to be entered for now: a wet floor, works.
    Closed,
    /// Not faster than so many cm/s.
    Slow { speed: f64 },
    /// Never against this heading, in the frame of the Map.
    OneWay { heading: Deg },
}

impl ZoneKind {
    /// Whether the robot has to stay out.
    #[must_use]
    pub fn is_shut(self) -> bool {
        matches!(self, Self::KeepOut | Self::Closed)
    }
}

/// Where a zone is.
#[derive(Debug, Clone, PartialEq)]
pub enum Extent {
    /// Corners of a simple polygon in the Map's frame, cm, either way round.
    Polygon { map: MapId, corners: Vec<Point> },
    /// Whole Areas.
    Areas(Vec<AreaId>),
}

/// A region of the floor with a rule of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    pub id: ZoneId,
    pub key: String,
    /// Unique in the world, as all that a person can speak of.
    pub name: String,
    pub name_en: String,
    pub kind: ZoneKind,
    pub extent: Extent,
    /// Why, in the words of people; empty where nobody said.
    pub reason: String,
    pub reason_en: String,
    /// The first moment at which it is in force; from ever where there is none.
    pub from: Option<Timestamp>,
    /// The first moment at which it is no longer.
    pub until: Option<Timestamp>,
    pub forms: Forms,
}

impl Zone {
    /// Whether it is in force at every moment.
    #[must_use]
    pub fn is_standing(&self) -> bool {
        self.from.is_none() && self.until.is_none()
    }

    /// Whether it is in force at a moment.
    #[must_use]
    pub fn is_in_force(&self, at: Timestamp) -> bool {
        self.from.is_none_or(|from| from <= at) && self.until.is_none_or(|until| at < until)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zone_is_in_force_from_its_first_moment_and_not_at_its_last() {
        let mut zone = Zone {
            id: ZoneId(1),
            key: "wet".to_owned(),
            name: "Мокрый пол".to_owned(),
            name_en: String::new(),
            kind: ZoneKind::Closed,
            extent: Extent::Areas(vec![AreaId(1)]),
            reason: String::new(),
            reason_en: String::new(),
            from: None,
            until: None,
            forms: Forms::new(),
        };
        assert!(zone.is_standing() && zone.is_in_force(Timestamp(0)));
        (zone.from, zone.until) = (Some(Timestamp(10)), Some(Timestamp(20)));
        let force = [9, 10, 19, 20].map(|ms| zone.is_in_force(Timestamp(ms)));
        assert_eq!((force, zone.is_standing()), ([false, true, true, false], false));
    }
}
