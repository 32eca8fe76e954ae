//! Messages of ROS 2 as far as the bridge speaks of them, in the order of their fields on the wire.
//!
//! Of a message that is only read the last fields may be missing here: what follows on the wire is not looked at. So the
//! results of Nav2's actions, which differ from one distribution to the next, are read up to their status.

use ros2_client::Message;
use ros2_client::builtin_interfaces::{Duration, Time};
use serde::{Deserialize, Serialize};

use crate::frames::Place;

macro_rules! messages {
    ($($(#[$about:meta])* $name:ident { $($field:ident: $kind:ty),* $(,)? })*) => {
        $(
            $(#[$about])*
            #[derive(Debug, Clone, Serialize, Deserialize)]
            pub(crate) struct $name { $(pub(crate) $field: $kind),* }
            impl Message for $name {}
        )*
    };
}

messages! {
    Header { stamp: Time, frame_id: String }
    Point { x: f64, y: f64, z: f64 }
    Quaternion { x: f64, y: f64, z: f64, w: f64 }
    Pose { position: Point, orientation: Quaternion }
    PoseStamped { header: Header, pose: Pose }
    Path { header: Header, poses: Vec<PoseStamped> }
    /// Row by row: x, y, z, and the turns about them.
    Covariance { rows: [[f64; 6]; 6] }
    PoseWithCovariance { pose: Pose, covariance: Covariance }
    PoseWithCovarianceStamped { header: Header, pose: PoseWithCovariance }
    /// Without its speeds.
    Odometry { header: Header, child_frame_id: String, pose: PoseWithCovariance }
    Transform { translation: Point, rotation: Quaternion }
    TransformStamped { header: Header, child_frame_id: String, transform: Transform }
    TransformArray { transforms: Vec<TransformStamped> }
    /// Without its intensities.
    LaserScan {
        header: Header, angle_min: f32, angle_max: f32, angle_increment: f32, time_increment: f32,
        scan_time: f32, range_min: f32, range_max: f32, ranges: Vec<f32>,
    }
    GridInfo { map_load_time: Time, resolution: f32, width: u32, height: u32, origin: Pose }
    OccupancyGrid { header: Header, info: GridInfo, data: Vec<i8> }
    KeyValue { key: String, value: String }
    DiagnosticStatus { level: u8, name: String, message: String, hardware_id: String, values: Vec<KeyValue> }
    DiagnosticArray { header: Header, status: Vec<DiagnosticStatus> }
    Color { r: f32, g: f32, b: f32, a: f32 }
    Picture { header: Header, format: String, data: Vec<u8> }
    Corner { u: f32, v: f32 }
    Mesh { filename: String, data: Vec<u8> }
    Marker {
        header: Header, ns: String, id: i32, kind: i32, action: i32, pose: Pose, scale: Point,
        color: Color, lifetime: Duration, frame_locked: bool, points: Vec<Point>, colors: Vec<Color>,
        texture_resource: String, texture: Picture, uv_coordinates: Vec<Corner>, text: String,
        mesh_resource: String, mesh_file: Mesh, mesh_use_embedded_materials: bool,
    }
    MarkerArray { markers: Vec<Marker> }
    /// nav2_msgs/action/FollowPath. Servers of older distributions do not read the last names.
    FollowPathGoal { path: Path, controller_id: String, goal_checker_id: String, progress_checker_id: String }
    NavigateGoal { pose: PoseStamped, behavior_tree: String }
    /// Nothing of what an action says on its way, or at its end beside its status.
    Nothing {}
    AskRequest { text: String }
    AskResponse { outcome: String, text: String, json: String }
    RunGoal { text: String }
    RunResult { outcome: String, text: String, json: String }
    RunFeedback { event: String, text: String, json: String }
}

/// A turn about the vertical, in radians.
pub(crate) fn turn(yaw: f64) -> Quaternion {
    Quaternion { x: 0.0, y: 0.0, z: (yaw / 2.0).sin(), w: (yaw / 2.0).cos() }
}

impl Quaternion {
    /// Its turn about the vertical, in radians.
    pub(crate) fn yaw(&self) -> f64 {
        let Self { x, y, z, w } = self;
        (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z))
    }
}

impl Pose {
    /// Where it is on the plane; none where a number is none.
    pub(crate) fn place(&self) -> Option<Place> {
        let Self { position: Point { x, y, .. }, orientation } = self;
        let place = Place { x: *x, y: *y, yaw: orientation.yaw() };
        [place.x, place.y, place.yaw].iter().all(|number| number.is_finite()).then_some(place)
    }
}

/// cm and degrees → a pose of ROS.
pub(crate) fn pose(x: f64, y: f64, heading_deg: f64) -> Pose {
    let position = Point { x: x / 100.0, y: y / 100.0, z: 0.0 };
    Pose { position, orientation: turn(heading_deg.to_radians()) }
}

pub(crate) fn header(frame: &str) -> Header {
    Header { stamp: Time::now(), frame_id: frame.to_owned() }
}
