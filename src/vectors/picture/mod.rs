//! Contours of a picture, as segments (SPEC V2): the case of the paper's stereo frames.
//!
//! The borders between lighter and darker regions are followed (Suzuki and Abe 1985) by the crate `imageproc`; each border
//! point is then moved to where the brightness between it and its neighbour outside crosses the level, so that lines
//! are found more finely than pixels. Lengths are pixels, x to the right and **y upwards**, the middle of the lowest left
//! pixel at (0, 0).

mod file;

use imageproc::contours::find_contours_with_threshold;
use imageproc::contrast::otsu_level;
use imageproc::image::GrayImage;
use nalgebra::Vector2;

use crate::polyline::{Course, polyline};
use crate::segment::{Cut, End, Segment};

/// Deviation of a border point, in pixels.
const SIGMA: f64 = 0.3;
/// Shorter borders are specks.
const FEWEST: usize = 12;
/// Sides of a picture.
const LARGEST: u32 = 16_384;

/// What no picture can be.
#[derive(Debug, Clone, PartialEq, Eq, orthoframe_units::Fault)]
#[fault(vectors)]
#[non_exhaustive]
pub enum PictureError {
    /// Its sides and the number of its pixels disagree, or a side is too long.
    #[fault(code = "vectors::picture_size")]
    Size { width: u32, height: u32, pixels: usize },

    /// The file is no PNG, or is damaged.
    #[fault(code = "vectors::picture_file")]
    Unreadable { reason: String },
}

/// Grey values, row by row from the top.
#[derive(Debug, Clone)]
pub struct Picture {
    image: GrayImage,
}

impl Picture {
    /// # Errors
    /// [`PictureError`].
    pub fn new(width: u32, height: u32, pixels: Vec<u8>) -> Result<Self, PictureError> {
        let count = pixels.len();
        let fault = PictureError::Size { width, height, pixels: count };
        if width > LARGEST || height > LARGEST || count != width as usize * height as usize {
            return Err(fault);
        }
        let image = GrayImage::from_raw(width, height, pixels).ok_or(fault)?;
        Ok(Self { image })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        self.image.dimensions()
    }

    /// The brightness in the middle between light and dark, parted as well as can be (Otsu 1979); 0 of an empty picture.
    #[must_use]
    pub fn level(&self) -> u8 {
        if self.image.is_empty() {
            return 0;
        }
        let border = otsu_level(&self.image);
        // A blurred border lies where it is half as light, not where dark ends.
        let (mut dark, mut light) = ((0_u64, 0_u64), (0_u64, 0_u64));
        for value in self.image.iter() {
            let class = if *value <= border { &mut dark } else { &mut light };
            *class = (class.0 + 1, class.1 + u64::from(*value));
        }
        let mean = |(count, sum): (u64, u64)| sum.checked_div(count).unwrap_or(u64::from(border));
        u8::midpoint(mean(dark) as u8, mean(light) as u8)
    }

    /// The segments of every contour between what is lighter than the level and what is not, contour by contour. An end at
    /// the border of the picture is cut by the field.
    #[must_use]
    pub fn contours(&self, level: u8) -> Vec<Vec<Segment<2>>> {
        if self.image.is_empty() {
            return Vec::new();
        }
        let mut found = Vec::new();
        for contour in find_contours_with_threshold::<u32>(&self.image, level) {
            let points: Vec<(u32, u32)> = contour.points.iter().map(|p| (p.x, p.y)).collect();
            for (piece, course) in self.inner(&points) {
                if piece.len() >= FEWEST {
                    let fine: Vec<Vector2<f64>> =
                        piece.iter().map(|at| self.crossing(*at, level)).collect();
                    found.push(polyline(&fine, course, SIGMA));
                }
            }
        }
        found
    }

    /// What of a border lies within the picture: all of it, or the pieces between its visits to the picture's border.
    fn inner(&self, points: &[(u32, u32)]) -> Vec<(Vec<(u32, u32)>, Course)> {
        let (width, height) = self.size();
        let outer = |p: &(u32, u32)| p.0 == 0 || p.1 == 0 || p.0 + 1 == width || p.1 + 1 == height;
        let Some(first) = points.iter().position(outer) else {
            return vec![(points.to_vec(), Course::Closed)];
        };
        let turned: Vec<(u32, u32)> =
            points[first..].iter().chain(&points[..first]).copied().collect();
        let field = Course::Open([End::Cut(Cut::Field); 2]);
        let pieces = turned.split(outer).filter(|piece| !piece.is_empty());
        pieces.map(|piece| (piece.to_vec(), field)).collect()
    }

