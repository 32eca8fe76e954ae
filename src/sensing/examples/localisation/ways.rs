//! Ways of odometry through a log.

use orthoframe_vectors::read::Scan;

/// The way of odometry after which the place must be known, in cm.
const WAY: f64 = 500.0;

/// Ways of odometry, each from another start.
pub(crate) fn starts<'s>(posed: &[&'s Scan], every: usize) -> Vec<Vec<&'s Scan>> {
    let way = |start: usize| {
        let (mut far, mut way) = (0.0, vec![posed[start]]);
        for pair in posed[start..].windows(2) {
            let step = pair[0].odometry?.translation.vector - pair[1].odometry?.translation.vector;
            far += step.norm();
            way.push(pair[1]);
            if far >= WAY {
                return Some(way);
            }
        }
        None
    };
    (0..posed.len()).step_by(2 * every).filter_map(way).collect()
}
