//! The robot of a mission: orders of the vehicle protocol (docs/vehicle.md) on standard input become goals of Nav2's
//! actions; where the robot is and what it sees is said on standard output.
//!
//! **Invariant.** A peer of which nothing is heard for as long as the patience lasts ends the mission: `failed`, with the
//! name of what is silent. Of what a robot on wheels cannot do (doors, things, lifts) nothing is made up: it is `failed`
//! too, and the map should not ask it of this robot.

use std::future::Future as _;
use std::io::{BufRead, Write};
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::task::{Context, Waker};
use std::time::{Duration, Instant};

use ros2_client::action::{ActionClient, GoalId, GoalStatusEnum};
use ros2_client::{Message, Node, Publisher, RmwRequestId, Subscription};
use serde_json::{Value, json};

use crate::certainty::{Found, Spread};
use crate::frames::{Frames, Place};
use crate::messages::{
    FollowPathGoal, LaserScan, NavigateGoal, Nothing, Odometry, Path, PoseStamped,
    PoseWithCovariance, PoseWithCovarianceStamped, TransformArray, header, pose,
};
use crate::ros::{Fault, Kept, Ros};

/// Between two looks at what was heard.
const GLANCE: Duration = Duration::from_millis(10);
/// Between two words that the robot is under way.
const GOING: Duration = Duration::from_millis(250);

/// What the robot is like.
#[derive(Debug, Clone)]
pub(crate) struct Robot {
    /// The map's name.
    pub(crate) map: String,
    pub(crate) map_frame: String,
    pub(crate) odom_frame: String,
    pub(crate) base_frame: String,
    /// Where it stands is what its wheels count: the mission finds it by its scans.
    pub(crate) by_odometry: bool,
    /// Poses one after the other, where the robot offers no follow_path.
    pub(crate) by_poses: bool,
    pub(crate) laser_height_cm: f64,
    pub(crate) patience: Duration,
}

/// What Nav2 is asked by.
enum Wheels {
    Path(ActionClient<FollowPathGoal, Nothing, Nothing>),
    Poses(ActionClient<NavigateGoal, Nothing, Nothing>),
}

pub(crate) struct Vehicle {
    robot: Robot,
    wheels: Wheels,
    tf: Subscription<TransformArray>,
    tf_static: Subscription<TransformArray>,
    odometry: Subscription<Odometry>,
    localised: Subscription<PoseWithCovarianceStamped>,
    scans: Subscription<LaserScan>,
    path: Publisher<Path>,
    pose: Publisher<PoseWithCovarianceStamped>,
    frames: Frames,
    /// How often it was told where the robot stands.
    told: u64,
    moved: Option<(Instant, Place)>,
    /// How sure the wheels are, where they tell it; and where it was found last.
    wheels_spread: Option<Spread>,
    found: Option<Found>,
    scan: Option<LaserScan>,
    begun: Instant,
    orders: Receiver<Value>,
    ros: Ros,
}

/// How an order ends.
enum End {
    Say(Value),
    /// The robot is of no more use.
    Failed(Fault),
}

impl Vehicle {
    pub(crate) fn new(mut ros: Ros, robot: Robot) -> Result<Self, Fault> {
        let wheels = match robot.by_poses {
            true => Wheels::Poses(
                ros.action_client("/navigate_to_pose", ("nav2_msgs", "NavigateToPose"))?,
            ),
            false => Wheels::Path(ros.action_client("/follow_path", ("nav2_msgs", "FollowPath"))?),
        };
        let tf = ("tf2_msgs", "TFMessage");
        let (said, orders) = mpsc::channel();
        std::thread::spawn(move || {
            for line in std::io::stdin().lock().lines() {
                let Ok(line) = line else { break };
                let order = serde_json::from_str(&line).unwrap_or(Value::Null);
                if said.send(order).is_err() {
                    break;
                }
            }
        });
        Ok(Self {
            tf: ros.subscribe("/tf", tf, Kept::Said)?,
            tf_static: ros.subscribe("/tf_static", tf, Kept::Latched)?,
            odometry: ros.subscribe("/odom", ("nav_msgs", "Odometry"), Kept::Newest)?,
            // AMCL says it when it was corrected, and keeps it for who comes later.
            localised: ros.subscribe(
                "/amcl_pose",
                ("geometry_msgs", "PoseWithCovarianceStamped"),
                Kept::Latched,
            )?,
            scans: ros.subscribe("/scan", ("sensor_msgs", "LaserScan"), Kept::Newest)?,
            path: ros.publish("/orthoframe/path", ("nav_msgs", "Path"), Kept::Latched)?,
            pose: ros.publish(
                "/orthoframe/pose",
                ("geometry_msgs", "PoseWithCovarianceStamped"),
                Kept::Said,
            )?,
            robot,
            wheels,
            frames: Frames::default(),
            told: 0,
            moved: None,
            wheels_spread: None,
            found: None,
            scan: None,
            begun: Instant::now(),
            orders,
            ros,
        })
    }

