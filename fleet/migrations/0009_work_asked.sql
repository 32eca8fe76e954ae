-- The map that waits longest is found without going through all that wait.
CREATE INDEX work_asked ON fleet.work (asked, building, robot);
