-- The four derived tables of paper 2: sides of Orthoframes in the frame of Object, Area and Map, always computed. And what
-- people ask of often. All are read with the rights of who asks.

CREATE VIEW map."ObjectItemSides" WITH (security_invoker = true) AS
SELECT i.building, i.robot, i."ObjectID", i."ItemID", i."OrFrID", s."SideID", s."SideTypeID", s."SidePntr", i."Base",
       i."PosX" + cosd(i."PosA") * s."X1" - sind(i."PosA") * s."Y1" AS "X1",
       i."PosY" + sind(i."PosA") * s."X1" + cosd(i."PosA") * s."Y1" AS "Y1",
       i."PosX" + cosd(i."PosA") * s."X2" - sind(i."PosA") * s."Y2" AS "X2",
       i."PosY" + sind(i."PosA") * s."X2" + cosd(i."PosA") * s."Y2" AS "Y2",
       s."Len", mod((i."PosA" + s."Ang" + 720)::numeric, 360)::double precision AS "Ang", i."PosZ" AS "Z", o."Roof" AS "Hieght"
FROM map."ObjectItems" i
JOIN map."OrFr" o ON o.building = i.building AND o.robot = i.robot AND o."ID" = i."OrFrID"
    AND o.revision_to IS NULL AND NOT o."Deleted"
JOIN map."OrtFrmSides" s ON s.building = i.building AND s.robot = i.robot AND s."OrFrID" = i."OrFrID"
    AND s.revision_to IS NULL AND NOT s."Deleted"
WHERE i.revision_to IS NULL AND NOT i."Deleted";

CREATE VIEW map."AreaItemSides" WITH (security_invoker = true) AS
SELECT i.building, i.robot, i."AreaID", i."ItemID", i."OrFrID", s."SideID", s."SideTypeID", s."SidePntr", i."Base",
       i."PosX" + cosd(i."PosA") * s."X1" - sind(i."PosA") * s."Y1" AS "X1",
       i."PosY" + sind(i."PosA") * s."X1" + cosd(i."PosA") * s."Y1" AS "Y1",
       i."PosX" + cosd(i."PosA") * s."X2" - sind(i."PosA") * s."Y2" AS "X2",
       i."PosY" + sind(i."PosA") * s."X2" + cosd(i."PosA") * s."Y2" AS "Y2",
       s."Len", mod((i."PosA" + s."Ang" + 720)::numeric, 360)::double precision AS "Ang", i."PosZ" AS "Z", o."Roof" AS "Hieght"
FROM map."AreaItems" i
JOIN map."OrFr" o ON o.building = i.building AND o.robot = i.robot AND o."ID" = i."OrFrID"
    AND o.revision_to IS NULL AND NOT o."Deleted"
JOIN map."OrtFrmSides" s ON s.building = i.building AND s.robot = i.robot AND s."OrFrID" = i."OrFrID"
    AND s.revision_to IS NULL AND NOT s."Deleted"
WHERE i.revision_to IS NULL AND NOT i."Deleted";

CREATE VIEW map."AreaObjectSides" WITH (security_invoker = true) AS
SELECT r.building, r.robot, r."AreaID", r."ObjectID", r."ReplID", i."ItemID", i."OrFrID", i."SideID", i."SideTypeID",
       i."SidePntr", i."Base",
       r."X" + cosd(r."Ang") * i."X1" - sind(r."Ang") * i."Y1" AS "X1",
       r."Y" + sind(r."Ang") * i."X1" + cosd(r."Ang") * i."Y1" AS "Y1",
       r."X" + cosd(r."Ang") * i."X2" - sind(r."Ang") * i."Y2" AS "X2",
       r."Y" + sind(r."Ang") * i."X2" + cosd(r."Ang") * i."Y2" AS "Y2",
       i."Len", mod((r."Ang" + i."Ang" + 720)::numeric, 360)::double precision AS "Ang", r."Z" + i."Z" AS "Z", i."Hieght"
FROM map."AreaObjects" r
JOIN map."ObjectItemSides" i ON i.building = r.building AND i.robot = r.robot AND i."ObjectID" = r."ObjectID"
WHERE r.revision_to IS NULL AND NOT r."Deleted";

