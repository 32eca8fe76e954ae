//! Named hard cases of the free floor: each is a room that broke, or might break, somebody's geometry.

use std::f64::consts::PI;

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floors::{Builder, Opening, p, rectangle, two_rooms};
use crate::remedies::FARTHEST;
use crate::routes::{check_invariants, check_route};

/// A room of 400 × 300 with boxes `[x, y, w, d, turn]`, 100 high.
pub(crate) fn room(boxes: &[[f64; 5]]) -> (Builder, AreaId) {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    for &[x, y, w, d, turn] in boxes {
        b.put(hall, x, y, w, d, turn, 100.0);
    }
    (b, hall)
}

pub(crate) fn build(b: &Builder) -> FloorPlan {
    let plan = FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new());
    check_invariants(&plan);
    plan
}

fn free_area(plan: &FloorPlan) -> f64 {
    plan.fragments().flat_map(|f| f.free().iter().map(Region::area).collect::<Vec<_>>()).sum()
}

fn raw_area(plan: &FloorPlan) -> f64 {
    plan.fragments().flat_map(|f| f.raw().iter().map(Region::area).collect::<Vec<_>>()).sum()
}

/// The length of the shortest way, checked; none if there is none.
pub(crate) fn way(b: &Builder, from: (f64, f64), to: (f64, f64)) -> Option<f64> {
    let plan = build(b);
    for method in [Method::Paper, Method::Shortest] {
        if let Ok(route) =
            plan.route(&b.world, p(from.0, from.1), Target::Point(p(to.0, to.1)), method)
        {
            check_route(&plan, &b.world, &route);
        }
    }
    let found =
        plan.route(&b.world, p(from.0, from.1), Target::Point(p(to.0, to.1)), Method::Shortest);
    found.ok().map(|r| r.length)
}

const LEFT: (f64, f64) = (40.0, 150.0);
const RIGHT: (f64, f64) = (360.0, 150.0);

#[test]
fn boxes_that_touch_along_a_side_leave_no_slit() {
    let (b, _) = room(&[[150., 0., 50., 100., 0.], [200., 0., 50., 100., 0.]]);
    let plan = build(&b);
    assert!((raw_area(&plan) - 110_000.0).abs() < 1e-3);
    assert!(plan.fragments().all(|f| f.dead_zones().is_empty()));
    assert!(way(&b, LEFT, RIGHT).is_some());
}

#[test]
fn boxes_that_touch_in_a_corner_close_the_way() {
    let (b, _) = room(&[[150., 0., 50., 150., 0.], [200., 150., 50., 150., 0.]]);
    assert_eq!(way(&b, LEFT, RIGHT), None);
}

#[test]
fn turned_boxes_that_touch_leave_no_slit_either() {
    let edge = |k: f64| {
        (
            150.0 + 60.0 * k * (17.3_f64).to_radians().cos(),
            100.0 + 60.0 * k * (17.3_f64).to_radians().sin(),
        )
    };
    let (x, y) = edge(1.0);
    let (b, _) = room(&[[150., 100., 60., 40., 17.3], [x, y, 60., 40., 17.3]]);
    let plan = build(&b);
    assert!((raw_area(&plan) - (120_000.0 - 4_800.0)).abs() < 0.1);
    let frames: usize = plan.fragments().map(|f| f.passframes().len()).sum();
    assert!(frames <= 6, "{frames}");
}

#[test]
fn duplicates_count_once() {
    let (b, _) = room(&[[150., 100., 60., 40., 30.]; 3]);
    assert!((raw_area(&build(&b)) - (120_000.0 - 2_400.0)).abs() < 0.1);
}

#[test]
fn a_box_within_a_box_changes_nothing() {
    let (one, _) = room(&[[100., 100., 100., 100., 0.]]);
    let (two, _) = room(&[[100., 100., 100., 100., 0.], [120., 120., 20., 20., 33.]]);
    assert!((free_area(&build(&one)) - free_area(&build(&two))).abs() < 1e-6);
}

