-- Buildings, robots, keys, and what robots sent. Robot 0 of a building is the centre: its map is the one that is handed out.

CREATE SCHEMA fleet;
CREATE SCHEMA map;
CREATE SCHEMA log;

-- Roles belong to the whole server: another fleet in it may have made them.
DO $$ BEGIN CREATE ROLE fleet_robot NOLOGIN; EXCEPTION WHEN duplicate_object THEN NULL; END $$;
DO $$ BEGIN CREATE ROLE fleet_operator NOLOGIN; EXCEPTION WHEN duplicate_object THEN NULL; END $$;
DO $$ BEGIN CREATE ROLE fleet_worker NOLOGIN; EXCEPTION WHEN duplicate_object THEN NULL; END $$;

-- Whoever serves takes these roles on, one transaction at a time.
GRANT fleet_robot, fleet_operator, fleet_worker TO CURRENT_USER;

CREATE TABLE fleet.building (
    building bigint PRIMARY KEY,
    name text NOT NULL
);

-- sequence: the last transaction of the robot's journal that is here; checksum: that of its frame, null where unknown.
-- epoch: raised when a copy began anew from the whole store. forgot: the robot has dropped some of its own past.
-- agreed_centre, agreed_robot: the revisions in which the centre's map and the robot's last were the same.
CREATE TABLE fleet.robot (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    name text NOT NULL,
    sequence bigint NOT NULL DEFAULT 0,
    checksum bigint,
    epoch bigint NOT NULL DEFAULT 0,
    forgot boolean NOT NULL DEFAULT false,
    revision bigint NOT NULL DEFAULT 0,
    reported timestamptz,
    agreed_centre bigint NOT NULL DEFAULT 0,
    agreed_robot bigint NOT NULL DEFAULT 0,
    PRIMARY KEY (building, robot)
);

-- A key is kept as its SHA-256. A robot's names building and robot; an operator's names a building, or none for all.
CREATE TABLE fleet.key (
    hash bytea PRIMARY KEY,
    kind text NOT NULL CHECK (kind IN ('robot', 'operator')),
    building bigint,
    robot bigint,
    name text NOT NULL,
    made timestamptz NOT NULL DEFAULT now(),
    revoked timestamptz,
    CHECK (kind <> 'robot' OR (building IS NOT NULL AND robot > 0))
);

-- The robots' journals, transaction by transaction, byte by byte.
CREATE TABLE fleet.frame (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    epoch bigint NOT NULL,
    sequence bigint NOT NULL,
    checksum bigint NOT NULL,
    bytes bytea NOT NULL,
    arrived timestamptz NOT NULL DEFAULT now(),
    PRIMARY KEY (building, robot, epoch, sequence)
) PARTITION BY HASH (building);

-- Tasks, from when they were given until they left the robot's queue.
CREATE TABLE fleet.mission (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    task bigint NOT NULL,
    text text NOT NULL,
    given_by text NOT NULL,
    given timestamptz NOT NULL,
    state text NOT NULL,
    noted timestamptz NOT NULL,
    ended timestamptz,
    PRIMARY KEY (building, robot, task, given)
) PARTITION BY HASH (building);

-- The centre's map and a robot's that were both changed, thing by thing; open until a revision is taken by the robot.
CREATE TABLE fleet.conflict (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    centre_revision bigint NOT NULL,
    robot_revision bigint NOT NULL,
    thing text NOT NULL,
    centre text NOT NULL,
    robots text NOT NULL,
    noted timestamptz NOT NULL DEFAULT now(),
    settled timestamptz,
    PRIMARY KEY (building, robot, centre_revision, robot_revision, thing)
) PARTITION BY HASH (building);

-- What followed from a robot's map, from one revision to another: derived relations by their English names, IS_A with a
-- thing's kind, and HAS:property with its value. revision_to and until are null while it holds.
CREATE TABLE fleet.fact (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    relation text NOT NULL,
    subject text NOT NULL,
    object text NOT NULL,
    revision bigint NOT NULL,
    revision_to bigint,
    since timestamptz NOT NULL,
    until timestamptz,
    PRIMARY KEY (building, robot, relation, subject, object, revision)
) PARTITION BY HASH (building);
CREATE INDEX fact_object ON fleet.fact (relation, object, building) WHERE revision_to IS NULL;
CREATE INDEX fact_subject ON fleet.fact (relation, subject, building) WHERE revision_to IS NULL;

-- The kinds of things of a building, and what they are called: the objects of IS_A.
CREATE TABLE fleet.kind (
    building bigint NOT NULL,
    kind text NOT NULL,
    PRIMARY KEY (building, kind)
) PARTITION BY HASH (building);

-- Maps that are to be derived; anew: what was derived before is of another past. Not divided: SELECT ... FOR UPDATE SKIP LOCKED asks for one place.
CREATE TABLE fleet.work (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    revision bigint NOT NULL,
    anew boolean NOT NULL,
    asked timestamptz NOT NULL DEFAULT clock_timestamp(),
    tries bigint NOT NULL DEFAULT 0,
    fault text NOT NULL DEFAULT '',
    PRIMARY KEY (building, robot, revision, anew)
);

-- Who is asking, by the key that the transaction has set. Robots have no access to the keys themselves.
CREATE FUNCTION fleet.my_building() RETURNS bigint LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT building FROM fleet.key WHERE revoked IS NULL
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8')) $$;
CREATE FUNCTION fleet.my_robot() RETURNS bigint LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT robot FROM fleet.key WHERE revoked IS NULL AND kind = 'robot'
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8')) $$;
CREATE FUNCTION fleet.sees_all() RETURNS boolean LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT EXISTS (SELECT FROM fleet.key WHERE revoked IS NULL AND kind = 'operator' AND building IS NULL
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))) $$;
CREATE FUNCTION fleet.my_kind() RETURNS text LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT kind FROM fleet.key WHERE revoked IS NULL
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8')) $$;
REVOKE EXECUTE ON FUNCTION fleet.my_building(), fleet.my_robot(), fleet.sees_all(), fleet.my_kind() FROM PUBLIC;
