-- The same questions of the key, in the language whose plans a connection keeps: every statement asks some of them, and a
-- function in plain SQL that has its owner's rights is planned anew each time.

CREATE OR REPLACE FUNCTION fleet.my_building() RETURNS bigint LANGUAGE plpgsql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ BEGIN RETURN (SELECT building FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now())
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))); END $$;
CREATE OR REPLACE FUNCTION fleet.my_robot() RETURNS bigint LANGUAGE plpgsql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ BEGIN RETURN (SELECT robot FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now()) AND kind = 'robot'
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))); END $$;
CREATE OR REPLACE FUNCTION fleet.my_kind() RETURNS text LANGUAGE plpgsql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ BEGIN RETURN (SELECT kind FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now())
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))); END $$;
CREATE OR REPLACE FUNCTION fleet.my_name() RETURNS text LANGUAGE plpgsql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ BEGIN RETURN (SELECT name FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now())
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))); END $$;
CREATE OR REPLACE FUNCTION fleet.sees_all() RETURNS boolean LANGUAGE plpgsql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ BEGIN RETURN EXISTS (SELECT FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now()) AND kind = 'operator' AND building IS NULL
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))); END $$;
CREATE OR REPLACE FUNCTION fleet.may_edit() RETURNS boolean LANGUAGE plpgsql STABLE SECURITY DEFINER SET search_path = pg_catalog AS
$$ BEGIN RETURN EXISTS (SELECT FROM fleet.key WHERE revoked IS NULL AND (until IS NULL OR until > now()) AND kind = 'operator' AND edits
   AND hash = sha256(convert_to(current_setting('fleet.key', true), 'UTF8'))); END $$;
