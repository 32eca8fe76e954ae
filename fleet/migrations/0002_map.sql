-- The tables of paper 2 as every robot keeps them, with their past (SPEC D1, D3).
--
-- One row is one version of a record: valid from its revision, made at "RecDate" by "RecUser", up to revision_to and
-- valid_to, which are null while it stands. "Deleted" marks the version that says the record is gone. Robot 0 of a
-- building is the centre itself. Column names are the paper's, its spelling "Hieght" among them; columns and tables that
-- no paper has stand last. Every key begins with the building, by which rows are partitioned.

CREATE TABLE map."OrFr" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "TypeID" bigint,
    "ShapeID" bigint,
    "SideCount" bigint NOT NULL,
    "BasePntr" bigint NOT NULL,
    "Roof" double precision NOT NULL,
    "RoofPntr" bigint NOT NULL,
    "SizeX" double precision NOT NULL,
    "SizeY" double precision NOT NULL,
    "Key" text NOT NULL,
    "NameEn" text NOT NULL,
    "RoofScale" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."OrtFrmShapeList" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "NameEn" text NOT NULL,
    "Gender" text NOT NULL,
    "Animate" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."OrtFrmTypeList" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "NameEn" text NOT NULL,
    "Gender" text NOT NULL,
    "Animate" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."OrtFrmProperties" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "Prop" text NOT NULL,
    "PropVal" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "OrFrID", "Prop", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."OrtFrmSides" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "SideTypeID" bigint,
    "SidePntr" bigint NOT NULL,
    "X1" double precision NOT NULL,
    "Y1" double precision NOT NULL,
    "X2" double precision NOT NULL,
    "Y2" double precision NOT NULL,
    "Len" double precision NOT NULL,
    "Ang" double precision NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "OrFrID", "SideID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."OrtFrmSideTypeList" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "NameEn" text NOT NULL,
    "Gender" text NOT NULL,
    "Animate" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."OrtFrmSideProperties" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "Prop" text NOT NULL,
    "PropVal" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "OrFrID", "SideID", "Prop", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Object" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "TypeID" bigint,
    "SizeX" double precision NOT NULL,
    "SizeY" double precision NOT NULL,
    "Hieght" double precision NOT NULL,
    "Key" text NOT NULL,
    "NameEn" text NOT NULL,
    "FrontItemID" text,
    "FrontSideID" text,
    "BackItemID" text,
    "BackSideID" text,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ObjectTypeList" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "NameEn" text NOT NULL,
    "Gender" text NOT NULL,
    "Animate" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ObjectItems" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ObjectID" bigint NOT NULL,
    "ItemID" text NOT NULL,
    "OrFrID" bigint NOT NULL,
    "PosX" double precision NOT NULL,
    "PosY" double precision NOT NULL,
    "PosZ" double precision NOT NULL,
    "PosA" double precision NOT NULL,
    "Base" bigint NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ObjectID", "ItemID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ObjectItemLinks" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ObjectID" bigint NOT NULL,
    "ItemID" text NOT NULL,
    "ItemID2" text NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "OrFrID2" bigint NOT NULL,
    "SideID2" text NOT NULL,
    "RelX" double precision NOT NULL,
    "RelY" double precision NOT NULL,
    "RelA" double precision NOT NULL,
    "RelXY" double precision NOT NULL,
    "RelZ" double precision NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ObjectID", "ItemID", "ItemID2", "OrFrID", "SideID", "OrFrID2", "SideID2", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ObjectDoors" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ObjectID" bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "DoorID" bigint NOT NULL,
    "SetInside" bigint NOT NULL,
    "ItemID" text NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ObjectID", "OrFrID", "SideID", "DoorID", "ItemID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Area" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "TypeID" bigint,
    "SizeX" double precision NOT NULL,
    "SizeY" double precision NOT NULL,
    "Hieght" double precision NOT NULL,
    "Key" text NOT NULL,
    "NameEn" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."AreaTypeList" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "NameEn" text NOT NULL,
    "Gender" text NOT NULL,
    "Animate" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."AreaItems" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "ItemID" text NOT NULL,
    "OrFrID" bigint NOT NULL,
    "PosX" double precision NOT NULL,
    "PosY" double precision NOT NULL,
    "PosZ" double precision NOT NULL,
    "PosA" double precision NOT NULL,
    "Base" bigint NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "AreaID", "ItemID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."AreaItemLinks" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "ItemID" text NOT NULL,
    "ItemID2" text NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "OrFrID2" bigint NOT NULL,
    "SideID2" text NOT NULL,
    "RelX" double precision NOT NULL,
    "RelY" double precision NOT NULL,
    "RelA" double precision NOT NULL,
    "RelXY" double precision NOT NULL,
    "RelZ" double precision NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "AreaID", "ItemID", "ItemID2", "OrFrID", "SideID", "OrFrID2", "SideID2", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."AreaDoors" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "DoorID" bigint NOT NULL,
    "SetInside" bigint NOT NULL,
    "ItemID" text NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "AreaID", "OrFrID", "SideID", "DoorID", "ItemID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."AreaObjects" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "ObjectID" bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "X" double precision NOT NULL,
    "Y" double precision NOT NULL,
    "Z" double precision NOT NULL,
    "Ang" double precision NOT NULL,
    "MoveProb" bigint NOT NULL,
    "Name" text NOT NULL,
    "NameEn" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "AreaID", "ObjectID", "ReplID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Map" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "TypeID" bigint,
    "SizeX" double precision NOT NULL,
    "SizeY" double precision NOT NULL,
    "Hieght" double precision NOT NULL,
    "Key" text NOT NULL,
    "NameEn" text NOT NULL,
    "Frame" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."MapTypeList" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "NameEn" text NOT NULL,
    "Gender" text NOT NULL,
    "Animate" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."MapItems" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "MapID" bigint NOT NULL,
    "ItemID" bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "PosX" double precision NOT NULL,
    "PosY" double precision NOT NULL,
    "PosZ" double precision NOT NULL,
    "PosA" double precision NOT NULL,
    "Base" bigint NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "MapID", "ItemID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."MapItemLinks" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "MapID" bigint NOT NULL,
    "ItemID" bigint NOT NULL,
    "ItemID2" bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "AreaID2" bigint NOT NULL,
    "OrFrID2" bigint NOT NULL,
    "SideID2" text NOT NULL,
    "RelX" double precision NOT NULL,
    "RelY" double precision NOT NULL,
    "RelA" double precision NOT NULL,
    "RelZ" double precision NOT NULL,
    "AreaItemID" text NOT NULL,
    "AreaItemID2" text NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "MapID", "ItemID", "ItemID2", "OrFrID", "SideID", "OrFrID2", "SideID2", "AreaItemID", "AreaItemID2", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Domain" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "Key" text NOT NULL,
    "NameEn" text NOT NULL,
    "Profile" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."DomainMaps" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "DomainID" bigint NOT NULL,
    "MapID" bigint NOT NULL,
    "PosX" double precision NOT NULL,
    "PosY" double precision NOT NULL,
    "PosZ" double precision NOT NULL,
    "PosA" double precision NOT NULL,
    "Base" bigint NOT NULL,
    "No" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "DomainID", "MapID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Door" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "TypeID" bigint,
    "SideCount" bigint NOT NULL,
    "Width" double precision NOT NULL,
    "Height" double precision NOT NULL,
    "Key" text NOT NULL,
    "Name" text NOT NULL,
    "NameEn" text NOT NULL,
    "Kind" text NOT NULL,
    "Status" text NOT NULL,
    "Opening" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."DoorTypeList" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ID" bigint NOT NULL,
    "Name" text NOT NULL,
    "Desc" text NOT NULL,
    "NameEn" text NOT NULL,
    "Gender" text NOT NULL,
    "Animate" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."DoorSides" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "DoorID" bigint NOT NULL,
    "SideID" bigint NOT NULL,
    "JointSide" bigint NOT NULL,
    "SidePart" double precision NOT NULL,
    "Thick" double precision NOT NULL,
    "MaxOpen" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "DoorID", "SideID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."SideNames" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "OrFrID" bigint NOT NULL,
    "SideID" text NOT NULL,
    "No" bigint NOT NULL,
    "Name" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "OrFrID", "SideID", "No", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ObjectProperties" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ObjectID" bigint NOT NULL,
    "Prop" text NOT NULL,
    "PropVal" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ObjectID", "Prop", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."AreaProperties" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "Prop" text NOT NULL,
    "PropVal" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "AreaID", "Prop", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."DoorProperties" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "DoorID" bigint NOT NULL,
    "Prop" text NOT NULL,
    "PropVal" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "DoorID", "Prop", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ReplicaProperties" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "Prop" text NOT NULL,
    "PropVal" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ReplID", "Prop", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ReplicaDoors" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "DoorID" bigint NOT NULL,
    "Status" text NOT NULL,
    "Opening" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ReplID", "DoorID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."TypeWords" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "List" text NOT NULL,
    "TypeID" bigint NOT NULL,
    "Role" text NOT NULL,
    "No" bigint NOT NULL,
    "Word" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "List", "TypeID", "Role", "No", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."NameForms" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "Kind" text NOT NULL,
    "ID" bigint NOT NULL,
    "Case" text NOT NULL,
    "Form" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "Kind", "ID", "Case", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Places" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "PlaceID" bigint NOT NULL,
    "Name" text NOT NULL,
    "NameEn" text NOT NULL,
    "X" double precision NOT NULL,
    "Y" double precision NOT NULL,
    "Ang" double precision,
    "ServesReplID" bigint,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "AreaID", "PlaceID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Lifts" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "DomainID" bigint NOT NULL,
    "LiftNo" bigint NOT NULL,
    "Name" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "DomainID", "LiftNo", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."LiftStops" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "DomainID" bigint NOT NULL,
    "LiftNo" bigint NOT NULL,
    "StopNo" bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "DomainID", "LiftNo", "StopNo", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Robot" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "DomainID" bigint NOT NULL,
    "Radius" double precision NOT NULL,
    "Height" double precision NOT NULL,
    "Step" double precision NOT NULL,
    "Clearance" double precision NOT NULL,
    "Speed" double precision NOT NULL,
    "TurnRate" double precision NOT NULL,
    "StartPlaceID" bigint,
    "Footprint" text NOT NULL,
    "Opens" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "DomainID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."Zones" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ZoneID" bigint NOT NULL,
    "Key" text NOT NULL,
    "Name" text NOT NULL,
    "NameEn" text NOT NULL,
    "Kind" text NOT NULL,
    "Measure" double precision NOT NULL,
    "MapID" bigint,
    "Points" text NOT NULL,
    "Reason" text NOT NULL,
    "ReasonEn" text NOT NULL,
    "StartsAt" text NOT NULL,
    "EndsAt" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ZoneID", revision)
) PARTITION BY HASH (building);

CREATE TABLE map."ZoneAreas" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ZoneID" bigint NOT NULL,
    "No" bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    valid_to timestamptz,
    PRIMARY KEY (building, robot, "ZoneID", "No", revision)
) PARTITION BY HASH (building);