#[test]
fn a_box_across_the_wall_is_cut_by_it() {
    let (b, _) = room(&[[380., 100., 60., 60., 0.]]);
    assert!((raw_area(&build(&b)) - (120_000.0 - 1_200.0)).abs() < 1e-3);
}

#[test]
fn a_box_outside_of_the_room_does_no_harm() {
    let (b, _) = room(&[[900., 900., 60., 60., 0.]]);
    assert!((free_area(&build(&b)) - 120_000.0).abs() < 1e-3);
}

#[test]
fn a_room_full_to_the_brim_has_no_floor() {
    let (b, _) = room(&[[0., 0., 400., 300., 0.]]);
    let plan = build(&b);
    assert!(raw_area(&plan).abs() < 1e-6 && plan.passframes(AreaId(2)).is_empty());
    assert_eq!(
        plan.route(&b.world, p(1., 1.), Target::Point(p(9., 9.)), Method::Shortest),
        Err(NoRoute::NoFloor)
    );
}

#[test]
fn a_room_with_less_floor_than_the_robot_is_all_dead() {
    let (b, hall) = room(&[[0., 0., 400., 260., 0.]]);
    let plan = build(&b);
    assert!(plan.passframes(hall).is_empty());
    assert!((plan.fragment(hall).unwrap().dead_zones()[0].area() - 16_000.0).abs() < 1.0);
}

#[test]
fn a_passage_as_wide_as_the_robot_is_passed() {
    let (b, _) = room(&[[180., 0., 40., 125., 0.], [180., 175., 40., 125., 0.]]);
    assert!(way(&b, LEFT, RIGHT).is_some());
}

#[test]
fn a_passage_a_millimetre_narrower_is_not() {
    let (b, _) = room(&[[180., 0., 40., 125.05, 0.], [180., 174.95, 40., 125.05, 0.]]);
    assert_eq!(way(&b, LEFT, RIGHT), None);
}

#[test]
fn a_turned_passage_as_wide_as_the_robot_is_passed() {
    let (b, _) = room(&[[180., 0., 40., 125., 0.], [180., 175., 40., 125., 0.]]);
    let b = b.moved(0.0, 0.0, 17.3);
    let outer = Frame::new(0.0, 0.0, 0.0, Deg::of(17.3));
    let (from, to) = (outer.apply(p(40., 150.)), outer.apply(p(360., 150.)));
    assert!(way(&b, (from.x, from.y), (to.x, to.y)).is_some());
}

#[test]
fn a_robot_a_millimetre_wider_than_its_door_stays_outside() {
    for (radius, passes) in [(45.0, true), (45.05, false)] {
        let (mut b, ..) = two_rooms(0.0, DoorKind::Sliding, DoorState::OPEN);
        b.world.robot.radius = Cm::of(radius);
        assert_eq!(way(&b, (100., 150.), (700., 150.)).is_some(), passes, "{radius}");
    }
}

#[test]
fn an_island_is_a_closed_zone() {
    // Four long boxes fence the middle in.
    let fence = [
        [100., 80., 200., 10., 0.],
        [100., 210., 200., 10., 0.],
        [100., 80., 10., 140., 0.],
        [290., 80., 10., 140., 0.],
    ];
    let (b, hall) = room(&fence);
    let plan = build(&b);
    let inside = plan.fragment(hall).unwrap().passframe_at(p(200., 150.)).unwrap();
    assert_eq!(inside.kind, PassframeKind::Closed);
    let no = plan
        .route(&b.world, p(40., 40.), Target::Point(p(200., 150.)), Method::Shortest)
        .unwrap_err();
    assert!(matches!(no.barriers(), [Barrier::Enclosed { .. }]), "{no:?}");
}

#[test]
fn a_ring_corridor_is_gone_round_the_shorter_way() {
    let (b, _) = room(&[[80., 80., 240., 140., 0.]]);
    let up = way(&b, (40., 170.), (360., 170.)).unwrap();
    let down = way(&b, (40., 130.), (360., 130.)).unwrap();
    assert!((up - down).abs() < 1e-3, "{up} {down}");
}

