-- Who sees what. A robot comes with its key: it reads its own building, and writes its own rows. An operator reads the
-- building of the key, or all. Workers read maps and write facts. The key itself is asked of by the policies, so that even
-- who may write SQL in the name of robots sees nothing without a key.

GRANT USAGE ON SCHEMA fleet, map, log TO fleet_robot, fleet_operator, fleet_worker;
GRANT EXECUTE ON FUNCTION fleet.my_building(), fleet.my_robot(), fleet.sees_all(), fleet.my_kind() TO fleet_robot, fleet_operator;
GRANT SELECT, UPDATE ON fleet.robot TO fleet_robot;
GRANT SELECT ON fleet.building TO fleet_robot;
GRANT INSERT ON fleet.work TO fleet_robot;
GRANT SELECT ON fleet.building, fleet.robot, fleet.work TO fleet_operator, fleet_worker;
GRANT SELECT, INSERT, UPDATE, DELETE ON fleet.work TO fleet_worker;

ALTER TABLE fleet.building ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.building FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON fleet.building FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_reads ON fleet.building FOR SELECT TO fleet_worker USING (true);

ALTER TABLE fleet.robot ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.robot FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY robot_writes ON fleet.robot FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY operator_reads ON fleet.robot FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_reads ON fleet.robot FOR SELECT TO fleet_worker USING (true);

ALTER TABLE fleet.work ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_writes ON fleet.work FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY operator_reads ON fleet.work FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON fleet.work TO fleet_worker USING (true) WITH CHECK (true);