    /// Serves one mission, until its input ends.
    ///
    /// # Errors
    /// Standard output is gone.
    pub(crate) fn serve(&mut self) -> Result<(), Fault> {
        loop {
            self.listen();
            match self.orders.try_recv() {
                Ok(order) => self.heed(&order)?,
                Err(TryRecvError::Empty) => std::thread::sleep(GLANCE),
                Err(TryRecvError::Disconnected) => return Ok(()),
            }
        }
    }

    /// Takes up what was said meanwhile.
    fn listen(&mut self) {
        // What cannot be read was said by another kind of node, and is as silence.
        while let Ok(Some((told, _))) = self.tf.take() {
            self.frames.hear(&told.transforms, false);
            let is_of = |frame: &str| frame.trim_start_matches('/') == self.robot.base_frame;
            let is_its = told.transforms.iter().any(|link| is_of(&link.child_frame_id));
            self.told += u64::from(is_its && !self.robot.by_odometry);
        }
        while let Ok(Some((told, _))) = self.tf_static.take() {
            self.frames.hear(&told.transforms, true);
        }
        while let Ok(Some((told, _))) = self.odometry.take() {
            if let Some(place) = told.pose.pose.place() {
                self.moved = Some((Instant::now(), place));
                self.wheels_spread = Spread::of(&told.pose.covariance);
                self.told += u64::from(self.robot.by_odometry);
            }
        }
        while let Ok(Some((told, _))) = self.localised.take() {
            let is_of_map = told.header.frame_id.trim_start_matches('/') == self.robot.map_frame;
            let (place, spread) = (told.pose.pose.place(), Spread::of(&told.pose.covariance));
            if let (true, Some(place), Some(spread)) = (is_of_map, place, spread) {
                self.found = Some(Found::new(place, spread, self.wheels_spread));
            }
        }
        while let Ok(Some((told, _))) = self.scans.take() {
            self.scan = Some(told);
        }
    }

    fn place(&self) -> Result<Place, Fault> {
        let (robot, patience) = (&self.robot, self.robot.patience);
        if !robot.by_odometry {
            return self.frames.place(&robot.base_frame, &robot.map_frame, patience);
        }
        match self.moved {
            Some((heard, place)) if heard.elapsed() <= patience => Ok(place),
            Some((heard, _)) => {
                Err(format!("no odometry on /odom for {:.1} s", heard.elapsed().as_secs_f64()))
            }
            None => Err("no odometry on /odom".to_owned()),
        }
    }

    /// The same, waited for while the robot's nodes come up.
    fn place_soon(&mut self) -> Result<Place, Fault> {
        let until = Instant::now() + self.robot.patience;
        loop {
            self.listen();
            match self.place() {
                Ok(place) => return Ok(place),
                Err(missing) if Instant::now() > until => return Err(missing),
                Err(_) => std::thread::sleep(GLANCE),
            }
        }
    }

    /// Waits until it was told anew where the robot stands: what was said before its goal was reached may come after. A robot
    /// that says nothing more is told of by [`Self::place`].
    fn await_place(&mut self) {
        let (until, told) = (Instant::now() + self.robot.patience, self.told + 2);
        while self.told < told && Instant::now() < until {
            std::thread::sleep(GLANCE);
            self.listen();
        }
    }

    /// Waits until the server of its action is known: what is asked before that is heard by nobody.
    fn meet(&self) -> Result<(), Fault> {
        let until = Instant::now() + self.robot.patience;
        let mut meeting = std::pin::pin!(self.wheels.meet(self.ros.node()));
        let mut context = Context::from_waker(Waker::noop());
        while meeting.as_mut().poll(&mut context).is_pending() {
            if Instant::now() > until {
                let (action, seconds) = (self.wheels.action(), self.robot.patience.as_secs_f64());
                return Err(format!("nobody has offered {action} for {seconds:.1} s"));
            }
            std::thread::sleep(GLANCE);
        }
        Ok(())
    }