    /// Where the brightness crosses the level beside a border pixel, in the middle of all its neighbours outside.
    fn crossing(&self, (x, y): (u32, u32), level: u8) -> Vector2<f64> {
        let (width, height) = self.size();
        let value = |x: u32, y: u32| f64::from(self.image.get_pixel(x, y).0[0]);
        let (inside, level) = (value(x, y), f64::from(level) + 0.5);
        let mut sum = Vector2::zeros();
        let mut count = 0.0;
        for (dx, dy) in [(1_i64, 0_i64), (-1, 0), (0, 1), (0, -1)] {
            let (nx, ny) = (i64::from(x) + dx, i64::from(y) + dy);
            if nx < 0 || ny < 0 || nx >= i64::from(width) || ny >= i64::from(height) {
                continue;
            }
            let outside = value(nx as u32, ny as u32);
            if outside < level {
                let share = (inside - level) / (inside - outside);
                sum += Vector2::new(dx as f64, dy as f64) * share;
                count += 1.0;
            }
        }
        let shift = if count > 0.0 { sum / count } else { sum };
        Vector2::new(f64::from(x) + shift.x, f64::from(height - 1 - y) - shift.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A light quadrangle on dark ground, its borders blurred over a pixel.
    fn drawn(width: u32, height: u32, corners: &[(f64, f64)]) -> Picture {
        let mut pixels = Vec::new();
        for row in 0..height {
            for column in 0..width {
                let p = Vector2::new(f64::from(column), f64::from(height - 1 - row));
                let mut inside = f64::MAX;
                for at in 0..corners.len() {
                    let (a, b) = (corners[at], corners[(at + 1) % corners.len()]);
                    let (a, b) = (Vector2::new(a.0, a.1), Vector2::new(b.0, b.1));
                    inside = inside.min((b - a).normalize().perp(&(p - a)));
                }
                pixels.push((40.0 + 160.0 * (inside + 0.5).clamp(0.0, 1.0)) as u8);
            }
        }
        Picture::new(width, height, pixels).expect("a picture")
    }

    #[test]
    fn a_quadrangle_has_its_corners_finer_than_pixels() {
        let corners = [(40.3, 30.2), (260.7, 52.9), (230.1, 180.4), (60.6, 150.8)];
        let picture = drawn(320, 240, &corners);
        let contours = picture.contours(picture.level());
        assert_eq!(contours.len(), 1);
        assert_eq!(contours[0].len(), 4);
        for segment in &contours[0] {
            assert!(segment.is_whole());
            let off = corners
                .iter()
                .map(|(x, y)| (Vector2::new(*x, *y) - segment.start).norm())
                .fold(f64::MAX, f64::min);
            assert!(off < 0.3, "{off} pixels off: {segment:?}");
        }
    }

    #[test]
    fn what_leaves_the_picture_is_cut_by_the_field() {
        let picture =
            drawn(320, 240, &[(-50.0, 60.0), (150.0, 60.0), (150.0, 160.0), (-50.0, 160.0)]);
        let contours = picture.contours(picture.level());
        assert_eq!(contours.len(), 1);
        let ends: Vec<End> = contours[0].iter().flat_map(|s| s.ends).collect();
        let (cut, corner) = (End::Cut(Cut::Field), End::True(crate::Truth::Corner));
        assert_eq!(ends, [cut, corner, corner, corner, corner, cut], "{contours:?}");
    }

    #[test]
    fn odd_pictures_make_no_trouble() {
        assert!(Picture::new(4, 4, vec![0; 15]).is_err());
        assert!(Picture::new(u32::MAX, u32::MAX, Vec::new()).is_err());
        let nothing = Picture::new(0, 0, Vec::new()).expect("an empty picture");
        assert!(nothing.contours(nothing.level()).is_empty());
        for pixels in
            [vec![0; 64], vec![255; 64], (0..64_u32).map(|k| (k * 37 % 251) as u8).collect()]
        {
            let picture = Picture::new(8, 8, pixels).expect("a picture");
            for level in [0, picture.level(), 255] {
                let segments = picture.contours(level).concat();
                assert!(segments.iter().all(|s| s.length().is_finite()));
            }
        }
    }
}
