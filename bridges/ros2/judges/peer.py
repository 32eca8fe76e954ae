"""A robot of ROS 2 as far as the bridge sees one, on another make's DDS (Eclipse Cyclone): tf, odometry, a laser, and Nav2's
follow_path and navigate_to_pose with the topics, types and service headers of rmw_cyclonedds."""

import math
import threading
import time
import types
from dataclasses import dataclass

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import array, float32, float64, int8, int32, sequence, uint8, uint16, uint32
from cyclonedds.internal import InvalidSample
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration


@dataclass
class Time(IdlStruct, typename="builtin_interfaces.msg.dds_.Time_"):
    sec: int32
    nanosec: uint32


@dataclass
class Header(IdlStruct, typename="std_msgs.msg.dds_.Header_"):
    stamp: Time
    frame_id: str


@dataclass
class Point(IdlStruct, typename="geometry_msgs.msg.dds_.Point_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Vector3(IdlStruct, typename="geometry_msgs.msg.dds_.Vector3_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Quaternion(IdlStruct, typename="geometry_msgs.msg.dds_.Quaternion_"):
    x: float64
    y: float64
    z: float64
    w: float64


@dataclass
class Pose(IdlStruct, typename="geometry_msgs.msg.dds_.Pose_"):
    position: Point
    orientation: Quaternion


@dataclass
class PoseStamped(IdlStruct, typename="geometry_msgs.msg.dds_.PoseStamped_"):
    header: Header
    pose: Pose


@dataclass
class Path(IdlStruct, typename="nav_msgs.msg.dds_.Path_"):
    header: Header
    poses: sequence[PoseStamped]


@dataclass
class PoseWithCovariance(IdlStruct, typename="geometry_msgs.msg.dds_.PoseWithCovariance_"):
    pose: Pose
    covariance: array[float64, 36]


@dataclass
class PoseWithCovarianceStamped(IdlStruct, typename="geometry_msgs.msg.dds_.PoseWithCovarianceStamped_"):
    header: Header
    pose: PoseWithCovariance


@dataclass
class Twist(IdlStruct, typename="geometry_msgs.msg.dds_.Twist_"):
    linear: Vector3
    angular: Vector3


@dataclass
class TwistWithCovariance(IdlStruct, typename="geometry_msgs.msg.dds_.TwistWithCovariance_"):
    twist: Twist
    covariance: array[float64, 36]


@dataclass
class Odometry(IdlStruct, typename="nav_msgs.msg.dds_.Odometry_"):
    header: Header
    child_frame_id: str
    pose: PoseWithCovariance
    twist: TwistWithCovariance


@dataclass
class Transform(IdlStruct, typename="geometry_msgs.msg.dds_.Transform_"):
    translation: Vector3
    rotation: Quaternion


@dataclass
class TransformStamped(IdlStruct, typename="geometry_msgs.msg.dds_.TransformStamped_"):
    header: Header
    child_frame_id: str
    transform: Transform


@dataclass
class TFMessage(IdlStruct, typename="tf2_msgs.msg.dds_.TFMessage_"):
    transforms: sequence[TransformStamped]


@dataclass
class LaserScan(IdlStruct, typename="sensor_msgs.msg.dds_.LaserScan_"):
    header: Header
    angle_min: float32
    angle_max: float32
    angle_increment: float32
    time_increment: float32
    scan_time: float32
    range_min: float32
    range_max: float32
    ranges: sequence[float32]
    intensities: sequence[float32]


@dataclass
class MapMetaData(IdlStruct, typename="nav_msgs.msg.dds_.MapMetaData_"):
    map_load_time: Time
    resolution: float32
    width: uint32
    height: uint32
    origin: Pose


@dataclass
class OccupancyGrid(IdlStruct, typename="nav_msgs.msg.dds_.OccupancyGrid_"):
    header: Header
    info: MapMetaData
    data: sequence[int8]


@dataclass
class ColorRGBA(IdlStruct, typename="std_msgs.msg.dds_.ColorRGBA_"):
    r: float32
    g: float32
    b: float32
    a: float32


@dataclass
class CompressedImage(IdlStruct, typename="sensor_msgs.msg.dds_.CompressedImage_"):
    header: Header
    format: str
    data: sequence[uint8]


@dataclass
class UVCoordinate(IdlStruct, typename="visualization_msgs.msg.dds_.UVCoordinate_"):
    u: float32
    v: float32


@dataclass
class MeshFile(IdlStruct, typename="visualization_msgs.msg.dds_.MeshFile_"):
    filename: str
    data: sequence[uint8]


@dataclass
class Marker(IdlStruct, typename="visualization_msgs.msg.dds_.Marker_"):
    header: Header
    ns: str
    id: int32
    type: int32
    action: int32
    pose: Pose
    scale: Vector3
    color: ColorRGBA
    lifetime: Time
    frame_locked: bool
    points: sequence[Point]
    colors: sequence[ColorRGBA]
    texture_resource: str
    texture: CompressedImage
    uv_coordinates: sequence[UVCoordinate]
    text: str
    mesh_resource: str
    mesh_file: MeshFile
    mesh_use_embedded_materials: bool


@dataclass
class MarkerArray(IdlStruct, typename="visualization_msgs.msg.dds_.MarkerArray_"):
    markers: sequence[Marker]


@dataclass
class KeyValue(IdlStruct, typename="diagnostic_msgs.msg.dds_.KeyValue_"):
    key: str
    value: str


@dataclass
class DiagnosticStatus(IdlStruct, typename="diagnostic_msgs.msg.dds_.DiagnosticStatus_"):
    level: uint8
    name: str
    message: str
    hardware_id: str
    values: sequence[KeyValue]


@dataclass
class DiagnosticArray(IdlStruct, typename="diagnostic_msgs.msg.dds_.DiagnosticArray_"):
    header: Header
    status: sequence[DiagnosticStatus]


def service(package, kind, name, request, response):
    """The two types of a service, each behind the header by which rmw_cyclonedds tells calls apart."""
    made = []
    for side, fields in (("Request", request), ("Response", response)):
        annotations = {"header": array[uint8, 16], **fields}
        called = {"typename": f"{package}.{kind}.dds_.{name}_{side}_"}
        cls = types.new_class(f"{name}_{side}", (IdlStruct,), called, lambda space: space.update(__annotations__=annotations, __module__=__name__))
        made.append(dataclass(cls))
    return made


Id = array[uint8, 16]
GOAL = {"goal_id": Id}
FollowPathGoal = service(
    "nav2_msgs", "action", "FollowPath_SendGoal",
    {**GOAL, "path": Path, "controller_id": str, "goal_checker_id": str, "progress_checker_id": str},
    {"accepted": bool, "stamp": Time},
)
FollowPathResult = service("nav2_msgs", "action", "FollowPath_GetResult", GOAL, {"status": int8, "error_code": uint16, "error_msg": str})
NavigateGoal = service("nav2_msgs", "action", "NavigateToPose_SendGoal", {**GOAL, "pose": PoseStamped, "behavior_tree": str}, {"accepted": bool, "stamp": Time})
NavigateResult = service("nav2_msgs", "action", "NavigateToPose_GetResult", GOAL, {"status": int8, "error_code": uint16, "error_msg": str})


@dataclass
class GoalInfo(IdlStruct, typename="action_msgs.msg.dds_.GoalInfo_"):
    goal_id: Id
    stamp: Time


CancelGoal = service("action_msgs", "srv", "CancelGoal", {"goal_info": GoalInfo}, {"return_code": int8, "goals_canceling": sequence[GoalInfo]})
Ask = service("orthoframe_msgs", "srv", "Ask", {"text": str}, {"outcome": str, "text": str, "json": str})
RunGoal = service("orthoframe_msgs", "action", "Run_SendGoal", {**GOAL, "text": str}, {"accepted": bool, "stamp": Time})
RunResult = service("orthoframe_msgs", "action", "Run_GetResult", GOAL, {"status": int8, "outcome": str, "text": str, "json": str})


@dataclass
class RunFeedback(IdlStruct, typename="orthoframe_msgs.action.dds_.Run_FeedbackMessage_"):
    goal_id: Id
    event: str
    text: str
    json: str


SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
SAID = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.Volatile, Policy.History.KeepLast(100))
LATCHED = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.TransientLocal, Policy.History.KeepLast(10))
SENSED = Qos(Policy.Reliability.BestEffort, Policy.Durability.Volatile, Policy.History.KeepLast(5))