    fn say(&self, id: &Value, place: Place, what: Value) -> Result<(), Fault> {
        let mut line = json!({
            "id": id, "time": self.begun.elapsed().as_secs_f64(),
            "at": {
                "map": self.robot.map, "x": place.x * 100.0, "y": place.y * 100.0,
                "heading": place.yaw.to_degrees().rem_euclid(360.0),
            },
        });
        if let (Value::Object(line), Value::Object(what)) = (&mut line, what) {
            line.extend(what);
        }
        let mut out = std::io::stdout().lock();
        writeln!(out, "{line}")
            .and_then(|()| out.flush())
            .map_err(|e| format!("the mission is gone: {e}"))
    }

    fn heed(&mut self, order: &Value) -> Result<(), Fault> {
        let id = order["id"].clone();
        let end = match order["do"].as_str() {
            Some("hello") => match self.place_soon().and_then(|_| self.meet()) {
                Ok(()) => End::Say(json!({
                    "say": "ready", "protocol": 1, "name": "ROS 2", "odometry": self.robot.by_odometry,
                })),
                Err(missing) => End::Failed(missing),
            },
            Some("follow") => self.follow(&id, order)?,
            Some("report") => End::Say(json!({ "say": "done" })),
            Some("look_round") => {
                self.tell_scan(&id)?;
                End::Say(json!({ "say": "done" }))
            }
            // It has no eye that names what it sees.
            Some("sees" | "look_at") => End::Say(json!({ "say": "seen", "sighting": null })),
            // What is no longer under way cannot be stopped.
            Some("cancel") => return Ok(()),
            Some(verb) => End::Failed(format!("a robot of ROS 2 that only drives cannot {verb}")),
            None => End::Failed("an order was not understood".to_owned()),
        };
        self.listen();
        let place = self.place();
        let (place, end) = match (place, end) {
            (Ok(place), end) => (place, end),
            (Err(_), End::Failed(why)) => (Place { x: 0.0, y: 0.0, yaw: 0.0 }, End::Failed(why)),
            (Err(missing), End::Say(_)) => {
                (Place { x: 0.0, y: 0.0, yaw: 0.0 }, End::Failed(missing))
            }
        };
        match end {
            End::Say(what) => self.say(&id, place, what),
            End::Failed(why) => {
                eprintln!("ortho-ros2: {why}");
                self.say(&id, place, json!({ "say": "failed", "text": why }))
            }
        }
    }

    /// The newest scan, once.
    fn tell_scan(&mut self, id: &Value) -> Result<(), Fault> {
        let (Some(scan), Ok(place)) = (self.scan.take(), self.place()) else { return Ok(()) };
        let met = |range: &f32| {
            let is_met = range.is_finite() && *range >= scan.range_min && *range <= scan.range_max;
            is_met.then(|| f64::from(*range) * 100.0)
        };
        let ranges: Vec<Option<f64>> = scan.ranges.iter().map(met).collect();
        let degrees = |angle: f32| f64::from(angle).to_degrees();
        let told = json!({
            "say": "scan", "height": self.robot.laser_height_cm, "from": degrees(scan.angle_min),
            "step": degrees(scan.angle_increment), "ranges": ranges,
        });
        self.say(id, place, told)
    }

    /// Drives along a path. The outer error is that nobody listens any more.
    fn follow(&mut self, id: &Value, order: &Value) -> Result<End, Fault> {
        let number = |value: &Value| value.as_f64().filter(|number| number.is_finite());
        let point = |value: &Value| Some((number(&value[0])?, number(&value[1])?));
        let points: Option<Vec<(f64, f64)>> =
            order["path"].as_array().and_then(|path| path.iter().map(point).collect());
        let Some(points) = points.filter(|points| !points.is_empty()) else {
            return Ok(End::Failed("a path was not understood".to_owned()));
        };
        let Ok(here) = self.place() else {
            return Ok(End::Failed(self.place().err().unwrap_or_default()));
        };
        let frame = match self.robot.by_odometry {
            true => self.robot.odom_frame.clone(),
            false => self.robot.map_frame.clone(),
        };
        let poses = poses(&frame, here, &points, order["heading"].as_f64());
        let path = Path { header: header(&frame), poses };
        // Who only looks on may be gone.
        let _ = self.path.publish(path.clone());
        let goals = match self.robot.by_poses {
            true => path.poses.into_iter().skip(1).map(Goal::Pose).collect(),
            false => vec![Goal::Path(path)],
        };
        for goal in goals {
            match self.drive(id, goal)? {
                End::Say(what) if what["say"] == "done" => {}
                end => return Ok(end),
            }
        }
        self.await_place();
        Ok(End::Say(json!({ "say": "done" })))
    }