#[test]
fn nested_boxes_and_holes_keep_their_area() {
    // A fence within a fence.
    let mut boxes = Vec::new();
    for k in 0..3 {
        let s = 60.0 * f64::from(k);
        let (w, d) = (400.0 - 2.0 * s - 40.0, 300.0 - 2.0 * s - 20.0);
        if d > 30.0 {
            boxes.extend([
                [20. + s, 10. + s, w, 2., 0.],
                [20. + s, 8. + s + d, w, 2., 0.],
                [20. + s, 10. + s, 2., d, 0.],
                [18. + s + w, 10. + s, 2., d, 0.],
            ]);
        }
    }
    build(&room(&boxes).0);
}

#[test]
fn slivers_of_a_thousandth_do_no_harm() {
    let (b, _) = room(&[
        [100., 100., 100., 0.001, 0.],
        [100., 100.002, 100., 50., 0.],
        [200.0005, 100., 50., 50., 0.001],
    ]);
    assert!(way(&b, LEFT, RIGHT).is_some());
}

#[test]
fn a_needle_blocks_though_it_is_thin() {
    let (b, _) = room(&[[200., 0., 0.02, 300., 0.]]);
    assert_eq!(way(&b, LEFT, RIGHT), None);
}

#[test]
fn a_screen_without_thickness_blocks() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let object = b.object(&[(&[p(0., 0.), p(0., 300.), p(0., 150.)], 0.0, 150.0)]);
    b.place_object(hall, object, Frame::new(200.0, 0.0, 0.0, Deg::ZERO));
    assert_eq!(way(&b, LEFT, RIGHT), None);
}

#[test]
fn a_thing_that_is_a_point_does_no_harm() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let object = b.object(&[(&[p(0., 0.), p(0., 0.), p(0., 0.)], 0.0, 150.0)]);
    b.place_object(hall, object, Frame::new(200.0, 150.0, 0.0, Deg::ZERO));
    build(&b);
}

#[test]
fn a_shelf_without_height_blocks_in_the_robots_band_only() {
    for (z, blocks) in [(0.0, false), (1.0, false), (50.0, true), (119.0, true), (121.0, false)] {
        let mut b = Builder::new();
        let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
        let object = b.object(&[(&rectangle(40.0, 300.0), z, 0.0)]);
        b.place_object(hall, object, Frame::new(180.0, 0.0, 0.0, Deg::ZERO));
        assert_eq!(way(&b, LEFT, RIGHT).is_none(), blocks, "{z}");
    }
}

#[test]
fn four_legs_closer_than_the_robot_block_all_between_them() {
    let leg = |x: f64, y: f64| [p(x, y), p(x + 4., y), p(x + 4., y + 4.), p(x, y + 4.)];
    let legs = [leg(0., 0.), leg(30., 0.), leg(30., 30.), leg(0., 30.)];
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let stool = b.object(&legs.each_ref().map(|l| (&l[..], 0.0, 40.0)));
    b.place_object(hall, stool, Frame::new(180.0, 130.0, 0.0, Deg::ZERO));
    let plan = build(&b);
    let floor = plan.fragment(hall).unwrap();
    assert!(floor.dead_zone_at(p(197., 147.)).is_some());
    assert!(floor.passframe_at(p(197., 147.)).is_none());
}

#[test]
fn a_table_with_one_leg_on_a_plate_blocks_the_plate() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let (plate, leg, top) = (
        rectangle(60., 60.),
        [p(28., 28.), p(32., 28.), p(32., 32.), p(28., 32.)],
        [p(-20., -20.), p(80., -20.), p(80., 80.), p(-20., 80.)],
    );
    let table = b.object(&[(&plate, 0.0, 4.0), (&leg, 4.0, 126.0), (&top, 130.0, 3.0)]);
    b.place_object(hall, table, Frame::new(170.0, 120.0, 0.0, Deg::ZERO));
    assert!((raw_area(&build(&b)) - (120_000.0 - 3_600.0)).abs() < 1e-3);
}

