-- Operators who edit: revisions of the centre's map, robot 0, made in a browser. And a browser's sessions, which are keys
-- that end by themselves and are made from an operator's own.

ALTER TABLE fleet.key ADD COLUMN edits boolean NOT NULL DEFAULT false;
ALTER TABLE fleet.key ADD COLUMN until timestamptz;

CREATE OR REPLACE FUNCTION fleet.my_building() RETURNS bigint LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT building FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now())
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8')) $$;
CREATE OR REPLACE FUNCTION fleet.my_robot() RETURNS bigint LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT robot FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now()) AND kind = 'robot'
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8')) $$;
CREATE OR REPLACE FUNCTION fleet.sees_all() RETURNS boolean LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT EXISTS (SELECT FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now()) AND kind = 'operator' AND building IS NULL
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))) $$;
CREATE OR REPLACE FUNCTION fleet.my_kind() RETURNS text LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT kind FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now())
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8')) $$;
CREATE OR REPLACE FUNCTION fleet.may_edit() RETURNS boolean LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT EXISTS (SELECT FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now()) AND kind = 'operator' AND edits
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))) $$;
CREATE OR REPLACE FUNCTION fleet.my_name() RETURNS text LANGUAGE sql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ SELECT name FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now())
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8')) $$;
REVOKE EXECUTE ON FUNCTION fleet.may_edit(), fleet.my_name() FROM PUBLIC;
GRANT EXECUTE ON FUNCTION fleet.may_edit(), fleet.my_name() TO fleet_robot, fleet_operator;

