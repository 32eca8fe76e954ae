//! Plans of the buildings of the logs, drawn by others (`../shared/data/lidar/plans`), laid over the logs by points picked in
//! both.
//!
//! Neither is true to scale: of Freiburg 101 one similarity leaves the hall's walls off by up to 75 cm, and of 79 some doors are
//! drawn half a metre off. So each stretch is drawn anew between corners and the posts of doors along rows of walls, straight
//! walls staying straight. Of 79 the rooms stand in two rows along a corridor; between its posts the corridor's wall is laid on
//! the wall, not on the pillars that stand out of it.

use std::collections::HashMap;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use nalgebra::{Isometry2, Point2};
use orthoframe_sensing::{Chart, Line};
use orthoframe_vectors::picture::Picture;

/// Column and row of a plan, x and y of the log in cm.
type Pick = [f64; 4];

/// Freiburg 101, from left to right: the hall's upper wall, its lower wall, and what lies below.
const PICKS_101: [&[Pick]; 3] = [
    &[
        [291.2, 204.9, -3095.0, 1565.0],
        [1089.1, 349.5, 875.0, 710.0],
        [1268.9, 380.2, 1725.0, 590.0],
    ],
    &[
        [210.9, 444.5, -3510.0, 390.0],
        [389.3, 454.2, -2690.0, 290.0],
        [683.8, 462.7, -1170.0, 215.0],
        [1087.0, 470.1, 800.0, 165.0],
        [1115.7, 470.4, 925.0, 160.0],
        [1265.9, 471.2, 1690.0, 140.0],
    ],
    &[
        [213.8, 580.9, -3510.0, -280.0],
        [1079.9, 618.8, 765.0, -550.0],
        [1113.2, 618.1, 910.0, -550.0],
        [1268.5, 591.3, 1690.0, -440.0],
    ],
];

/// Freiburg 79, from left to right: along the upper windows, the corridor's upper and lower wall, the lower windows.
const PICKS_79: [&[Pick]; 4] = [
    &[
        [191.0, 208.0, -1785.0, 804.0],
        [267.0, 208.0, -1338.0, 765.0],
        [337.0, 208.0, -897.0, 726.0],
        [389.0, 208.0, -587.0, 700.0],
        [477.0, 208.0, -148.0, 662.0],
        [547.0, 208.0, 311.0, 626.0],
        [707.0, 209.0, 1062.0, 569.0],
    ],
    &[
        [89.5, 288.5, -2405.0, 303.0],
        [191.0, 289.5, -1830.0, 249.0],
        [239.5, 289.5, -1531.0, 226.0],
        [256.5, 290.5, -1449.0, 218.0],
        [267.0, 290.5, -1382.0, 212.0],
        [311.5, 290.5, -1088.0, 188.0],
        [328.5, 291.5, -997.0, 177.0],
        [337.0, 291.5, -939.0, 171.0],
        [344.5, 291.5, -907.0, 170.0],
        [361.5, 291.5, -809.0, 162.0],
        [389.0, 291.5, -631.0, 147.0],
        [400.5, 291.5, -568.0, 141.0],
        [417.5, 291.5, -480.0, 133.0],
        [476.0, 291.5, -196.0, 110.0],
        [487.5, 291.5, -121.0, 104.0],
        [504.5, 291.5, -32.0, 97.0],
        [547.0, 292.5, 267.0, 72.0],
        [645.5, 292.5, 726.0, 34.0],
        [662.5, 293.5, 806.0, 28.0],
        [707.0, 293.5, 1013.0, 10.0],
    ],
    &[
        [89.5, 330.5, -2439.0, 60.0],
        [111.5, 330.5, -2297.0, 46.0],
        [128.5, 332.5, -2228.0, 33.0],
        [135.0, 332.5, -2164.0, 27.0],
        [165.5, 332.5, -2007.0, 9.0],
        [182.5, 333.5, -1915.0, 9.0],
        [188.0, 333.5, -1860.0, 1.0],
        [240.5, 333.5, -1554.0, -37.0],
        [257.5, 334.5, -1471.0, -40.0],
        [267.0, 334.5, -1409.0, -49.0],
        [331.5, 334.5, -1106.0, -78.0],
        [347.5, 335.5, -1015.0, -76.0],
        [355.0, 335.5, -963.0, -70.0],
        [389.0, 336.2, -651.0, -94.0],
        [470.0, 336.5, -304.0, -130.0],
        [475.5, 336.5, -278.0, -140.0],
        [492.5, 336.5, -199.0, -149.0],
        [531.0, 336.5, -44.0, -161.0],
        [535.5, 336.5, 16.0, -166.0],
        [552.5, 336.5, 100.0, -174.0],
        [581.0, 336.5, 250.0, -186.0],
        [647.5, 336.5, 698.0, -226.0],
        [664.5, 337.5, 786.0, -232.0],
        [706.0, 337.5, 994.0, -246.0],
    ],
    &[
        [89.0, 433.0, -2479.0, -507.0],
        [135.0, 434.0, -2200.0, -531.0],
        [188.0, 435.0, -1904.0, -557.0],
        [267.0, 436.0, -1456.0, -596.0],
        [355.0, 437.0, -1009.0, -634.0],
        [470.0, 437.0, -332.0, -693.0],
        [531.0, 437.0, -91.0, -714.0],
        [581.0, 437.0, 204.0, -738.0],
        [706.0, 437.0, 949.0, -801.0],
    ],
];

