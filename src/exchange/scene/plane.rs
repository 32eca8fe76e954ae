//! Unions and differences of outlines, by `i_overlay`.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;

use crate::units::{InOrder as _, Point};

type Contour = Vec<[f64; 2]>;

fn contours(outlines: &[Vec<Point>]) -> Vec<Contour> {
    outlines.iter().map(|o| o.iter().map(|p| [p.x, p.y]).collect()).collect()
}

/// The pieces of the plane that outlines cover together, or `of` without them: each an outer ring, its holes left out.
/// The largest first.
pub(super) fn union(outlines: &[Vec<Point>]) -> Vec<Vec<Point>> {
    let none: Vec<Contour> = Vec::new();
    rings(contours(outlines).overlay(&none, OverlayRule::Subject, FillRule::NonZero))
}

/// `of` without what the others cover.
pub(super) fn difference(of: &[Vec<Point>], others: &[Vec<Point>]) -> Vec<Vec<Point>> {
    rings(contours(of).overlay(&contours(others), OverlayRule::Difference, FillRule::NonZero))
}

fn rings(shapes: Vec<Vec<Contour>>) -> Vec<Vec<Point>> {
    let outer = shapes.into_iter().filter_map(|shape| shape.into_iter().next());
    let mut rings: Vec<Vec<Point>> =
        outer.map(|ring| ring.into_iter().map(|[x, y]| Point::new(x, y)).collect()).collect();
    rings.order_by(|a, b| area(b).total_cmp(&area(a)));
    rings
}

/// Of a ring of either sense, in cm².
pub(super) fn area(ring: &[Point]) -> f64 {
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    (ends.map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>() / 2.0).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shape::rectangle;

    #[test]
    fn tiles_side_by_side_are_one_floor() {
        let tiles = [
            rectangle(0., 0., 250., 250.),
            rectangle(250., 0., 500., 250.),
            rectangle(0., 250., 250., 500.),
        ];
        let floor = union(&tiles);
        assert_eq!(floor.len(), 1);
        assert_eq!(floor[0].len(), 6);
        let rest = difference(&floor, &tiles[..1]);
        assert_eq!(rest.len(), 2);
        assert!((area(&rest[0]) - 62_500.0).abs() < 1.0);
    }
}
