//! What a robot saw, from its logs and pictures: segments of one scan, things of a whole log, what changed between two
//! scans (paper 3). Needs no map.

use std::path::Path;

use crate::draw::{SeenDrawing, SeenSegment, SeenSign, TreeNode, seen_svg, tree_svg};
use crate::language::Language;
use crate::units::{
    Deg, FileFault, InOrder as _, Lengths, Point, Pose, Vector, is_input, read_file, told, word,
};
use crate::vectors::picture::Picture;
use crate::vectors::read::{LONGEST, Log, LogError, Scan, read_log, unpacked};
use crate::vectors::scan::Extractor;
use crate::vectors::{
    Difference, Equality, Model, Motion, Node, PoseNoise, Scene, Segment, TreeNode as Branch,
    difference, survey,
};

use super::{Error, RequestError};

/// Segments are equal, things moved, parts are parts with this confidence.
const CONFIDENCE: f64 = 0.999;
/// Things and segments that a drawn tree names; of the others the number.
const TREE: (usize, usize) = (5, 4);

/// A file of what a robot saw.
#[derive(Debug, Clone)]
pub struct Sighted {
    name: String,
    source: Of,
    faults: Option<Box<LogError>>,
}

#[derive(Debug, Clone)]
enum Of {
    Log(Log),
    Picture(Picture),
}

/// The segments of one scan, or of a picture.
#[derive(Debug, Clone)]
pub struct View {
    /// The file.
    pub name: String,
    /// From 1; of a picture 1.
    pub scan: usize,
    /// Of the log, from 1.
    pub line: usize,
    pub beams: usize,
    /// In the sensor's frame, cm; of a picture pixels, y upwards.
    pub segments: Vec<Segment<2>>,
    /// What one beam alone struck before a segment: the leg of a chair.
    pub points: Vec<Point>,
    /// What came back, in the same frame.
    pub returns: Vec<Point>,
    /// Of the sensor, where the log tells it.
    pub pose: Option<Pose>,
    pub is_picture: bool,
}

/// The things of a log, of one scan or of a picture.
#[derive(Debug, Clone)]
pub struct Things {
    pub name: String,
    /// A thing has its own frame and its segments in it.
    pub scene: Scene<2>,
    /// Scans that were joined.
    pub views: usize,
    /// Scans that tell no pose, and were not.
    pub without_pose: usize,
    pub is_picture: bool,
}

/// What is not as it was, between two scans.
#[derive(Debug, Clone)]
pub struct Changes {
    pub before: View,
    /// In the frame of the view before.
    pub after: View,
    /// By positions of the segments in the two views; parts by positions in its pairs, the greatest first.
    pub difference: Difference<2>,
}

impl Sighted {
    /// Of a laser above the map's zero, where nothing else is told, in cm.
    pub const LASER_HEIGHT: f64 = 30.0;

