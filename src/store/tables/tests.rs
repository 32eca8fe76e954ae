//! The tables and columns are those of paper 2, and stay what they are.

use super::*;

/// The paper's own list, copied from its §§2-7 by hand.
const PAPER: &[(&str, &str)] = &[
    ("OrFr", "ID Name Desc TypeID ShapeID SideCount BasePntr Roof RoofPntr SizeX SizeY"),
    ("OrtFrmShapeList", "ID Name Desc"),
    ("OrtFrmTypeList", "ID Name Desc"),
    ("OrtFrmProperties", "OrFrID Prop PropVal"),
    ("OrtFrmSides", "OrFrID SideID SideTypeID SidePntr X1 Y1 X2 Y2 Len Ang"),
    ("OrtFrmSideTypeList", "ID Name Desc"),
    ("OrtFrmSideProperties", "OrFrID SideID Prop PropVal"),
    ("Object", "ID Name Desc TypeID SizeX SizeY Hieght"),
    ("ObjectTypeList", "ID Name Desc"),
    ("ObjectItems", "ObjectID ItemID OrFrID PosX PosY PosZ PosA Base"),
    (
        "ObjectItemLinks",
        "ObjectID ItemID ItemID2 OrFrID SideID OrFrID2 SideID2 RelX RelY RelA RelXY RelZ",
    ),
    ("ObjectDoors", "ObjectID OrFrID SideID DoorID SetInside"),
    ("Area", "ID Name Desc TypeID SizeX SizeY Hieght"),
    ("AreaTypeList", "ID Name Desc"),
    ("AreaItems", "AreaID ItemID OrFrID PosX PosY PosZ PosA Base"),
    (
        "AreaItemLinks",
        "AreaID ItemID ItemID2 OrFrID SideID OrFrID2 SideID2 RelX RelY RelA RelXY RelZ",
    ),
    ("AreaDoors", "AreaID OrFrID SideID DoorID SetInside"),
    ("AreaObjects", "AreaID ObjectID ReplID X Y Z Ang MoveProb"),
    ("Map", "ID Name Desc TypeID SizeX SizeY Hieght"),
    ("MapTypeList", "ID Name Desc"),
    ("MapItems", "MapID ItemID AreaID OrFrID PosX PosY PosZ PosA Base"),
    (
        "MapItemLinks",
        "MapID ItemID ItemID2 AreaID OrFrID SideID AreaID2 OrFrID2 SideID2 RelX RelY RelA RelZ",
    ),
    ("Domain", "ID Name Desc"),
    ("DomainMaps", "DomainID MapID PosX PosY PosZ PosA Base"),
    ("Door", "ID TypeID SideCount Width Height"),
    ("DoorTypeList", "ID Name Desc"),
    ("DoorSides", "DoorID SideID JointSide SidePart Thick MaxOpen"),
    (
        "ObjectItemSides",
        "ObjectID ItemID OrFrID SideID SideTypeID SidePntr Base X1 Y1 X2 Y2 Len Ang Z Hieght",
    ),
    (
        "AreaItemSides",
        "AreaID ItemID OrFrID SideID SideTypeID SidePntr Base X1 Y1 X2 Y2 Len Ang Z Hieght",
    ),
    (
        "AreaObjectSides",
        "AreaID ObjectID ReplID ItemID OrFrID SideID SideTypeID SidePntr Base X1 Y1 X2 Y2 Len \
         Ang Z Hieght",
    ),
    (
        "MapItemSides",
        "MapID ItemID AreaID OrFrID SideID SideTypeID SidePntr Base X1 Y1 X2 Y2 Len Ang Z \
         Hieght",
    ),
];

#[test]
fn every_table_and_field_of_the_paper_is_there() {
    let ours: Vec<_> = Table::ALL
        .iter()
        .filter(|t| matches!(t.origin(), Origin::Paper | Origin::Derived))
        .map(|t| {
            let names: Vec<_> =
                t.columns().iter().filter(|c| !c.is_beyond).map(|c| c.name).collect();
            (t.name(), names.join(" "))
        })
        .collect();
    let paper: Vec<_> = PAPER.iter().map(|(t, c)| (*t, (*c).to_owned())).collect();
    assert_eq!(ours, paper);
    assert_eq!(ours.len(), 31);
}

/// Journals hold these numbers: a change here makes old stores unreadable.
#[test]
fn codes_stay_what_they_are() {
    let codes: Vec<u8> = Table::ALL.iter().map(|t| t.code()).collect();
    let expected: Vec<u8> = (1..=31).chain(40..=53).chain(60..=73).collect();
    assert_eq!(codes, expected);
    assert!(Table::ALL.iter().all(|t| Table::from_code(t.code()) == Some(*t)));
}

#[test]
fn a_row_from_before_a_column_was_added_takes_its_default() {
    let area =
        Area {
            id: 7, name: "Комната-В".into(), name_en: "Room-B".into(), ..Area::default()
        };
    let row = area.to_row();
    assert_eq!(Area::from_row(&row), Some(area));
    let old = Area::from_row(&row[..3]).unwrap();
    assert_eq!((old.id, old.name.as_str(), old.name_en.as_str()), (7, "Комната-В", ""));
    assert_eq!(Area::from_row(&[Cell::Text("семь".into())]), None);
}