#[test]
fn a_funnel_is_as_wide_as_the_robot_meets_it() {
    // A Uniframe twice as wide at 240; the robot is 120 high, so 1.5 times counts.
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let object = b.object(&[(&rectangle(40., 40.), 0.0, 240.0)]);
    let base = b.world.objects[&object].items[0].orthoframe;
    b.world.orthoframes.get_mut(&base).unwrap().roof_scale = 2.0;
    b.place_object(hall, object, Frame::new(180.0, 130.0, 0.0, Deg::ZERO));
    assert!((raw_area(&build(&b)) - (120_000.0 - 3_600.0)).abs() < 1e-3);
}

#[test]
fn a_pyramid_is_as_wide_as_its_foot() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let object = b.object(&[(&rectangle(40., 40.), 0.0, 100.0)]);
    let base = b.world.objects[&object].items[0].orthoframe;
    b.world.orthoframes.get_mut(&base).unwrap().roof_scale = 0.0;
    b.place_object(hall, object, Frame::new(180.0, 130.0, 0.0, Deg::ZERO));
    // What is lower than the robot's step counts no more.
    let side = 40.0 * (1.0 - 0.02);
    assert!((raw_area(&build(&b)) - (120_000.0 - side * side)).abs() < 1e-2);
}

#[test]
fn a_room_with_collinear_corners_is_one_passframe() {
    let mut b = Builder::new();
    let corners = [
        p(0., 0.),
        p(100., 0.),
        p(200., 0.),
        p(400., 0.),
        p(400., 10.),
        p(400., 300.),
        p(0., 300.),
        p(0., 1.),
    ];
    let hall = b.area("Зал", &corners, Frame::IDENTITY, &[]);
    assert_eq!(build(&b).passframes(hall).len(), 1);
}

#[test]
fn an_ell_is_two_passframes() {
    let mut b = Builder::new();
    let corners =
        [p(0., 0.), p(400., 0.), p(400., 150.), p(200., 150.), p(200., 300.), p(0., 300.)];
    let hall = b.area("Зал", &corners, Frame::IDENTITY, &[]);
    assert_eq!(build(&b).passframes(hall).len(), 2);
    assert!(way(&b, (360., 40.), (40., 260.)).is_some());
}

#[test]
fn a_comb_has_a_passframe_for_every_tooth_and_one_for_the_back() {
    let mut corners = vec![p(0., 0.), p(900., 0.), p(900., 100.)];
    for k in (0..4).rev() {
        let x = 200.0 * f64::from(k);
        corners.extend([p(x + 100., 100.), p(x + 100., 300.), p(x, 300.)]);
        if k > 0 {
            corners.push(p(x, 100.));
        }
    }
    let mut b = Builder::new();
    let hall = b.area("Гребёнка", &corners, Frame::IDENTITY, &[]);
    let plan = build(&b);
    assert!(plan.passframes(hall).len() <= 5, "{}", plan.passframes(hall).len());
}

#[test]
fn a_star_is_cut_well() {
    let corners: Vec<Point> = (0..12)
        .map(|k| {
            let (r, a) = (if k % 2 == 0 { 400.0 } else { 200.0 }, f64::from(k) * PI / 6.0);
            p(r * a.cos(), r * a.sin())
        })
        .collect();
    let mut b = Builder::new();
    let hall = b.area("Звезда", &corners, Frame::IDENTITY, &[]);
    // Four would do; no edge of the Delaunay triangulation serves an inward corner here alone.
    let count = build(&b).passframes(hall).len();
    assert!(count <= 7, "{count}");
}

#[test]
fn a_round_room_of_a_hundred_walls_is_one_passframe() {
    let corners: Vec<Point> = (0..100)
        .map(|k| f64::from(k) * PI / 50.0)
        .map(|a| p(300.0 * a.cos(), 300.0 * a.sin()))
        .collect();
    let mut b = Builder::new();
    let hall = b.area("Ротонда", &corners, Frame::IDENTITY, &[]);
    assert_eq!(build(&b).passframes(hall).len(), 1);
    assert!(way(&b, (-200., 0.), (200., 10.)).is_some());
}

#[test]
fn an_acute_corner_ends_in_a_dead_zone() {
    let mut b = Builder::new();
    let hall = b.area("Клин", &[p(0., 0.), p(600., 0.), p(600., 150.)], Frame::IDENTITY, &[]);
    let plan = build(&b);
    assert!(plan.fragment(hall).unwrap().dead_zone_at(p(30., 3.)).is_some());
    assert!(plan.fragment(hall).unwrap().passframe_at(p(500., 60.)).is_some());
}