-- Of a robot an editor sets what was agreed on; of the centre its revision.
GRANT UPDATE (agreed_centre, agreed_robot, revision, reported) ON fleet.robot TO fleet_operator;
CREATE POLICY editor_changes ON fleet.robot FOR UPDATE TO fleet_operator
    USING ((SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
GRANT UPDATE (settled) ON fleet.conflict TO fleet_operator;
CREATE POLICY editor_settles ON fleet.conflict FOR UPDATE TO fleet_operator
    USING ((SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
GRANT INSERT ON fleet.work TO fleet_operator;
CREATE POLICY editor_asks ON fleet.work FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."OrFr" TO fleet_operator;
CREATE POLICY editor_adds ON map."OrFr" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."OrFr" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."OrtFrmShapeList" TO fleet_operator;
CREATE POLICY editor_adds ON map."OrtFrmShapeList" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."OrtFrmShapeList" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."OrtFrmTypeList" TO fleet_operator;
CREATE POLICY editor_adds ON map."OrtFrmTypeList" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."OrtFrmTypeList" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."OrtFrmProperties" TO fleet_operator;
CREATE POLICY editor_adds ON map."OrtFrmProperties" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."OrtFrmProperties" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."OrtFrmSides" TO fleet_operator;
CREATE POLICY editor_adds ON map."OrtFrmSides" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."OrtFrmSides" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."OrtFrmSideTypeList" TO fleet_operator;
CREATE POLICY editor_adds ON map."OrtFrmSideTypeList" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."OrtFrmSideTypeList" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."OrtFrmSideProperties" TO fleet_operator;
CREATE POLICY editor_adds ON map."OrtFrmSideProperties" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."OrtFrmSideProperties" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Object" TO fleet_operator;
CREATE POLICY editor_adds ON map."Object" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Object" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ObjectTypeList" TO fleet_operator;
CREATE POLICY editor_adds ON map."ObjectTypeList" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ObjectTypeList" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ObjectItems" TO fleet_operator;
CREATE POLICY editor_adds ON map."ObjectItems" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ObjectItems" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ObjectItemLinks" TO fleet_operator;
CREATE POLICY editor_adds ON map."ObjectItemLinks" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ObjectItemLinks" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ObjectDoors" TO fleet_operator;
CREATE POLICY editor_adds ON map."ObjectDoors" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ObjectDoors" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Area" TO fleet_operator;
CREATE POLICY editor_adds ON map."Area" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Area" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."AreaTypeList" TO fleet_operator;
CREATE POLICY editor_adds ON map."AreaTypeList" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."AreaTypeList" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."AreaItems" TO fleet_operator;
CREATE POLICY editor_adds ON map."AreaItems" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."AreaItems" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."AreaItemLinks" TO fleet_operator;
CREATE POLICY editor_adds ON map."AreaItemLinks" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."AreaItemLinks" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."AreaDoors" TO fleet_operator;
CREATE POLICY editor_adds ON map."AreaDoors" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."AreaDoors" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."AreaObjects" TO fleet_operator;
CREATE POLICY editor_adds ON map."AreaObjects" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."AreaObjects" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Map" TO fleet_operator;
CREATE POLICY editor_adds ON map."Map" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Map" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."MapTypeList" TO fleet_operator;
CREATE POLICY editor_adds ON map."MapTypeList" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."MapTypeList" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."MapItems" TO fleet_operator;
CREATE POLICY editor_adds ON map."MapItems" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."MapItems" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."MapItemLinks" TO fleet_operator;
CREATE POLICY editor_adds ON map."MapItemLinks" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."MapItemLinks" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Domain" TO fleet_operator;
CREATE POLICY editor_adds ON map."Domain" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Domain" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."DomainMaps" TO fleet_operator;
CREATE POLICY editor_adds ON map."DomainMaps" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."DomainMaps" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Door" TO fleet_operator;
CREATE POLICY editor_adds ON map."Door" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Door" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."DoorTypeList" TO fleet_operator;
CREATE POLICY editor_adds ON map."DoorTypeList" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."DoorTypeList" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."DoorSides" TO fleet_operator;
CREATE POLICY editor_adds ON map."DoorSides" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."DoorSides" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."SideNames" TO fleet_operator;
CREATE POLICY editor_adds ON map."SideNames" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."SideNames" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ObjectProperties" TO fleet_operator;
CREATE POLICY editor_adds ON map."ObjectProperties" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ObjectProperties" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."AreaProperties" TO fleet_operator;
CREATE POLICY editor_adds ON map."AreaProperties" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."AreaProperties" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."DoorProperties" TO fleet_operator;
CREATE POLICY editor_adds ON map."DoorProperties" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."DoorProperties" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ReplicaProperties" TO fleet_operator;
CREATE POLICY editor_adds ON map."ReplicaProperties" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ReplicaProperties" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ReplicaDoors" TO fleet_operator;
CREATE POLICY editor_adds ON map."ReplicaDoors" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ReplicaDoors" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."TypeWords" TO fleet_operator;
CREATE POLICY editor_adds ON map."TypeWords" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."TypeWords" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."NameForms" TO fleet_operator;
CREATE POLICY editor_adds ON map."NameForms" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."NameForms" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Places" TO fleet_operator;
CREATE POLICY editor_adds ON map."Places" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Places" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Lifts" TO fleet_operator;
CREATE POLICY editor_adds ON map."Lifts" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Lifts" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."LiftStops" TO fleet_operator;
CREATE POLICY editor_adds ON map."LiftStops" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."LiftStops" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Robot" TO fleet_operator;
CREATE POLICY editor_adds ON map."Robot" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Robot" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."Zones" TO fleet_operator;
CREATE POLICY editor_adds ON map."Zones" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."Zones" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON map."ZoneAreas" TO fleet_operator;
CREATE POLICY editor_adds ON map."ZoneAreas" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON map."ZoneAreas" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));

GRANT INSERT, UPDATE ON log."Revisions" TO fleet_operator;
CREATE POLICY editor_adds ON log."Revisions" FOR INSERT TO fleet_operator
    WITH CHECK (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
CREATE POLICY editor_changes ON log."Revisions" FOR UPDATE TO fleet_operator
    USING (robot = 0 AND (SELECT fleet.may_edit()) AND ((SELECT fleet.sees_all()) OR building = (SELECT fleet.my_building())));
