//! The plan of a building as one of its robots has it, drawn by the library.

use deadpool_postgres::Transaction;

use crate::draw::{PlanDrawing, RouteLayer};
use crate::error::{FleetError, Result};
use crate::geometry::{DoorStates, FloorPlan};
use crate::language::zone_in_words;
use crate::map::{DoorStatus, World};
use crate::sheets::{revision, sheet};
use crate::units::{AreaId, Deg, DoorId, Frame, Language, MapId, Point, Pose, ReplicaId, said};

/// What of a building is wanted.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    pub building: i64,
    /// 0 is the centre.
    pub robot: i64,
    /// Its storey; the first where none is told.
    pub map: Option<u32>,
    /// Things and doors where the robot believes them to be, not where the map has them.
    pub as_believed: bool,
    pub language: Language,
}

/// The plan as SVG, with the robot where it stood last.
///
/// # Errors
/// [`FleetError::Unknown`]: there is no such robot, no map, or no such storey. [`FleetError::Database`].
pub async fn plan(transaction: &Transaction<'_>, wanted: Wanted) -> Result<String> {
    let Wanted { building, robot, .. } = wanted;
    let mut world = world(transaction, building, robot).await?;
    if wanted.as_believed {
        believe(transaction, building, robot, &mut world).await?;
    }
    let unknown = || FleetError::unknown(said!("storey-of-building", building));
    let storeys: Vec<MapId> = world.domain.maps.iter().map(|placed| placed.map).collect();
    let map = match wanted.map {
        Some(id) => storeys.iter().copied().find(|map| map.0 == id),
        None => storeys.first().copied(),
    };
    let map = map.ok_or_else(unknown)?;
    let sql = "SELECT \"MapID\", \"X\", \"Y\", \"Ang\" FROM log.\"RobotPose\" \
               WHERE building = $1 AND robot = $2 AND NOT \"Deleted\"";
    let stood = transaction.query_opt(sql, &[&building, &robot]).await?;
    let stood = stood
        .filter(|row| row.get::<_, i64>(0) == i64::from(map.0))
        .map(|row| Pose { at: Point::new(row.get(1), row.get(2)), heading: Deg::of(row.get(3)) });
    Ok(tokio::task::block_in_place(|| {
        let floor = FloorPlan::build(&world, map, &world.robot, &DoorStates::new());
        let rule = |zone| zone_in_words(&world, zone, wanted.language);
        let drawing = PlanDrawing {
            route: RouteLayer { start: stood, ..RouteLayer::default() },
            ..PlanDrawing::of(&world, &floor, None, wanted.language, &rule)
        };
        drawing.to_svg()
    }))
}

/// A robot's map as it is here; robot 0 is the centre.
///
/// # Errors
/// As [`plan`].
pub async fn world(transaction: &Transaction<'_>, building: i64, robot: i64) -> Result<World> {
    let last = revision(transaction, building, robot).await?;
    let records = sheet(transaction, building, robot, last).await?;
    let none = || FleetError::unknown(said!("map-of-building", building));
    records.world()?.ok_or_else(none)
}

/// Puts things and doors where the robot believes them to be. A belief about another survey of a thing counts no more.
async fn believe(
    transaction: &Transaction<'_>,
    building: i64,
    robot: i64,
    world: &mut World,
) -> Result<()> {
    let id = |row: &tokio_postgres::Row, at: usize| u32::try_from(row.get::<_, i64>(at)).ok();
    let sql = "SELECT b.\"ReplID\", b.\"AreaID\", b.\"X\", b.\"Y\", b.\"Z\", b.\"Ang\" FROM log.\"Beliefs\" b \
               JOIN map.\"AreaObjects\" t ON t.building = b.building AND t.robot = b.robot AND t.\"ReplID\" = b.\"ReplID\" \
                 AND t.revision_to IS NULL AND NOT t.\"Deleted\" AND t.revision = b.\"Survey\" \
               WHERE b.building = $1 AND b.robot = $2 AND NOT b.\"Deleted\" AND b.\"Confidence\" >= 0.5";
    for row in transaction.query(sql, &[&building, &robot]).await? {
        let (Some(thing), Some(area)) = (id(&row, 0), id(&row, 1)) else { continue };
        let is_room = world.areas.contains_key(&AreaId(area));
        if let Some(thing) = world.replicas.get_mut(&ReplicaId(thing)).filter(|_| is_room) {
            thing.area = AreaId(area);
            thing.frame = Frame::new(row.get(2), row.get(3), row.get(4), Deg::of(row.get(5)));
        }
    }
    let sql = "SELECT \"DoorID\", \"Status\", \"Opening\" FROM log.\"DoorStates\" \
               WHERE building = $1 AND robot = $2 AND NOT \"Deleted\"";
    for row in transaction.query(sql, &[&building, &robot]).await? {
        let Some(door) = id(&row, 0).and_then(|id| world.doors.get_mut(&DoorId(id))) else {
            continue;
        };
        door.state.status = match row.get::<_, &str>(1) {
            "open" => DoorStatus::Open,
            "locked" => DoorStatus::Locked,
            _ => DoorStatus::Closed,
        };
        door.state.opening = row.get(2);
    }
    Ok(())
}