/// What the ends of drawn lines err, in cm.
const ENDS: f64 = 3.0;
/// Smaller specks are no rooms, in pixels.
const LEAST_ROOM: usize = 400;
/// Side of a cell in which rooms are looked up, in cm: more than a pixel.
const CELL: f64 = 10.0;

/// Walls and rooms in the frame of the log, in cm.
pub(crate) struct Plan {
    pub(crate) chart: Chart,
    pub(crate) rooms: Rooms,
}

impl Plan {
    /// The plan of the building whose log it is, by the log's name; none where nobody drew one.
    pub(crate) fn beside(log: &Path) -> Option<Self> {
        let plans = log.parent().expect("a folder").join("plans");
        let drawn: [(&str, &str, &[&[Pick]]); 2] =
            [("079", "Freiburg79", &PICKS_79), ("101", "Freiburg101", &PICKS_101)];
        let of = |(number, ..): &&(&str, _, _)| log.to_string_lossy().contains(number);
        let (_, name, picks) = drawn.iter().find(of)?;
        Some(Self::read(&plans, name, &|at| by_rows(picks, at)))
    }

    fn read(plans: &Path, name: &str, laid: &dyn Fn(Point2<f64>) -> Point2<f64>) -> Self {
        let (width, height, grey) = pixels(&plans.join(format!("{name}_scan.png")));
        let picture = Picture::new(width as u32, height as u32, grey).expect("its size is right");
        // Between free, 254, and unknown, 205.
        let contours = picture.contours(230).concat();
        let rows = height as f64 - 1.0;
        let at = |p: nalgebra::Vector2<f64>| laid(Point2::new(p.x, rows - p.y));
        let line = contours.iter().map(|s| Line::between(at(s.start), at(s.end)));
        let chart = Chart::new(line.collect()).erring(ENDS);
        let (width, height, grey) = pixels(&plans.join(format!("{name}_scan_gt_segmentation.png")));
        Self { chart, rooms: Rooms::of(width, height, &grey, laid) }
    }
}

/// Which room lies where.
pub(crate) struct Rooms {
    cells: HashMap<(i64, i64), u32>,
}

impl Rooms {
    /// Connected free pixels are a room.
    fn of(
        width: usize,
        height: usize,
        grey: &[u8],
        laid: &dyn Fn(Point2<f64>) -> Point2<f64>,
    ) -> Self {
        let mut free: Vec<bool> = grey.iter().map(|value| *value >= 250).collect();
        let (mut cells, mut count) = (HashMap::new(), 0);
        for first in 0..free.len() {
            if !std::mem::take(&mut free[first]) {
                continue;
            }
            let (mut room, mut next) = (vec![first], 0);
            while let Some(&at) = room.get(next) {
                next += 1;
                let (x, y) = (at % width, at / width);
                let beside = [
                    (x > 0).then(|| at - 1),
                    (x + 1 < width).then_some(at + 1),
                    (y > 0).then(|| at - width),
                    (y + 1 < height).then_some(at + width),
                ];
                room.extend(
                    beside.into_iter().flatten().filter(|at| std::mem::take(&mut free[*at])),
                );
            }
            if room.len() >= LEAST_ROOM {
                count += 1;
                let place = |at: usize| laid(Point2::new((at % width) as f64, (at / width) as f64));
                cells.extend(room.into_iter().map(|at| (cell(place(at)), count)));
            }
        }
        Self { cells }
    }

    pub(crate) fn at(&self, pose: &Isometry2<f64>) -> Option<u32> {
        self.cells.get(&cell(pose.translation.vector.into())).copied()
    }
}

fn cell(p: Point2<f64>) -> (i64, i64) {
    ((p.x / CELL).floor() as i64, (p.y / CELL).floor() as i64)
}

/// Width, height and grey values of a picture.
fn pixels(path: &Path) -> (usize, usize, Vec<u8>) {
    let file = BufReader::new(File::open(path).expect("the plan is there"));
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
    let mut reader = decoder.read_info().expect("a picture");
    let mut raw = vec![0; reader.output_buffer_size().expect("it is small")];
    let info = reader.next_frame(&mut raw).expect("a whole picture");
    let (width, height) = (info.width as usize, info.height as usize);
    let grey = raw.chunks_exact(info.color_type.samples()).map(|p| p[0]).take(width * height);
    (width, height, grey.collect())
}

/// Between two rows of picks in proportion, and along each row from pick to pick.
fn by_rows(rows: &[&[Pick]], p: Point2<f64>) -> Point2<f64> {
    // Of a row at the column: its pixel row, and where that lies.
    let along = |row: &[Pick]| {
        let next = row.iter().position(|pick| pick[0] > p.x).unwrap_or(row.len());
        let next = next.clamp(1, row.len() - 1);
        let (a, b) = (row[next - 1], row[next]);
        let share = (p.x - a[0]) / (b[0] - a[0]);
        let between = |k: usize| a[k] + share * (b[k] - a[k]);
        (between(1), Point2::new(between(2), between(3)))
    };
    let rows: Vec<(f64, Point2<f64>)> = rows.iter().map(|row| along(row)).collect();
    let next = rows.iter().position(|(y, _)| *y > p.y).unwrap_or(rows.len());
    let next = next.clamp(1, rows.len() - 1);
    let ((above, a), (below, b)) = (rows[next - 1], rows[next]);
    a + (b - a) * ((p.y - above) / (below - above))
}
