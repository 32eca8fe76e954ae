-- What the robots propose is kept, thing by thing, by the transaction that brings the belief or the map: a page of many robots
-- would otherwise go through all that all of them believe. How it is reckoned stays where it was, under another name.

ALTER VIEW fleet.proposal RENAME TO disagreement;

CREATE TABLE fleet.proposed (
    building bigint NOT NULL,
    robot bigint NOT NULL,
    replica bigint NOT NULL,
    sure double precision NOT NULL,
    PRIMARY KEY (building, robot, replica)
);
CREATE INDEX proposed_sure ON fleet.proposed (sure DESC, building, robot, replica);

-- A thing by its number, in the map as it stands.
CREATE INDEX area_objects_replica ON map."AreaObjects" (building, robot, "ReplID") WHERE revision_to IS NULL;

INSERT INTO fleet.proposed (building, robot, replica, sure)
SELECT building, robot, replica, sure FROM fleet.disagreement;

CREATE VIEW fleet.proposal WITH (security_invoker = true) AS
SELECT p.building, p.robot, p.replica, t."Name" AS thing, m."Name" AS mapped_area, a."Name" AS area,
       b."X" AS x, b."Y" AS y, p.sure,
       timestamptz 'epoch' + b."LastSeen" * interval '1 millisecond' AS seen,
       CASE WHEN b."AreaID" = t."AreaID"
            THEN sqrt((b."X" - t."X") ^ 2 + (b."Y" - t."Y") ^ 2 + (b."Z" - t."Z") ^ 2) END AS apart
FROM fleet.proposed p
JOIN log."Beliefs" b ON b.building = p.building AND b.robot = p.robot AND b."ReplID" = p.replica
JOIN map."AreaObjects" t ON t.building = p.building AND t.robot = p.robot AND t."ReplID" = p.replica
    AND t.revision_to IS NULL AND NOT t."Deleted"
LEFT JOIN map."Area" a ON a.building = b.building AND a.robot = b.robot AND a."ID" = b."AreaID" AND a.revision_to IS NULL
LEFT JOIN map."Area" m ON m.building = t.building AND m.robot = t.robot AND m."ID" = t."AreaID" AND m.revision_to IS NULL;

GRANT SELECT, INSERT, UPDATE, DELETE ON fleet.proposed TO fleet_robot;
GRANT SELECT ON fleet.proposed TO fleet_operator, fleet_worker;
GRANT SELECT ON fleet.disagreement TO fleet_robot;
GRANT SELECT ON fleet.proposal TO fleet_operator, fleet_worker;
ALTER TABLE fleet.proposed ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.proposed FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON fleet.proposed FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_reads ON fleet.proposed FOR SELECT TO fleet_worker USING (true);
CREATE POLICY robot_adds ON fleet.proposed FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON fleet.proposed FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON fleet.proposed FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

-- Tasks that go on, and those that ended, the newest first; conflicts that are open.
CREATE INDEX mission_open ON fleet.mission (given DESC) WHERE ended IS NULL;
CREATE INDEX mission_ended ON fleet.mission (given DESC) WHERE ended IS NOT NULL;
CREATE INDEX conflict_open ON fleet.conflict (building, robot) WHERE settled IS NULL;