#[test]
fn a_thousand_kilometres_away_nothing_changes() {
    let (b, _) = room(&[[150., 100., 60., 90., 0.]]);
    let near = way(&b, LEFT, RIGHT).unwrap();
    let far =
        way(&b.moved(1e6, 1e6, 0.0), (1e6 + 40., 1e6 + 150.), (1e6 + 360., 1e6 + 150.)).unwrap();
    assert!((near - far).abs() < 1e-3, "{near} {far}");
}

#[test]
fn a_hall_of_ten_kilometres_is_crossed() {
    let mut b = Builder::new();
    let hall = b.area("Поле", &rectangle(1e6, 1e6), Frame::IDENTITY, &[]);
    b.put(hall, 5e5, 5e5, 40.0, 40.0, 10.0, 100.0);
    assert!(way(&b, (1e3, 1e3), (9.9e5, 9.9e5)).unwrap() > 1.39e6);
}

#[test]
fn a_door_in_a_corner_is_passed() {
    let mut b = Builder::new();
    let door = b.door(DoorKind::Sliding, 90.0, DoorState::OPEN);
    let one = b.area(
        "Один",
        &[p(0., 0.), p(400., 0.), p(400., 90.), p(400., 300.), p(0., 300.)],
        Frame::IDENTITY,
        &[(1, Opening::Door(door))],
    );
    let two = b.area(
        "Два",
        &[p(0., 0.), p(400., 0.), p(400., 300.), p(0., 300.), p(0., 90.)],
        Frame::new(410.0, 0.0, 0.0, Deg::ZERO),
        &[(4, Opening::Door(door))],
    );
    b.link(one, 1, two, 4);
    assert!(way(&b, (60., 200.), (760., 200.)).is_some());
}

#[test]
fn a_door_without_an_area_behind_it_is_a_wall() {
    let mut b = Builder::new();
    let door = b.door(DoorKind::Hinged, 90.0, DoorState::OPEN);
    b.area(
        "Один",
        &[p(0., 0.), p(400., 0.), p(400., 100.), p(400., 190.), p(400., 300.), p(0., 300.)],
        Frame::IDENTITY,
        &[(2, Opening::Door(door))],
    );
    let plan = build(&b);
    assert!(plan.doorways().is_empty());
    assert!((free_area(&plan) - 120_000.0).abs() < 1e-3);
}

#[test]
fn a_threshold_less_deep_than_the_robot_is_passed() {
    // A passage Area of 20 between two rooms.
    let mut b = Builder::new();
    let one = b.area(
        "Один",
        &[p(0., 0.), p(400., 0.), p(400., 100.), p(400., 190.), p(400., 300.), p(0., 300.)],
        Frame::IDENTITY,
        &[(2, Opening::Passage)],
    );
    let sill = b.area(
        "Порог",
        &rectangle(20., 90.),
        Frame::new(400.0, 100.0, 0.0, Deg::ZERO),
        &[(1, Opening::Passage), (3, Opening::Passage)],
    );
    let two = b.area(
        "Два",
        &[p(0., 0.), p(400., 0.), p(400., 300.), p(0., 300.), p(0., 190.), p(0., 100.)],
        Frame::new(420.0, 0.0, 0.0, Deg::ZERO),
        &[(4, Opening::Passage)],
    );
    b.link(one, 2, sill, 3);
    b.link(sill, 1, two, 4);
    assert!(way(&b, (60., 200.), (760., 50.)).is_some());
}

#[test]
fn a_step_between_areas_is_no_way() {
    let (mut b, _, two, _) = two_rooms(0.0, DoorKind::Sliding, DoorState::OPEN);
    let item =
        b.world.maps.get_mut(&MapId(1)).unwrap().items.iter_mut().find(|i| i.area == two).unwrap();
    item.frame.z = Cm::of(15.0);
    let plan = build(&b);
    let no = plan
        .route(&b.world, p(100., 150.), Target::Point(p(700., 150.)), Method::Shortest)
        .unwrap_err();
    assert!(
        matches!(no.barriers(), [Barrier::Step { rise, .. }] if (rise - 15.0).abs() < 1e-9),
        "{no:?}"
    );
}