    fn drive(&mut self, id: &Value, goal: Goal) -> Result<End, Fault> {
        let action = self.wheels.action();
        let (asked, goal) = match self.wheels.send(goal) {
            Ok(sent) => sent,
            Err(why) => return Ok(End::Failed(format!("{action}: {why}"))),
        };
        let until = Instant::now() + self.robot.patience;
        let accepted = loop {
            self.listen();
            match self.wheels.is_accepted(asked) {
                Some(accepted) => break accepted,
                None if Instant::now() > until => {
                    let seconds = self.robot.patience.as_secs_f64();
                    return Ok(End::Failed(format!("nobody answered {action} for {seconds:.1} s")));
                }
                None => std::thread::sleep(GLANCE),
            }
        };
        if !accepted {
            return Ok(End::Failed(format!("{action} refused the goal")));
        }
        let result = match self.wheels.ask_result(goal) {
            Ok(result) => result,
            Err(why) => return Ok(End::Failed(format!("{action}: {why}"))),
        };
        let (mut told, mut is_stopped, mut lost) = (Instant::now(), None, None);
        loop {
            self.listen();
            if let Some(status) = self.wheels.result(result) {
                return Ok(match (status, lost, is_stopped) {
                    (_, Some(missing), _) => End::Failed(missing),
                    (GoalStatusEnum::Succeeded, ..) => End::Say(json!({ "say": "done" })),
                    (GoalStatusEnum::Canceled, _, Some(_)) => End::Say(json!({ "say": "stopped" })),
                    (status, ..) => End::Failed(format!("{action} ended with {status:?}")),
                });
            }
            match self.orders.try_recv() {
                Ok(order) if order["do"] == "cancel" => {
                    is_stopped.get_or_insert_with(Instant::now);
                    self.wheels.cancel(goal);
                }
                // One order is under way at a time.
                Ok(_) => {
                    return Ok(End::Failed(
                        "a second order came before the first was done".to_owned(),
                    ));
                }
                Err(TryRecvError::Empty) => {}
                // The mission is gone: a vehicle stops by itself.
                Err(TryRecvError::Disconnected) => {
                    self.wheels.cancel(goal);
                    std::thread::sleep(Duration::from_millis(200));
                    return Err("the mission is gone".to_owned());
                }
            }
            let place = match self.place() {
                Ok(place) => place,
                Err(missing) => {
                    // It does not drive blind; whether it stops is not heard either.
                    self.wheels.cancel(goal);
                    lost.get_or_insert(missing);
                    let silent = is_stopped.get_or_insert_with(Instant::now).elapsed();
                    if silent > self.robot.patience {
                        return Ok(End::Failed(lost.unwrap_or_default()));
                    }
                    std::thread::sleep(GLANCE);
                    continue;
                }
            };
            if let Some(since) = is_stopped.filter(|since| since.elapsed() > self.robot.patience) {
                let seconds = since.elapsed().as_secs_f64();
                return Ok(End::Failed(format!(
                    "{action} was to stop and has not for {seconds:.1} s"
                )));
            }
            if told.elapsed() >= GOING {
                told = Instant::now();
                self.say(id, place, json!({ "say": "going" }))?;
                self.tell_scan(id)?;
                self.tell_pose(place);
            }
            std::thread::sleep(GLANCE);
        }
    }

    /// Where the mission has the robot, and how sure that is by who says so: the localisation, or the wheels.
    fn tell_pose(&self, place: Place) {
        let spread = match self.robot.by_odometry {
            true => self.wheels_spread,
            false => self.found.map(|found| found.now(place, self.wheels_spread)),
        };
        let frame =
            if self.robot.by_odometry { &self.robot.odom_frame } else { &self.robot.map_frame };
        let pose = pose(place.x * 100.0, place.y * 100.0, place.yaw.to_degrees());
        let pose = PoseWithCovariance { pose, covariance: Spread::told(spread) };
        // Who only looks on may be gone.
        let _ = self.pose.publish(PoseWithCovarianceStamped { header: header(frame), pose });
    }
}

/// One goal of Nav2.
enum Goal {
    Path(Path),
    Pose(PoseStamped),
}

