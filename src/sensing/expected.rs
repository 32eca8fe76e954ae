//! What a sensor should see from a pose (SPEC L2).

use nalgebra::Isometry2;
use orthoframe_vectors::scan::Sensor;

use crate::Locator;

/// What one beam should strike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// In cm.
    pub range: f64,
    /// The face, by its number among [`Locator::faces`].
    pub face: usize,
}

impl Locator {
    /// What each beam should strike from `pose`, within the sensor's reach.
    #[must_use]
    pub fn view(&self, sensor: &Sensor, pose: &Isometry2<f64>) -> Vec<Option<Expected>> {
        let reach = sensor.reach().1;
        let beam = |u: &nalgebra::Vector2<f64>| {
            let struck = self.field.strike(
                &self.faces,
                &pose.translation.vector,
                &(pose.rotation * u),
                reach,
            );
            struck.map(|(range, face)| Expected { range, face })
        };
        sensor.directions().iter().map(beam).collect()
    }

    /// The ranges of the same view, without noise; infinite where nothing is struck.
    #[must_use]
    pub fn expected(&self, sensor: &Sensor, pose: &Isometry2<f64>) -> Vec<f64> {
        let view = self.view(sensor, pose);
        view.into_iter().map(|e| e.map_or(f64::INFINITY, |e| e.range)).collect()
    }
}