#[test]
fn a_door_lower_than_the_robot_is_no_way() {
    let (mut b, _, _, door) = two_rooms(0.0, DoorKind::Sliding, DoorState::OPEN);
    b.world.doors.get_mut(&door).unwrap().height = Cm::of(110.0);
    let no = build(&b)
        .route(&b.world, p(100., 150.), Target::Point(p(700., 150.)), Method::Shortest)
        .unwrap_err();
    assert!(matches!(no.barriers(), [Barrier::Low { .. }]), "{no:?}");
}

#[test]
fn a_podium_within_a_room_is_taken_out() {
    let mut b = Builder::new();
    let (base, podium) = (rectangle(400., 300.), rectangle(100., 80.));
    let hall = b.area_of(
        "Зал",
        &[(&base, Frame::IDENTITY, &[]), (&podium, Frame::new(150., 100., 20., Deg::ZERO), &[])],
        Frame::IDENTITY,
    );
    let plan = build(&b);
    assert!((raw_area(&plan) - (120_000.0 - 8_000.0)).abs() < 1e-3);
    let blocker = plan.fragment(hall).unwrap().obstacle_at(p(200., 140.)).unwrap().blocker;
    assert_eq!(blocker, Blocker::Floor { area: hall, item: 1 });
}

#[test]
fn a_wall_between_items_of_one_area_is_a_wall() {
    let mut b = Builder::new();
    let (left, right) = (rectangle(200.0, 300.0), rectangle(200.0, 300.0));
    b.area_of(
        "Зал",
        &[(&left, Frame::IDENTITY, &[]), (&right, Frame::new(200., 0., 0., Deg::ZERO), &[])],
        Frame::IDENTITY,
    );
    assert_eq!(way(&b, LEFT, RIGHT), None);
}

#[test]
fn a_gap_is_opened_by_the_smallest_push() {
    let (mut b, _) = room(&[[180., 0., 40., 126., 0.], [180., 174., 40., 100., 0.]]);
    let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
    b.world.replicas.get_mut(&ids[1]).unwrap().move_prob = 50;
    let plan = build(&b);
    let target = Target::Point(p(RIGHT.0, RIGHT.1));
    let no = plan.route(&b.world, p(LEFT.0, LEFT.1), target, Method::Shortest).unwrap_err();
    match plan.remedy(&b.world, p(LEFT.0, LEFT.1), target, &no, FARTHEST) {
        Some(Remedy::Move { replica, by, open }) => {
            assert_eq!((replica, open), (ids[1], vec![]));
            assert!((by.norm() - 2.0).abs() < 1e-9 && by.y > 1.9, "{by:?}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_shut_door_is_opened_rather_than_furniture_pushed() {
    let (b, _, _, door) = two_rooms(10.0, DoorKind::Hinged, DoorState::CLOSED);
    let plan = build(&b);
    let target = Target::Point(p(700., 150.));
    let no = plan.route(&b.world, p(100., 150.), target, Method::Shortest).unwrap_err();
    assert_eq!(
        plan.remedy(&b.world, p(100., 150.), target, &no, FARTHEST),
        Some(Remedy::Open(vec![door]))
    );
}

#[test]
fn passframes_elsewhere_keep_their_ids() {
    let (mut b, hall) = room(&[[50., 50., 40., 40., 0.], [320., 200., 30., 30., 0.]]);
    let before = build(&b);
    let id = *b.world.replicas.keys().next_back().unwrap();
    b.world.replicas.get_mut(&id).unwrap().frame = Frame::new(322.0, 200.0, 0.0, Deg::ZERO);
    let after = build(&b);
    let ids = |plan: &FloorPlan| {
        plan.passframes(hall).iter().map(|f| f.id).collect::<std::collections::BTreeSet<_>>()
    };
    assert!(ids(&before).intersection(&ids(&after)).count() >= 2);
}
