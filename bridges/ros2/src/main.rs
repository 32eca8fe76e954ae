//! `ortho-ros2`: orthoframe among the nodes of ROS 2, by DDS alone; no ROS need be installed. See docs/ros2.md.
//!
//! As a vehicle it is the robot of one mission (`ortho do … --vehicle "cmd:ortho-ros2 vehicle …"`); as a node it answers
//! questions and takes orders for all, shows the map, and has `ortho` carry the orders out with itself as the vehicle.
//! It speaks with `ortho` by its documented outputs alone, and shares no code with it.

mod certainty;
mod frames;
mod house;
mod messages;
mod ros;
mod service;
mod vehicle;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};
use ros2_client::ServiceMapping;

use ros::{Fault, Ros};

#[derive(Debug, Parser)]
#[command(
    name = "ortho-ros2",
    version,
    about = "orthoframe among the nodes of ROS 2, without an installed ROS"
)]
struct Arguments {
    #[command(subcommand)]
    role: Role,
}

#[derive(Debug, Subcommand)]
enum Role {
    /// The robot of one mission: the vehicle protocol on standard streams, Nav2's actions on the other side
    Vehicle(VehicleArgs),
    /// Services and actions for all: /orthoframe/ask, /orthoframe/run; /map, /orthoframe/markers, /diagnostics
    Node(NodeArgs),
}

/// How services of ROS are mapped to topics of DDS.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Rmw {
    /// rmw_fastrtps_cpp, ROS 2's own choice
    Fastrtps,
    /// rmw_cyclonedds_cpp
    Cyclonedds,
}

#[derive(Debug, Clone, Args)]
struct Wire {
    /// The DDS domain
    #[arg(long, env = "ROS_DOMAIN_ID", default_value_t = 0, value_name = "N")]
    domain: u16,
    /// The middleware of the other nodes
    #[arg(long, value_enum, default_value_t = Rmw::Fastrtps)]
    rmw: Rmw,
}

impl Wire {
    fn join(&self, name: &str) -> Result<Ros, Fault> {
        let mapping = match self.rmw {
            Rmw::Fastrtps => ServiceMapping::Enhanced,
            Rmw::Cyclonedds => ServiceMapping::Cyclone,
        };
        Ros::new(name, self.domain, mapping)
    }
}

#[derive(Debug, Clone, Args)]
struct VehicleArgs {
    #[command(flatten)]
    wire: Wire,
    /// The name of the map on which the robot drives
    #[arg(long, value_name = "NAME")]
    map: String,
    /// The frame of ROS that is the map's
    #[arg(long, default_value = "map", value_name = "FRAME")]
    map_frame: String,
    #[arg(long, default_value = "odom", value_name = "FRAME")]
    odom_frame: String,
    #[arg(long, default_value = "base_link", value_name = "FRAME")]
    base_frame: String,
    /// Take /odom for where the robot is, and have the mission find it on the map by its scans
    #[arg(long)]
    odometry: bool,
    /// Ask navigate_to_pose for one corner after the other, where there is no follow_path
    #[arg(long)]
    poses: bool,
    /// Of the laser above the floor
    #[arg(long, default_value_t = 20.0, value_name = "CM")]
    laser: f64,
    /// How long a node of which something is awaited may keep silent
    #[arg(long, default_value = "5", value_name = "SECONDS", value_parser = seconds)]
    silence: Duration,
}

#[derive(Debug, Clone, Args)]
struct NodeArgs {
    #[command(flatten)]
    wire: Wire,
    /// The program `ortho`
    #[arg(long, default_value = "ortho", value_name = "PATH")]
    ortho: PathBuf,
    /// Its store
    #[arg(long, env = "ORTHO_STORE", default_value = "ortho-store", value_name = "DIR")]
    store: PathBuf,
    /// The storey that is shown on /map; may be left out when there is only one
    #[arg(long, value_name = "NAME")]
    floor: Option<String>,
    /// What carries orders out, as of `ortho do --vehicle`; the simulator when left out
    #[arg(long, value_name = "ADDRESS")]
    vehicle: Option<String>,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "a number of seconds is wanted, such as 5 or 0.5".to_owned())
}

fn main() -> ExitCode {
    let done = match Arguments::parse().role {
        Role::Vehicle(args) => drive(args),
        Role::Node(args) => serve(&args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("ortho-ros2: {why}");
            ExitCode::from(3)
        }
    }
}

fn drive(args: VehicleArgs) -> Result<(), Fault> {
    let ros = args.wire.join("orthoframe_vehicle")?;
    let robot = vehicle::Robot {
        map: args.map,
        map_frame: args.map_frame,
        odom_frame: args.odom_frame,
        base_frame: args.base_frame,
        by_odometry: args.odometry,
        by_poses: args.poses,
        laser_height_cm: args.laser,
        patience: args.silence,
    };
    vehicle::Vehicle::new(ros, robot)?.serve()
}

fn serve(args: &NodeArgs) -> Result<(), Fault> {
    let house = house::House {
        ortho: args.ortho.clone(),
        store: args.store.clone(),
        floor: args.floor.clone(),
        vehicle: args.vehicle.clone(),
    };
    let ros = args.wire.join("orthoframe")?;
    service::Service::new(ros, house)?.serve()
}