impl Wheels {
    fn action(&self) -> &'static str {
        match self {
            Self::Path(_) => "follow_path",
            Self::Poses(_) => "navigate_to_pose",
        }
    }

    async fn meet(&self, node: &Node) {
        async fn all<G: Message + Clone + 'static>(
            client: &ActionClient<G, Nothing, Nothing>,
            node: &Node,
        ) {
            client.goal_client().wait_for_service(node).await;
            client.result_client().wait_for_service(node).await;
            client.cancel_client().wait_for_service(node).await;
        }
        match self {
            Self::Path(client) => all(client, node).await,
            Self::Poses(client) => all(client, node).await,
        }
    }

    fn send(&self, goal: Goal) -> Result<(RmwRequestId, GoalId), Fault> {
        let sent = match (self, goal) {
            (Self::Path(client), Goal::Path(path)) => {
                let [controller_id, goal_checker_id, progress_checker_id] =
                    [const { String::new() }; 3];
                client.send_goal(FollowPathGoal {
                    path,
                    controller_id,
                    goal_checker_id,
                    progress_checker_id,
                })
            }
            (Self::Poses(client), Goal::Pose(pose)) => {
                client.send_goal(NavigateGoal { pose, behavior_tree: String::new() })
            }
            _ => return Err("a goal of another action".to_owned()),
        };
        sent.map_err(|e| format!("the goal cannot be sent: {e:?}"))
    }

    fn is_accepted(&self, asked: RmwRequestId) -> Option<bool> {
        let answer = match self {
            Self::Path(client) => client.receive_goal_response(asked),
            Self::Poses(client) => client.receive_goal_response(asked),
        };
        answer.ok().flatten().map(|answer| answer.accepted)
    }

    fn ask_result(&self, goal: GoalId) -> Result<RmwRequestId, Fault> {
        let asked = match self {
            Self::Path(client) => client.request_result(goal),
            Self::Poses(client) => client.request_result(goal),
        };
        asked.map_err(|e| format!("the result cannot be asked for: {e:?}"))
    }

    fn result(&self, asked: RmwRequestId) -> Option<GoalStatusEnum> {
        fn ended<G: Message + Clone + 'static>(
            client: &ActionClient<G, Nothing, Nothing>,
            asked: RmwRequestId,
        ) -> Option<GoalStatusEnum> {
            client.receive_result(asked).ok().flatten().map(|(status, _)| status)
        }
        match self {
            Self::Path(client) => ended(client, asked),
            Self::Poses(client) => ended(client, asked),
        }
    }

    /// Asks it to stop; whether it does, its status tells.
    fn cancel(&self, goal: GoalId) {
        let _ = match self {
            Self::Path(client) => client.cancel_goal(goal),
            Self::Poses(client) => client.cancel_goal(goal),
        };
    }
}

/// A path with a heading at each point: along the leg that leads on from it; at the end as asked, else along the last leg.
fn poses(
    frame: &str,
    here: Place,
    points: &[(f64, f64)],
    heading: Option<f64>,
) -> Vec<PoseStamped> {
    let start = (here.x * 100.0, here.y * 100.0);
    let all: Vec<(f64, f64)> = std::iter::once(start).chain(points.iter().copied()).collect();
    let mut along = here.yaw.to_degrees();
    let mut poses = Vec::new();
    for (no, (x, y)) in all.iter().enumerate() {
        if let Some((next_x, next_y)) = all.get(no + 1) {
            let (dx, dy) = (next_x - x, next_y - y);
            if dx.hypot(dy) > 0.1 {
                along = dy.atan2(dx).to_degrees();
            }
        } else if let Some(heading) = heading {
            along = heading;
        }
        poses.push(PoseStamped { header: header(frame), pose: pose(*x, *y, along) });
    }
    poses
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_looks_along_its_legs_and_at_its_end_as_asked() {
        let here = Place { x: 0.0, y: 0.0, yaw: 1.0 };
        let headings = |heading| -> Vec<f64> {
            let path = poses("map", here, &[(100.0, 0.0), (100.0, 50.0)], heading);
            path.iter().map(|p| p.pose.orientation.yaw().to_degrees().round()).collect()
        };
        assert_eq!(headings(None), [0.0, 90.0, 90.0]);
        assert_eq!(headings(Some(180.0)), [0.0, 90.0, 180.0]);
        // A turn on the spot keeps the place.
        let turn = poses("map", here, &[(0.0, 0.0)], Some(-90.0));
        assert_eq!(turn.len(), 2);
        assert!((turn[1].pose.orientation.yaw().to_degrees() + 90.0).abs() < 1e-9);
    }
}
