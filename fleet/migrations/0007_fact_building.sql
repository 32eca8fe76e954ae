-- What holds now of one relation in one building: joins over many buildings go by it.
CREATE INDEX fact_building ON fleet.fact (relation, building, subject) INCLUDE (robot, object) WHERE revision_to IS NULL;
