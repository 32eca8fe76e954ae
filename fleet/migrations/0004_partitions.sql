-- Eight partitions a table, by building. A distributed server divides the tables itself: there this file is left out, and
-- so are the words PARTITION BY HASH (building) in the files before it (ortho-fleet migrate --undivided).

DO $$
DECLARE t record;
BEGIN
    FOR t IN SELECT c.oid::regclass AS name, n.nspname AS schema, c.relname AS rel
             FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace
             WHERE c.relkind = 'p' AND n.nspname IN ('fleet', 'map', 'log')
    LOOP
        FOR i IN 0..7 LOOP
            EXECUTE format('CREATE TABLE %I.%I PARTITION OF %s FOR VALUES WITH (MODULUS 8, REMAINDER %s)',
                           t.schema, t.rel || '_' || i, t.name, i);
        END LOOP;
    END LOOP;
END $$;
