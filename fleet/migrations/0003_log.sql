-- What a robot notes beside its map: what it saw, where it stood, what it carries, what it has to do. One row is a
-- record as it stands; observations are only ever added.

CREATE TABLE log."RobotPose" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "RobotID" bigint NOT NULL,
    "MapID" bigint NOT NULL,
    "X" double precision NOT NULL,
    "Y" double precision NOT NULL,
    "Ang" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "RobotID")
) PARTITION BY HASH (building);

CREATE TABLE log."Observations" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "At" bigint NOT NULL,
    "No" bigint NOT NULL,
    "Seen" bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "X" double precision NOT NULL,
    "Y" double precision NOT NULL,
    "Z" double precision NOT NULL,
    "Ang" double precision NOT NULL,
    "Sure" double precision NOT NULL,
    "Observer" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "ReplID", "At", "No")
) PARTITION BY HASH (building);

CREATE TABLE log."Revisions" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "Revision" bigint NOT NULL,
    "Kind" text NOT NULL,
    "Reason" text NOT NULL,
    "Undoes" bigint,
    "CreatedCount" bigint NOT NULL,
    "ChangedCount" bigint NOT NULL,
    "DeletedCount" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "Revision")
) PARTITION BY HASH (building);

CREATE TABLE log."LastIds" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "Kind" text NOT NULL,
    "LastID" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "Kind")
) PARTITION BY HASH (building);

CREATE TABLE log."Verdicts" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "At" bigint NOT NULL,
    "Verdict" text NOT NULL,
    "Reason" text NOT NULL,
    "Same" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "ReplID", "At")
) PARTITION BY HASH (building);

CREATE TABLE log."DoorStates" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "DoorID" bigint NOT NULL,
    "Status" text NOT NULL,
    "Opening" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "DoorID")
) PARTITION BY HASH (building);

CREATE TABLE log."Carried" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "Holder" text NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "ReplID")
) PARTITION BY HASH (building);

CREATE TABLE log."DeviceStates" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "IsOn" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "ReplID")
) PARTITION BY HASH (building);

CREATE TABLE log."Beliefs" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "Newest" bigint NOT NULL,
    "Survey" bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "X" double precision NOT NULL,
    "Y" double precision NOT NULL,
    "Z" double precision NOT NULL,
    "Ang" double precision NOT NULL,
    "Confidence" double precision NOT NULL,
    "At" bigint NOT NULL,
    "Since" bigint NOT NULL,
    "LastSeen" bigint,
    "Missed" bigint,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "ReplID")
) PARTITION BY HASH (building);

CREATE TABLE log."Obstacles" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "No" bigint NOT NULL,
    "AreaID" bigint NOT NULL,
    "Pieces" text NOT NULL,
    "Top" double precision NOT NULL,
    "At" bigint NOT NULL,
    "Sure" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "No")
) PARTITION BY HASH (building);

CREATE TABLE log."FoundPoses" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "No" bigint NOT NULL,
    "MapID" bigint NOT NULL,
    "X" double precision NOT NULL,
    "Y" double precision NOT NULL,
    "Ang" double precision NOT NULL,
    "Off" double precision NOT NULL,
    "OffAng" double precision NOT NULL,
    "Explained" double precision NOT NULL,
    "At" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "No")
) PARTITION BY HASH (building);

CREATE TABLE log."OpenStates" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "ReplID" bigint NOT NULL,
    "IsOpen" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "ReplID")
) PARTITION BY HASH (building);

CREATE TABLE log."Tasks" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "No" bigint NOT NULL,
    "TaskID" bigint NOT NULL,
    "Text" text NOT NULL,
    "By" text NOT NULL,
    "At" bigint NOT NULL,
    "State" text NOT NULL,
    "MapID" bigint,
    "X" double precision NOT NULL,
    "Y" double precision NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "No")
) PARTITION BY HASH (building);

CREATE TABLE log."Pause" (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    "RobotID" bigint NOT NULL,
    "At" bigint NOT NULL,
    "RecDate" timestamptz NOT NULL,
    "RecUser" text NOT NULL,
    "Deleted" boolean NOT NULL,
    revision bigint NOT NULL,
    PRIMARY KEY (building, robot, "RobotID")
) PARTITION BY HASH (building);