    /// Reads a log (CARMEN, rows of ranges, Breezy; also gzipped) or a picture (PNG).
    ///
    /// # Errors
    /// The file cannot be read, or nothing in it can: faults in some lines are told by [`Self::faults`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let name = path.display().to_string();
        let wrong = |fault: FileFault| {
            let reason = (&fault).into();
            let is_input = is_input(fault.into_io().kind());
            RequestError::File { path: name.clone(), reason, is_input }
        };
        let bytes = read_file(path, LONGEST).map_err(&wrong)?;
        if Picture::is_png(&bytes) {
            let source = Of::Picture(Picture::from_png(&bytes)?);
            return Ok(Self { name, source, faults: None });
        }
        let reading = read_log(&unpacked(&name, bytes).map_err(&wrong)?);
        match reading.error {
            Some(error) if reading.log.scans.is_empty() => Err(Box::new(error).into()),
            error => Ok(Self { name, source: Of::Log(reading.log), faults: error.map(Box::new) }),
        }
    }

    /// Scans of a log; a picture is one.
    #[must_use]
    pub fn scans(&self) -> usize {
        match &self.source {
            Of::Log(log) => log.scans.len(),
            Of::Picture(_) => 1,
        }
    }

    /// The file.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// None where it is a picture.
    pub(super) fn log(&self) -> Option<&Log> {
        match &self.source {
            Of::Log(log) => Some(log),
            Of::Picture(_) => None,
        }
    }

    /// What was wrong with lines of the log that were passed over.
    #[must_use]
    pub fn faults(&self) -> Option<&LogError> {
        self.faults.as_deref()
    }

    /// The segments of a scan, counted from 1; with `vertices` those that tell it best in so many at most. A picture is told
    /// as it is.
    ///
    /// # Errors
    /// There is no such scan.
    pub fn view(&self, scan: usize, vertices: Option<usize>) -> Result<View, Error> {
        let blank = View {
            name: self.name.clone(),
            scan,
            line: 0,
            beams: 0,
            segments: Vec::new(),
            points: Vec::new(),
            returns: Vec::new(),
            pose: None,
            is_picture: false,
        };
        match &self.source {
            Of::Picture(picture) if scan == 1 => {
                let segments = picture.contours(picture.level()).concat();
                Ok(View { segments, is_picture: true, ..blank })
            }
            Of::Picture(_) => Err(self.no_scan(scan)),
            Of::Log(log) => {
                let told = self.scan(log, scan)?;
                let sensor = log.sensor(told);
                let mut extractor = Extractor::new();
                let segments = match vertices {
                    Some(most) => extractor.refined(sensor, &told.ranges, most),
                    None => extractor.segments(sensor, &told.ranges).to_vec(),
                };
                let points =
                    extractor.thin(sensor, &told.ranges).map(|s| Point::from(s.start)).collect();
                let beams = sensor.directions().iter().zip(&told.ranges);
                let returned = beams.filter(|(_, range)| sensor.returned(**range));
                let returns = returned.map(|(u, range)| Point::from(u * *range)).collect();
                let pose = told.pose.map(|pose| Pose {
                    at: Point::from(pose.translation.vector),
                    heading: Deg::from_radians(pose.rotation.angle()),
                });
                let (line, beams) = (told.line, sensor.count());
                Ok(View { line, beams, segments, points, returns, pose, ..blank })
            }
        }
    }

    fn scan<'l>(&self, log: &'l Log, scan: usize) -> Result<&'l Scan, Error> {
        let place = scan.checked_sub(1).and_then(|k| log.scans.get(k));
        place.ok_or_else(|| self.no_scan(scan))
    }

    fn no_scan(&self, scan: usize) -> Error {
        RequestError::NoScan { scan, count: self.scans() }.into()
    }

    /// The things of one scan, or of all: what joins corner to corner.
    ///
    /// # Errors
    /// There is no such scan, or all are asked for and none tells where it was taken.
    pub fn things(&self, scan: Option<usize>) -> Result<Things, Error> {
        let equality = Equality::at(CONFIDENCE);
        let name = self.name.clone();
        match (&self.source, scan) {
            (Of::Picture(picture), None | Some(1)) => {
                let mut scene = Scene::new(equality);
                for contour in picture.contours(picture.level()) {
                    scene.add(&Model::of_contour(contour));
                }
                Ok(Things { name, scene, views: 1, without_pose: 0, is_picture: true })
            }
            (Of::Log(log), None) if log.scans.len() > 1 => {
                let found = survey(log, PoseNoise::default(), &equality);
                if found.views == 0 {
                    return Err(RequestError::NoPoses { count: found.without_pose }.into());
                }
                let (scene, views) = (found.scene, found.views);
                let without_pose = found.without_pose;
                Ok(Things { name, scene, views, without_pose, is_picture: false })
            }
            (_, scan) => {
                let view = Model::of_contour(self.view(scan.unwrap_or(1), None)?.segments);
                let mut scene = Scene::new(equality);
                scene.add_contours(&view, &(0..view.len()).collect::<Vec<_>>());
                Ok(Things { name, scene, views: 1, without_pose: 0, is_picture: false })
            }
        }
    }

    /// Which segments of one scan are which of another, and what moved by itself. Where both tell their pose, places
    /// are compared; otherwise shapes alone.
    ///
    /// # Errors
    /// There is no such scan.
    pub fn changes(&self, before: usize, after: usize) -> Result<Changes, Error> {
        let (first, mut second) = (self.view(before, None)?, self.view(after, None)?);
        let mut guess = None;
        if let (Of::Log(log), Some(_), Some(_)) = (&self.source, first.pose, second.pose) {
            let poses = [before, after].map(|scan| self.scan(log, scan).ok().and_then(|s| s.pose));
            if let [Some(a), Some(b)] = poses {
                let between = a.inv_mul(&b);
                let rotation = between.rotation.to_rotation_matrix();
                let motion = Motion::<2>::from_parts(between.translation, rotation, 1.0);
                second.segments.iter_mut().for_each(|s| *s = s.moved(&motion));
                second.returns.iter_mut().for_each(|p| *p = motion.transform_point(p));
                guess = Some(Motion::identity());
            }
        }
        let models = [&first, &second].map(|view| Model::of_contour(view.segments.clone()));
        let equality = Equality::at(CONFIDENCE);
        let difference = difference(&models[0], &models[1], guess.as_ref(), &equality);
        Ok(Changes { before: first, after: second, difference })
    }
}

impl View {
    /// As SVG: the returns, the segments, true and cut ends, the observer.
    #[must_use]
    pub fn draw(&self, language: Language) -> String {
        let lines = self.segments.iter().map(|s| drawn(s, None, false));
        let points = self.points.iter().map(|p| SeenSegment {
            from: *p,
            to: *p,
            is_true: [true; 2],
            group: None,
            is_before: false,
        });
        let segments = lines.chain(points).collect();
        let title = if self.is_picture {
            self.name.clone()
        } else {
            format!("{}: {} {}", self.name, told!(language, "scan-word"), self.scan)
        };
        seen_svg(&SeenDrawing {
            title,
            segments,
            returns: self.returns.clone(),
            observer: (!self.is_picture).then(Point::origin),
            scale: scale(self.is_picture, language),
            signs: signs(language),
            ..SeenDrawing::default()
        })
    }
}