GRANT SELECT, INSERT, UPDATE, DELETE ON map."OrFr" TO fleet_robot;
GRANT SELECT ON map."OrFr" TO fleet_operator;
GRANT SELECT ON map."OrFr" TO fleet_worker;
ALTER TABLE map."OrFr" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."OrFr" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."OrFr" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."OrFr" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."OrFr" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."OrFr" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."OrFr" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."OrtFrmShapeList" TO fleet_robot;
GRANT SELECT ON map."OrtFrmShapeList" TO fleet_operator;
GRANT SELECT ON map."OrtFrmShapeList" TO fleet_worker;
ALTER TABLE map."OrtFrmShapeList" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."OrtFrmShapeList" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."OrtFrmShapeList" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."OrtFrmShapeList" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."OrtFrmShapeList" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."OrtFrmShapeList" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."OrtFrmShapeList" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."OrtFrmTypeList" TO fleet_robot;
GRANT SELECT ON map."OrtFrmTypeList" TO fleet_operator;
GRANT SELECT ON map."OrtFrmTypeList" TO fleet_worker;
ALTER TABLE map."OrtFrmTypeList" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."OrtFrmTypeList" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."OrtFrmTypeList" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."OrtFrmTypeList" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."OrtFrmTypeList" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."OrtFrmTypeList" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."OrtFrmTypeList" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."OrtFrmProperties" TO fleet_robot;
GRANT SELECT ON map."OrtFrmProperties" TO fleet_operator;
GRANT SELECT ON map."OrtFrmProperties" TO fleet_worker;
ALTER TABLE map."OrtFrmProperties" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."OrtFrmProperties" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."OrtFrmProperties" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."OrtFrmProperties" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."OrtFrmProperties" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."OrtFrmProperties" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."OrtFrmProperties" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."OrtFrmSides" TO fleet_robot;
GRANT SELECT ON map."OrtFrmSides" TO fleet_operator;
GRANT SELECT ON map."OrtFrmSides" TO fleet_worker;
ALTER TABLE map."OrtFrmSides" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."OrtFrmSides" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."OrtFrmSides" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."OrtFrmSides" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."OrtFrmSides" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."OrtFrmSides" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."OrtFrmSides" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."OrtFrmSideTypeList" TO fleet_robot;
GRANT SELECT ON map."OrtFrmSideTypeList" TO fleet_operator;
GRANT SELECT ON map."OrtFrmSideTypeList" TO fleet_worker;
ALTER TABLE map."OrtFrmSideTypeList" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."OrtFrmSideTypeList" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."OrtFrmSideTypeList" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."OrtFrmSideTypeList" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."OrtFrmSideTypeList" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."OrtFrmSideTypeList" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."OrtFrmSideTypeList" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."OrtFrmSideProperties" TO fleet_robot;
GRANT SELECT ON map."OrtFrmSideProperties" TO fleet_operator;
GRANT SELECT ON map."OrtFrmSideProperties" TO fleet_worker;
ALTER TABLE map."OrtFrmSideProperties" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."OrtFrmSideProperties" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."OrtFrmSideProperties" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."OrtFrmSideProperties" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."OrtFrmSideProperties" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."OrtFrmSideProperties" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."OrtFrmSideProperties" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Object" TO fleet_robot;
GRANT SELECT ON map."Object" TO fleet_operator;
GRANT SELECT ON map."Object" TO fleet_worker;
ALTER TABLE map."Object" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Object" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Object" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Object" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Object" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Object" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Object" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ObjectTypeList" TO fleet_robot;
GRANT SELECT ON map."ObjectTypeList" TO fleet_operator;
GRANT SELECT ON map."ObjectTypeList" TO fleet_worker;
ALTER TABLE map."ObjectTypeList" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ObjectTypeList" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ObjectTypeList" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ObjectTypeList" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ObjectTypeList" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ObjectTypeList" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ObjectTypeList" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ObjectItems" TO fleet_robot;
GRANT SELECT ON map."ObjectItems" TO fleet_operator;
GRANT SELECT ON map."ObjectItems" TO fleet_worker;
ALTER TABLE map."ObjectItems" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ObjectItems" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ObjectItems" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ObjectItems" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ObjectItems" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ObjectItems" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ObjectItems" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ObjectItemLinks" TO fleet_robot;
GRANT SELECT ON map."ObjectItemLinks" TO fleet_operator;
GRANT SELECT ON map."ObjectItemLinks" TO fleet_worker;
ALTER TABLE map."ObjectItemLinks" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ObjectItemLinks" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ObjectItemLinks" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ObjectItemLinks" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ObjectItemLinks" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ObjectItemLinks" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ObjectItemLinks" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ObjectDoors" TO fleet_robot;
GRANT SELECT ON map."ObjectDoors" TO fleet_operator;
GRANT SELECT ON map."ObjectDoors" TO fleet_worker;
ALTER TABLE map."ObjectDoors" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ObjectDoors" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ObjectDoors" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ObjectDoors" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ObjectDoors" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ObjectDoors" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ObjectDoors" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Area" TO fleet_robot;
GRANT SELECT ON map."Area" TO fleet_operator;
GRANT SELECT ON map."Area" TO fleet_worker;
ALTER TABLE map."Area" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Area" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Area" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Area" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Area" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Area" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Area" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."AreaTypeList" TO fleet_robot;
GRANT SELECT ON map."AreaTypeList" TO fleet_operator;
GRANT SELECT ON map."AreaTypeList" TO fleet_worker;
ALTER TABLE map."AreaTypeList" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."AreaTypeList" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."AreaTypeList" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."AreaTypeList" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."AreaTypeList" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."AreaTypeList" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."AreaTypeList" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."AreaItems" TO fleet_robot;
GRANT SELECT ON map."AreaItems" TO fleet_operator;
GRANT SELECT ON map."AreaItems" TO fleet_worker;
ALTER TABLE map."AreaItems" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."AreaItems" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."AreaItems" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."AreaItems" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."AreaItems" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."AreaItems" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."AreaItems" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."AreaItemLinks" TO fleet_robot;
GRANT SELECT ON map."AreaItemLinks" TO fleet_operator;
GRANT SELECT ON map."AreaItemLinks" TO fleet_worker;
ALTER TABLE map."AreaItemLinks" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."AreaItemLinks" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."AreaItemLinks" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."AreaItemLinks" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."AreaItemLinks" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."AreaItemLinks" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."AreaItemLinks" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."AreaDoors" TO fleet_robot;
GRANT SELECT ON map."AreaDoors" TO fleet_operator;
GRANT SELECT ON map."AreaDoors" TO fleet_worker;
ALTER TABLE map."AreaDoors" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."AreaDoors" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."AreaDoors" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."AreaDoors" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."AreaDoors" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."AreaDoors" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."AreaDoors" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."AreaObjects" TO fleet_robot;
GRANT SELECT ON map."AreaObjects" TO fleet_operator;
GRANT SELECT ON map."AreaObjects" TO fleet_worker;
ALTER TABLE map."AreaObjects" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."AreaObjects" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."AreaObjects" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."AreaObjects" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."AreaObjects" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."AreaObjects" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."AreaObjects" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Map" TO fleet_robot;
GRANT SELECT ON map."Map" TO fleet_operator;
GRANT SELECT ON map."Map" TO fleet_worker;
ALTER TABLE map."Map" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Map" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Map" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Map" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Map" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Map" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Map" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."MapTypeList" TO fleet_robot;
GRANT SELECT ON map."MapTypeList" TO fleet_operator;
GRANT SELECT ON map."MapTypeList" TO fleet_worker;
ALTER TABLE map."MapTypeList" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."MapTypeList" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."MapTypeList" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."MapTypeList" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."MapTypeList" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."MapTypeList" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."MapTypeList" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."MapItems" TO fleet_robot;
GRANT SELECT ON map."MapItems" TO fleet_operator;
GRANT SELECT ON map."MapItems" TO fleet_worker;
ALTER TABLE map."MapItems" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."MapItems" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."MapItems" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."MapItems" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."MapItems" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."MapItems" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."MapItems" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."MapItemLinks" TO fleet_robot;
GRANT SELECT ON map."MapItemLinks" TO fleet_operator;
GRANT SELECT ON map."MapItemLinks" TO fleet_worker;
ALTER TABLE map."MapItemLinks" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."MapItemLinks" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."MapItemLinks" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."MapItemLinks" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."MapItemLinks" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."MapItemLinks" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."MapItemLinks" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Domain" TO fleet_robot;
GRANT SELECT ON map."Domain" TO fleet_operator;
GRANT SELECT ON map."Domain" TO fleet_worker;
ALTER TABLE map."Domain" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Domain" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Domain" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Domain" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Domain" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Domain" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Domain" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."DomainMaps" TO fleet_robot;
GRANT SELECT ON map."DomainMaps" TO fleet_operator;
GRANT SELECT ON map."DomainMaps" TO fleet_worker;
ALTER TABLE map."DomainMaps" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."DomainMaps" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."DomainMaps" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."DomainMaps" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."DomainMaps" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."DomainMaps" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."DomainMaps" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Door" TO fleet_robot;
GRANT SELECT ON map."Door" TO fleet_operator;
GRANT SELECT ON map."Door" TO fleet_worker;
ALTER TABLE map."Door" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Door" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Door" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Door" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Door" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Door" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Door" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."DoorTypeList" TO fleet_robot;
GRANT SELECT ON map."DoorTypeList" TO fleet_operator;
GRANT SELECT ON map."DoorTypeList" TO fleet_worker;
ALTER TABLE map."DoorTypeList" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."DoorTypeList" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."DoorTypeList" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."DoorTypeList" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."DoorTypeList" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."DoorTypeList" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."DoorTypeList" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."DoorSides" TO fleet_robot;
GRANT SELECT ON map."DoorSides" TO fleet_operator;
GRANT SELECT ON map."DoorSides" TO fleet_worker;
ALTER TABLE map."DoorSides" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."DoorSides" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."DoorSides" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."DoorSides" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."DoorSides" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."DoorSides" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."DoorSides" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."SideNames" TO fleet_robot;
GRANT SELECT ON map."SideNames" TO fleet_operator;
GRANT SELECT ON map."SideNames" TO fleet_worker;
ALTER TABLE map."SideNames" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."SideNames" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."SideNames" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."SideNames" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."SideNames" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."SideNames" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."SideNames" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ObjectProperties" TO fleet_robot;
GRANT SELECT ON map."ObjectProperties" TO fleet_operator;
GRANT SELECT ON map."ObjectProperties" TO fleet_worker;
ALTER TABLE map."ObjectProperties" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ObjectProperties" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ObjectProperties" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ObjectProperties" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ObjectProperties" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ObjectProperties" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ObjectProperties" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."AreaProperties" TO fleet_robot;
GRANT SELECT ON map."AreaProperties" TO fleet_operator;
GRANT SELECT ON map."AreaProperties" TO fleet_worker;
ALTER TABLE map."AreaProperties" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."AreaProperties" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."AreaProperties" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."AreaProperties" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."AreaProperties" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."AreaProperties" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."AreaProperties" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."DoorProperties" TO fleet_robot;
GRANT SELECT ON map."DoorProperties" TO fleet_operator;
GRANT SELECT ON map."DoorProperties" TO fleet_worker;
ALTER TABLE map."DoorProperties" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."DoorProperties" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."DoorProperties" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."DoorProperties" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."DoorProperties" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."DoorProperties" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."DoorProperties" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ReplicaProperties" TO fleet_robot;
GRANT SELECT ON map."ReplicaProperties" TO fleet_operator;
GRANT SELECT ON map."ReplicaProperties" TO fleet_worker;
ALTER TABLE map."ReplicaProperties" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ReplicaProperties" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ReplicaProperties" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ReplicaProperties" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ReplicaProperties" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ReplicaProperties" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ReplicaProperties" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ReplicaDoors" TO fleet_robot;
GRANT SELECT ON map."ReplicaDoors" TO fleet_operator;
GRANT SELECT ON map."ReplicaDoors" TO fleet_worker;
ALTER TABLE map."ReplicaDoors" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ReplicaDoors" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ReplicaDoors" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ReplicaDoors" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ReplicaDoors" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ReplicaDoors" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ReplicaDoors" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."TypeWords" TO fleet_robot;
GRANT SELECT ON map."TypeWords" TO fleet_operator;
GRANT SELECT ON map."TypeWords" TO fleet_worker;
ALTER TABLE map."TypeWords" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."TypeWords" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."TypeWords" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."TypeWords" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."TypeWords" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."TypeWords" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."TypeWords" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."NameForms" TO fleet_robot;
GRANT SELECT ON map."NameForms" TO fleet_operator;
GRANT SELECT ON map."NameForms" TO fleet_worker;
ALTER TABLE map."NameForms" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."NameForms" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."NameForms" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."NameForms" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."NameForms" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."NameForms" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."NameForms" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Places" TO fleet_robot;
GRANT SELECT ON map."Places" TO fleet_operator;
GRANT SELECT ON map."Places" TO fleet_worker;
ALTER TABLE map."Places" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Places" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Places" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Places" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Places" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Places" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Places" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Lifts" TO fleet_robot;
GRANT SELECT ON map."Lifts" TO fleet_operator;
GRANT SELECT ON map."Lifts" TO fleet_worker;
ALTER TABLE map."Lifts" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Lifts" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Lifts" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Lifts" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Lifts" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Lifts" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Lifts" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."LiftStops" TO fleet_robot;
GRANT SELECT ON map."LiftStops" TO fleet_operator;
GRANT SELECT ON map."LiftStops" TO fleet_worker;
ALTER TABLE map."LiftStops" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."LiftStops" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."LiftStops" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."LiftStops" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."LiftStops" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."LiftStops" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."LiftStops" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Robot" TO fleet_robot;
GRANT SELECT ON map."Robot" TO fleet_operator;
GRANT SELECT ON map."Robot" TO fleet_worker;
ALTER TABLE map."Robot" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Robot" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Robot" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Robot" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Robot" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Robot" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Robot" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."Zones" TO fleet_robot;
GRANT SELECT ON map."Zones" TO fleet_operator;
GRANT SELECT ON map."Zones" TO fleet_worker;
ALTER TABLE map."Zones" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."Zones" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."Zones" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."Zones" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."Zones" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."Zones" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."Zones" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON map."ZoneAreas" TO fleet_robot;
GRANT SELECT ON map."ZoneAreas" TO fleet_operator;
GRANT SELECT ON map."ZoneAreas" TO fleet_worker;
ALTER TABLE map."ZoneAreas" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON map."ZoneAreas" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON map."ZoneAreas" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON map."ZoneAreas" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON map."ZoneAreas" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON map."ZoneAreas" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON map."ZoneAreas" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."RobotPose" TO fleet_robot;
GRANT SELECT ON log."RobotPose" TO fleet_operator;
GRANT SELECT ON log."RobotPose" TO fleet_worker;
ALTER TABLE log."RobotPose" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."RobotPose" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."RobotPose" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."RobotPose" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."RobotPose" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."RobotPose" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."RobotPose" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Observations" TO fleet_robot;
GRANT SELECT ON log."Observations" TO fleet_operator;
GRANT SELECT ON log."Observations" TO fleet_worker;
ALTER TABLE log."Observations" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Observations" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Observations" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Observations" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Observations" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Observations" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Observations" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Revisions" TO fleet_robot;
GRANT SELECT ON log."Revisions" TO fleet_operator;
GRANT SELECT ON log."Revisions" TO fleet_worker;
ALTER TABLE log."Revisions" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Revisions" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Revisions" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Revisions" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Revisions" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Revisions" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Revisions" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."LastIds" TO fleet_robot;
GRANT SELECT ON log."LastIds" TO fleet_operator;
GRANT SELECT ON log."LastIds" TO fleet_worker;
ALTER TABLE log."LastIds" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."LastIds" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."LastIds" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."LastIds" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."LastIds" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."LastIds" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."LastIds" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Verdicts" TO fleet_robot;
GRANT SELECT ON log."Verdicts" TO fleet_operator;
GRANT SELECT ON log."Verdicts" TO fleet_worker;
ALTER TABLE log."Verdicts" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Verdicts" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Verdicts" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Verdicts" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Verdicts" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Verdicts" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Verdicts" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."DoorStates" TO fleet_robot;
GRANT SELECT ON log."DoorStates" TO fleet_operator;
GRANT SELECT ON log."DoorStates" TO fleet_worker;
ALTER TABLE log."DoorStates" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."DoorStates" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."DoorStates" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."DoorStates" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."DoorStates" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."DoorStates" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."DoorStates" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Carried" TO fleet_robot;
GRANT SELECT ON log."Carried" TO fleet_operator;
GRANT SELECT ON log."Carried" TO fleet_worker;
ALTER TABLE log."Carried" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Carried" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Carried" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Carried" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Carried" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Carried" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Carried" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."DeviceStates" TO fleet_robot;
GRANT SELECT ON log."DeviceStates" TO fleet_operator;
GRANT SELECT ON log."DeviceStates" TO fleet_worker;
ALTER TABLE log."DeviceStates" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."DeviceStates" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."DeviceStates" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."DeviceStates" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."DeviceStates" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."DeviceStates" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."DeviceStates" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Beliefs" TO fleet_robot;
GRANT SELECT ON log."Beliefs" TO fleet_operator;
GRANT SELECT ON log."Beliefs" TO fleet_worker;
ALTER TABLE log."Beliefs" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Beliefs" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Beliefs" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Beliefs" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Beliefs" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Beliefs" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Beliefs" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Obstacles" TO fleet_robot;
GRANT SELECT ON log."Obstacles" TO fleet_operator;
GRANT SELECT ON log."Obstacles" TO fleet_worker;
ALTER TABLE log."Obstacles" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Obstacles" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Obstacles" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Obstacles" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Obstacles" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Obstacles" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Obstacles" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."FoundPoses" TO fleet_robot;
GRANT SELECT ON log."FoundPoses" TO fleet_operator;
GRANT SELECT ON log."FoundPoses" TO fleet_worker;
ALTER TABLE log."FoundPoses" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."FoundPoses" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."FoundPoses" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."FoundPoses" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."FoundPoses" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."FoundPoses" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."FoundPoses" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."OpenStates" TO fleet_robot;
GRANT SELECT ON log."OpenStates" TO fleet_operator;
GRANT SELECT ON log."OpenStates" TO fleet_worker;
ALTER TABLE log."OpenStates" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."OpenStates" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."OpenStates" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."OpenStates" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."OpenStates" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."OpenStates" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."OpenStates" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Tasks" TO fleet_robot;
GRANT SELECT ON log."Tasks" TO fleet_operator;
GRANT SELECT ON log."Tasks" TO fleet_worker;
ALTER TABLE log."Tasks" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Tasks" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Tasks" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Tasks" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Tasks" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Tasks" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Tasks" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON log."Pause" TO fleet_robot;
GRANT SELECT ON log."Pause" TO fleet_operator;
GRANT SELECT ON log."Pause" TO fleet_worker;
ALTER TABLE log."Pause" ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON log."Pause" FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON log."Pause" FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON log."Pause" TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON log."Pause" FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON log."Pause" FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON log."Pause" FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT ON fleet.frame TO fleet_robot;
GRANT SELECT ON fleet.frame TO fleet_operator;
GRANT SELECT ON fleet.frame TO fleet_worker;
ALTER TABLE fleet.frame ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.frame FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON fleet.frame FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON fleet.frame TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON fleet.frame FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON fleet.mission TO fleet_robot;
GRANT SELECT ON fleet.mission TO fleet_operator;
GRANT SELECT ON fleet.mission TO fleet_worker;
ALTER TABLE fleet.mission ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.mission FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON fleet.mission FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON fleet.mission TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON fleet.mission FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON fleet.mission FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON fleet.mission FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT, INSERT, UPDATE, DELETE ON fleet.conflict TO fleet_robot;
GRANT SELECT ON fleet.conflict TO fleet_operator;
GRANT SELECT ON fleet.conflict TO fleet_worker;
ALTER TABLE fleet.conflict ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.conflict FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON fleet.conflict FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON fleet.conflict TO fleet_worker USING (true) WITH CHECK (true);
CREATE POLICY robot_adds ON fleet.conflict FOR INSERT TO fleet_robot
    WITH CHECK (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_changes ON fleet.conflict FOR UPDATE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));
CREATE POLICY robot_removes ON fleet.conflict FOR DELETE TO fleet_robot
    USING (building = (SELECT fleet.my_building()) AND robot = (SELECT fleet.my_robot()));

GRANT SELECT ON fleet.fact TO fleet_robot;
GRANT SELECT ON fleet.fact TO fleet_operator;
GRANT SELECT, INSERT, UPDATE, DELETE ON fleet.fact TO fleet_worker;
ALTER TABLE fleet.fact ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.fact FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON fleet.fact FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON fleet.fact TO fleet_worker USING (true) WITH CHECK (true);

GRANT SELECT ON fleet.kind TO fleet_robot;
GRANT SELECT ON fleet.kind TO fleet_operator;
GRANT SELECT, INSERT, UPDATE, DELETE ON fleet.kind TO fleet_worker;
ALTER TABLE fleet.kind ENABLE ROW LEVEL SECURITY;
CREATE POLICY robot_reads ON fleet.kind FOR SELECT TO fleet_robot USING (building = (SELECT fleet.my_building()));
CREATE POLICY operator_reads ON fleet.kind FOR SELECT TO fleet_operator
    USING ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building()));
CREATE POLICY worker_works ON fleet.kind TO fleet_worker USING (true) WITH CHECK (true);