CREATE VIEW map."MapItemSides" WITH (security_invoker = true) AS
SELECT m.building, m.robot, m."MapID", m."ItemID", m."AreaID", i."OrFrID", i."SideID", i."SideTypeID", i."SidePntr",
       m."Base",
       m."PosX" + cosd(m."PosA") * i."X1" - sind(m."PosA") * i."Y1" AS "X1",
       m."PosY" + sind(m."PosA") * i."X1" + cosd(m."PosA") * i."Y1" AS "Y1",
       m."PosX" + cosd(m."PosA") * i."X2" - sind(m."PosA") * i."Y2" AS "X2",
       m."PosY" + sind(m."PosA") * i."X2" + cosd(m."PosA") * i."Y2" AS "Y2",
       i."Len", mod((m."PosA" + i."Ang" + 720)::numeric, 360)::double precision AS "Ang", m."PosZ" + i."Z" AS "Z", i."Hieght",
       i."ItemID" AS "AreaItemID"
FROM map."MapItems" m
JOIN map."AreaItemSides" i ON i.building = m.building AND i.robot = m.robot AND i."AreaID" = m."AreaID"
WHERE m.revision_to IS NULL AND NOT m."Deleted";

-- Which robot saw a thing last, and where.
CREATE VIEW fleet.last_seen WITH (security_invoker = true) AS
SELECT DISTINCT ON (b.building, t."Name") b.building, t."Name" AS thing, b.robot, r.name AS robot_name,
       timestamptz 'epoch' + b."LastSeen" * interval '1 millisecond' AS seen, a."Name" AS area, b."X", b."Y", b."Confidence"
FROM log."Beliefs" b
JOIN map."AreaObjects" t ON t.building = b.building AND t.robot = b.robot AND t."ReplID" = b."ReplID"
    AND t.revision_to IS NULL AND NOT t."Deleted"
JOIN fleet.robot r ON r.building = b.building AND r.robot = b.robot
LEFT JOIN map."Area" a ON a.building = b.building AND a.robot = b.robot AND a."ID" = b."AreaID" AND a.revision_to IS NULL
WHERE b."LastSeen" IS NOT NULL AND NOT b."Deleted"
ORDER BY b.building, t."Name", b."LastSeen" DESC;

-- What the robots propose: a thing believed more than 30 cm from where the map has it, as the robot's own store does.
CREATE VIEW fleet.proposal WITH (security_invoker = true) AS
SELECT b.building, b.robot, t."ReplID" AS replica, t."Name" AS thing, m."Name" AS mapped_area, a."Name" AS area,
       b."X" AS x, b."Y" AS y, b."Confidence" AS sure,
       timestamptz 'epoch' + b."LastSeen" * interval '1 millisecond' AS seen,
       CASE WHEN b."AreaID" = t."AreaID"
            THEN sqrt((b."X" - t."X") ^ 2 + (b."Y" - t."Y") ^ 2 + (b."Z" - t."Z") ^ 2) END AS apart
FROM log."Beliefs" b
JOIN map."AreaObjects" t ON t.building = b.building AND t.robot = b.robot AND t."ReplID" = b."ReplID"
    AND t.revision_to IS NULL AND NOT t."Deleted"
LEFT JOIN map."Area" a ON a.building = b.building AND a.robot = b.robot AND a."ID" = b."AreaID" AND a.revision_to IS NULL
LEFT JOIN map."Area" m ON m.building = t.building AND m.robot = t.robot AND m."ID" = t."AreaID" AND m.revision_to IS NULL
WHERE NOT b."Deleted" AND b."Survey" = t.revision AND b."Confidence" >= 0.5
    AND (b."AreaID" <> t."AreaID"
         OR sqrt((b."X" - t."X") ^ 2 + (b."Y" - t."Y") ^ 2 + (b."Z" - t."Z") ^ 2) > 30);

GRANT SELECT ON map."ObjectItemSides", map."AreaItemSides", map."AreaObjectSides", map."MapItemSides",
    fleet.last_seen, fleet.proposal TO fleet_operator, fleet_worker;