def now():
    at = time.time()
    return Time(int(at), int(at % 1 * 1e9))


def turn(yaw):
    return Quaternion(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


def rows_of(spread):
    """Six by six, row by row, of variances and covariances of x, y and the turn about z."""
    rows = [0.0] * 36
    for (one, other), value in spread.items():
        for at in (6 * one + other, 6 * other + one):
            rows[at] = value
    return rows


def yaw(q):
    return 2 * math.atan2(q.z, q.w)


class Reader(DataReader):
    """Without the samples that tell of a writer that is gone."""

    def take(self, count=100):
        return [sample for sample in super().take(count) if not isinstance(sample, InvalidSample)]


class Node:
    def __init__(self, domain):
        self.part = DomainParticipant(domain)

    def writer(self, topic, kind, qos=SAID):
        return DataWriter(self.part, Topic(self.part, topic, kind, qos=qos), qos=qos)

    def reader(self, topic, kind, qos=SAID):
        return Reader(self.part, Topic(self.part, topic, kind, qos=qos), qos=qos)

    def serves(self, name, kinds):
        return self.reader(f"rq/{name}Request", kinds[0]), self.writer(f"rr/{name}Reply", kinds[1])

    def asks(self, name, kinds):
        return self.writer(f"rq/{name}Request", kinds[0]), self.reader(f"rr/{name}Reply", kinds[1])


class Robot(Node):
    """Drives where it is told at a steady pace; says where it is. Offset: how its odometry stands on the map."""

    def __init__(self, domain, at, speed=0.5, offset=(0.0, 0.0, 0.0), ranges=None, spread=None):
        super().__init__(domain)
        self.at, self.speed, self.offset, self.ranges = list(at), speed, offset, ranges
        self.tf, self.odom = self.writer("rt/tf", TFMessage), self.writer("rt/odom", Odometry, SENSED)
        self.scan = self.writer("rt/scan", LaserScan, SENSED)
        if spread:
            # As AMCL says it: once, and for who comes later.
            self.localised = self.writer("rt/amcl_pose", PoseWithCovarianceStamped, LATCHED)
            pose = Pose(Point(at[0], at[1], 0.0), turn(at[2]))
            self.localised.write(PoseWithCovarianceStamped(Header(now(), "map"), PoseWithCovariance(pose, rows_of(spread))))
        self.actions = {}
        for action, goal, result in (("follow_path", FollowPathGoal, FollowPathResult), ("navigate_to_pose", NavigateGoal, NavigateResult)):
            base = f"{action}/_action"
            self.actions[action] = (self.serves(f"{base}/send_goal", goal), self.serves(f"{base}/get_result", result), self.serves(f"{base}/cancel_goal", CancelGoal), goal, result)
        self.goal, self.ended, self.waiting, self.driven, self.canceled = None, {}, [], [], 0
        self.is_silent = self.is_deaf = self.is_stubborn = False
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        step, told = 0.02, 0
        while not self.over.wait(step):
            if not self.is_deaf:
                self.hear()
            self.drive(step)
            told += step
            if not self.is_silent and told >= 0.05:
                told = 0
                self.tell()

    def tell(self):
        x, y, heading = self.at
        zeros = [0.0] * 36
        ox, oy, oyaw = self.offset
        # Where the odometry has the robot: the map's place seen from the odometry's origin.
        dx, dy = x - ox, y - oy
        lx, ly = math.cos(-oyaw) * dx - math.sin(-oyaw) * dy, math.sin(-oyaw) * dx + math.cos(-oyaw) * dy
        link = lambda parent, child, px, py, pyaw: TransformStamped(Header(now(), parent), child, Transform(Vector3(px, py, 0.0), turn(pyaw)))
        self.tf.write(TFMessage([link("map", "odom", ox, oy, oyaw), link("odom", "base_link", lx, ly, heading - oyaw)]))
        still = TwistWithCovariance(Twist(Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.0)), zeros)
        self.odom.write(Odometry(Header(now(), "odom"), "base_link", PoseWithCovariance(Pose(Point(lx, ly, 0.0), turn(heading - oyaw)), zeros), still))
        ranges = self.ranges(x, y, heading) if self.ranges else [float("inf")] * 360
        step = 2 * math.pi / len(ranges)
        self.scan.write(LaserScan(Header(now(), "base_link"), -math.pi, math.pi - step, step, 0.0, 0.05, 0.05, 10.0, ranges, []))

    def hear(self):
        for action, ((goals, accept), (results, answer), (cancels, cancelled), goal, result) in self.actions.items():
            for asked in goals.take(10):
                poses = asked.path.poses if action == "follow_path" else [asked.pose]
                assert all(p.header.frame_id in ("map", "odom") for p in poses), poses
                self.goal = (bytes(asked.goal_id), [(p.pose.position.x, p.pose.position.y, yaw(p.pose.orientation)) for p in poses])
                self.driven.append((action, self.goal[1]))
                accept.write(goal[1](asked.header, True, now()))
            for asked in results.take(10):
                self.waiting.append((answer, result, asked.header, bytes(asked.goal_id)))
            for asked in cancels.take(10):
                self.canceled += 1
                infos = []
                if self.goal and bytes(asked.goal_info.goal_id) in (self.goal[0], bytes(16)) and not self.is_stubborn:
                    infos = [GoalInfo(list(self.goal[0]), now())]
                    self.ended[self.goal[0]] = CANCELED
                    self.goal = None
                cancelled.write(CancelGoal[1](asked.header, 0, infos))
        for one in list(self.waiting):
            answer, result, header, goal_id = one
            if goal_id in self.ended:
                answer.write(result[1](header, self.ended[goal_id], 0, ""))
                self.waiting.remove(one)

    def drive(self, step):
        if not self.goal:
            return
        goal_id, way = self.goal
        left = self.speed * step
        while way and left > 0:
            x, y, heading = way[0]
            gap = math.hypot(x - self.at[0], y - self.at[1])
            if gap <= left:
                self.at, left = [x, y, heading], left - gap
                way.pop(0)
            else:
                share = left / gap
                toward = math.atan2(y - self.at[1], x - self.at[0])
                self.at = [self.at[0] + (x - self.at[0]) * share, self.at[1] + (y - self.at[1]) * share, toward]
                left = 0
        if not way:
            self.ended[goal_id] = SUCCEEDED
            self.goal = None

    def close(self):
        self.over.set()
        self.thread.join()