impl Things {
    /// As SVG: each thing in a colour.
    #[must_use]
    pub fn draw(&self, language: Language) -> String {
        let mut segments = Vec::new();
        for (k, _) in self.scene.things().iter().enumerate() {
            let model = self.scene.seen(k);
            segments.extend(model.segments().iter().map(|s| drawn(s, Some(k), false)));
        }
        let count = self.scene.things().len();
        seen_svg(&SeenDrawing {
            title: format!("{}: {} {count}", self.name, told!(language, "things")),
            segments,
            scale: scale(self.is_picture, language),
            signs: signs(language),
            ..SeenDrawing::default()
        })
    }

    /// The map as a tree (fig. 1), as SVG: the things of most segments, and of each the first.
    #[must_use]
    pub fn draw_tree(&self, language: Language) -> String {
        tree_svg(&self.name, &branch(&self.scene.tree(), language))
    }
}

impl Changes {
    /// As SVG: how it was in grey, how it is in ink, what moved by itself in colours with arrows.
    #[must_use]
    pub fn draw(&self, language: Language) -> String {
        let mut group = vec![None; self.after.segments.len()];
        let mut moves = Vec::new();
        // The first part is what stayed, with the observer's own error.
        for (k, part) in self.difference.parts.iter().enumerate().skip(1) {
            for &member in &part.members {
                let (was, is, _) = self.difference.pairs[member];
                group[is] = Some(k);
                let middle = |s: &Segment<2>| Point::from(s.at(0.5));
                moves.push((middle(&self.before.segments[was]), middle(&self.after.segments[is])));
            }
        }
        let before = self.before.segments.iter().map(|s| drawn(s, None, true));
        let after = self.after.segments.iter().zip(&group).map(|(s, g)| drawn(s, *g, false));
        let scans = (self.before.scan, self.after.scan);
        let word = told!(language, "scans");
        seen_svg(&SeenDrawing {
            title: format!("{}: {word} {} → {}", self.before.name, scans.0, scans.1),
            segments: before.chain(after).collect(),
            observer: Some(Point::origin()),
            moves,
            scale: scale(self.before.is_picture, language),
            signs: signs(language),
            ..SeenDrawing::default()
        })
    }
}

fn drawn(segment: &Segment<2>, group: Option<usize>, is_before: bool) -> SeenSegment {
    let is_true = segment.ends.map(|end| end.is_true());
    let (from, to) = (Point::from(segment.start), Point::from(segment.end));
    SeenSegment { from, to, is_true, group, is_before }
}

fn scale(is_picture: bool, language: Language) -> Option<(f64, String)> {
    Some(if is_picture {
        (100.0, told!(language, "pixels"))
    } else {
        (100.0, told!(language, "one-metre"))
    })
}

fn signs(language: Language) -> Vec<(SeenSign, String)> {
    [
        (SeenSign::Return, word!("sign-return")),
        (SeenSign::TrueEnd, word!("sign-true-end")),
        (SeenSign::CutEnd, word!("sign-cut-end")),
        (SeenSign::Observer, word!("sign-observer")),
        (SeenSign::Before, word!("sign-before")),
        (SeenSign::Moved, word!("sign-moved")),
    ]
    .map(|(sign, word)| (sign, word.say(language).into_owned()))
    .to_vec()
}

/// A node of the map with what is drawn below it.
fn branch(node: &Branch<2>, language: Language) -> TreeNode {
    let most = match &node.node {
        Node::Robot | Node::Scene => TREE.0,
        _ => TREE.1,
    };
    let mut order: Vec<&Branch<2>> = node.below.iter().collect();
    if matches!(node.node, Node::Scene) {
        order.order_by_key(|thing| std::cmp::Reverse(leaves(thing)));
    }
    let mut below: Vec<TreeNode> =
        order.iter().take(most).map(|child| branch(child, language)).collect();
    if order.len() > most {
        let rest = order.len() - most;
        let line = format!("… {} {rest}", told!(language, "and-more-things"));
        below.push(TreeNode { lines: vec![line], ..TreeNode::default() });
    }
    let place = |v: &Vector| Lengths::said().point(v.x, v.y, 0);
    let framed = |name: String, v: &Vector| vec![name, place(v)];
    let lines = match &node.node {
        Node::Robot => vec![told!(language, "robot")],
        Node::Scene => vec![told!(language, "scene")],
        Node::Thing(id, frame) => {
            let name = format!("{} {}", told!(language, "thing"), id.0);
            framed(name, &frame.translation.vector)
        }
        Node::Part(k, frame) => {
            let name = format!("{} {k}", told!(language, "part"));
            framed(name, &frame.translation.vector)
        }
        Node::Segment(k, s) => {
            let length = Lengths::said().told(s.length(), 1, language);
            vec![format!("{} {k}", told!(language, "segment")), length]
        }
    };
    TreeNode { lines, below, is_same: matches!(node.node, Node::Scene) }
}

fn leaves(node: &Branch<2>) -> usize {
    match node.node {
        Node::Segment(..) => 1,
        _ => node.below.iter().map(leaves).sum(),
    }
}
