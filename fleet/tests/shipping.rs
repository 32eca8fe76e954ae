//! Robots push their journals to a centre on a real PostgreSQL, by lines that are cut, in any order: afterwards the centre
//! holds what each robot's own store holds, record by record. While either side is killed: `show.rs`.

mod common;

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use common::badly::push_badly;
use common::robot::{home, live, must_be_same};
use common::{BadLine, Centre, Postgres, furnish, scratch};
use orthoframe_fleet::push::Line;
use orthoframe_fleet::rows::{kind, place};
use orthoframe_fleet::{FleetError, db, keys, migrate};
use orthoframe_store::Table;
use orthoframe_store::shipping::whole;

const QUICK: &str = "-c fsync=off -c full_page_writes=off";

fn push_until_done(line: &Line, store: &Path, rng: &mut fastrand::Rng) {
    let begin = Instant::now();
    loop {
        match push_badly(line, store, rng) {
            Ok(_) => return,
            Err(FleetError::Line { .. } | FleetError::Gap { .. }) => {}
            Err(error) => panic!("{error}"),
        }
        assert!(begin.elapsed() < Duration::from_secs(600), "no way through");
        std::thread::sleep(Duration::from_millis(rng.u64(1..30)));
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn on_bad_lines_all_that_robots_hold_comes_to_the_centre() {
    let Some(postgres) = Postgres::start(QUICK) else { return };
    let (robots, frames) = (12, 200);
    // Some buildings have two robots.
    let all: Vec<(i64, i64)> = (0..robots as i64).map(|n| (1 + n * 2 / 3, 1 + n)).collect();
    let keys = furnish(&postgres.address(), &all).await;
    let centre = Centre::start(&postgres.address());
    let bad = BadLine::to(centre.address, 20_000, 33);
    let (dir, home) = (scratch(), home());
    let store = |n: usize| dir.path().join(format!("{n}"));
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| {
                loop {
                    let n = next.fetch_add(1, Ordering::Relaxed);
                    let Some(key) = keys.get(n) else { return };
                    let mut rng = fastrand::Rng::with_seed(n as u64);
                    let url = format!("http://{}", bad.address);
                    let line = Line::new(&url, key, None).expect("loopback");
                    // It lives offline and catches up, in a few goes.
                    for part in 0..4 {
                        live(
                            &store(n),
                            frames / 4,
                            (n * 4 + part) as u64,
                            &home,
                            n.is_multiple_of(3),
                        );
                        push_until_done(&line, &store(n), &mut rng);
                    }
                }
            });
        }
    });
    assert!(bad.cuts.load(Ordering::Relaxed) > robots as u64 / 2, "lines were cut");
    let pool = db::pool(&postgres.address(), 2).expect("an address");
    for (n, (building, robot)) in all.iter().enumerate() {
        must_be_same(&pool, *building, *robot, &store(n), n.is_multiple_of(3)).await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_store_that_went_another_way_or_was_compacted_is_sent_whole() {
    let Some(postgres) = Postgres::start(QUICK) else { return };
    let keys = furnish(&postgres.address(), &[(1, 1)]).await;
    let centre = Centre::start(&postgres.address());
    let (dir, home) = (scratch(), home());
    let (store, backup) = (dir.path().join("store"), dir.path().join("backup"));
    let line = Line::new(&centre.url(), &keys[0], None).expect("loopback");
    let pool = db::pool(&postgres.address(), 2).expect("an address");
    live(&store, 20, 1, &home, false);
    copy_dir(&store, &backup);
    live(&store, 20, 2, &home, false);
    assert!(!line.push(&store).expect("it is taken").whole);
    // Put back from a backup, and gone on otherwise: as long as before, shorter, and longer.
    for (more, seed) in [(20, 3), (5, 4), (50, 5)] {
        std::fs::remove_dir_all(&store).expect("removes");
        copy_dir(&backup, &store);
        live(&store, more, seed, &home, false);
        let pushed = line.push(&store).expect("it is taken");
        assert!(pushed.whole, "{more}");
        must_be_same(&pool, 1, 1, &store, false).await;
        live(&store, 5, seed + 10, &home, false);
        assert!(!line.push(&store).expect("it is taken").whole);
        must_be_same(&pool, 1, 1, &store, false).await;
    }
    // Weeks offline: the journal does not reach back any more.
    live(&store, 30, 60, &home, false);
    let journal = store.join("journal");
    {
        let (mut opened, _) = orthoframe_store::Store::open(&store).expect("opens");
        let now = orthoframe_store::Timestamp(1_900_000_000_000);
        let change = orthoframe_store::Change::new("op", now, "забыть");
        for _ in 0..4 {
            let revision = opened.revision();
            opened.forget_before(revision, &change).expect("forgets");
        }
    }
    let first = std::fs::read_dir(&journal).expect("lists").flatten().map(|f| f.file_name()).min();
    assert_ne!(first.expect("a file").to_string_lossy(), "00000000000000000001.journal");
    assert!(line.push(&store).expect("it is taken").whole);
    must_be_same(&pool, 1, 1, &store, false).await;
}

/// A centre that takes the line and never answers, or none at all: the robot's store works on, and nothing of it is held.
#[test]
fn the_store_works_on_whatever_becomes_of_the_line() {
    let (dir, home) = (scratch(), home());
    let store = dir.path().join("store");
    live(&store, 20, 1, &home, false);
    let before = whole(&store).expect("reads").sequence;
    let deaf = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let deaf_at = deaf.local_addr().expect("bound");
    let (came, heard) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let lines: Vec<_> =
            deaf.incoming().flatten().inspect(|_| came.send(()).unwrap_or_default()).collect();
        drop(lines);
    });
    for (url, is_reached) in
        [(format!("http://{deaf_at}"), true), ("http://127.0.0.1:9".into(), false)]
    {
        let mut pushing = std::process::Command::new(env!("CARGO_BIN_EXE_ortho-fleet"))
            .args(["push", "--pull", "--to", &url, "--key", "key", "--every", "1", "--store"])
            .arg(&store)
            .stderr(std::process::Stdio::null())
            .spawn()
            .expect("it starts");
        if is_reached {
            heard.recv_timeout(Duration::from_secs(30)).expect("it asks");
        }
        // To open it for writing is to hold its lock; each of these waits for no line.
        for part in 0..3 {
            live(&store, 30, part + 2, &home, false);
        }
        assert!(pushing.try_wait().expect("it ran").is_none(), "it goes on trying");
        let _ = pushing.kill();
        let _ = pushing.wait();
    }
    let read = whole(&store).expect("reads");
    assert!(read.sequence >= before + 6 * 20, "{before} {}", read.sequence);
}

fn copy_dir(from: &Path, to: &PathBuf) {
    std::fs::create_dir_all(to).expect("makes");
    for entry in std::fs::read_dir(from).expect("lists").flatten() {
        let to = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy_dir(&entry.path(), &to);
        } else {
            std::fs::copy(entry.path(), to).expect("copies");
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_key_of_another_building_gets_nothing() {
    let Some(postgres) = Postgres::start(QUICK) else { return };
    let keys_made = furnish(&postgres.address(), &[(1, 1), (2, 1), (2, 2)]).await;
    let centre = Centre::start(&postgres.address());
    let (dir, home) = (scratch(), home());
    for (n, key) in keys_made.iter().enumerate() {
        let store = dir.path().join(n.to_string());
        live(&store, 20, n as u64, &home, false);
        Line::new(&centre.url(), key, None).expect("loopback").push(&store).expect("taken");
    }
    for wrong in ["", "x", "0000", "'; DROP SCHEMA map CASCADE; --", "ключ"] {
        let line = Line::new(&centre.url(), wrong, None).expect("loopback");
        let answer = line.position();
        assert!(matches!(answer, Err(FleetError::Key | FleetError::Line { .. })), "{answer:?}");
    }
    // Whoever may write SQL in the name of robots sees with a key its building only, and without one nothing.
    let pool = db::pool(&postgres.address(), 1).expect("an address");
    let mut client = pool.get().await.expect("connects");
    let tables: Vec<String> =
        Table::ALL.iter().filter(|t| t.is_stored()).map(|t| place(*t)).collect();
    let own = ["fleet.frame", "fleet.robot", "fleet.building", "fleet.mission", "fleet.fact"];
    for (key, allowed) in [(keys_made[0].as_str(), Some(1_i64)), ("stolen", None), ("", None)] {
        let transaction = client.transaction().await.expect("begins");
        transaction.batch_execute("SET LOCAL ROLE fleet_robot").await.expect("a role");
        transaction
            .execute("SELECT set_config('fleet.key', $1, true)", &[&key])
            .await
            .expect("is set");
        for table in tables.iter().map(String::as_str).chain(own) {
            let sql = format!("SELECT DISTINCT building FROM {table}");
            let rows = transaction.query(&sql, &[]).await.expect("reads");
            let seen: Vec<i64> = rows.iter().map(|row| row.get(0)).collect();
            assert!(seen.iter().all(|b| Some(*b) == allowed), "{key}: {table} {seen:?}");
        }
        let frames = transaction.query_one("SELECT count(*) FROM fleet.frame", &[]).await;
        let frames: i64 = frames.expect("reads").get(0);
        assert_eq!(frames > 0, allowed.is_some());
        assert!(
            transaction.query("SELECT 1 FROM fleet.key", &[]).await.is_err(),
            "keys are hidden"
        );
        transaction.rollback().await.expect("ends");
        // Nor does it write another's rows: of another building, or of another robot of its own.
        for (building, robot) in [(2_i64, 1_i64), (1, 2)] {
            let transaction = client.transaction().await.expect("begins");
            transaction.batch_execute("SET LOCAL ROLE fleet_robot").await.expect("a role");
            transaction
                .execute("SELECT set_config('fleet.key', $1, true)", &[&key])
                .await
                .expect("is set");
            let sql = "INSERT INTO fleet.frame (building, robot, epoch, sequence, checksum, bytes) \
                       VALUES ($1, $2, 0, 100000, 0, '')";
            assert!(transaction.execute(sql, &[&building, &robot]).await.is_err());
        }
    }
    keys::revoke(&client, "robot 1.1").await.expect("there is one");
    let line = Line::new(&centre.url(), &keys_made[0], None).expect("loopback");
    assert!(matches!(line.position(), Err(FleetError::Key)));
}

#[tokio::test(flavor = "multi_thread")]
async fn the_schema_has_every_table_and_column_divided_or_not() {
    let Some(postgres) = Postgres::start(QUICK) else { return };
    let first = db::connect(&postgres.address()).await.expect("connects");
    first.batch_execute("CREATE DATABASE undivided").await.expect("is made");
    for (address, undivided) in [(postgres.address(), false), (postgres.named("undivided"), true)] {
        let mut client = db::connect(&address).await.expect("connects");
        let ran = migrate::migrate(&mut client, undivided).await.expect("migrates");
        assert!(!ran.is_empty());
        let again = migrate::migrate(&mut client, undivided).await.expect("migrates");
        assert!(again.is_empty(), "each file runs once");
        for table in Table::ALL.iter().copied() {
            let (schema, name) = place(table)
                .split_once('.')
                .map(|(s, n)| (s.to_owned(), n.to_owned()))
                .expect("both");
            let rows = client
                .query(
                    "SELECT column_name::text, data_type::text FROM information_schema.columns \
                     WHERE table_schema = $1 AND table_name = $2 ORDER BY ordinal_position",
                    &[&schema, &name.trim_matches('"')],
                )
                .await
                .expect("reads");
            let there: Vec<(String, String)> = rows.iter().map(|r| (r.get(0), r.get(1))).collect();
            let own: Vec<(String, String)> =
                table.columns().iter().map(|c| (c.name.to_owned(), kind(c).to_owned())).collect();
            assert_eq!(
                there[..2].iter().map(|c| c.0.as_str()).collect::<Vec<_>>(),
                ["building", "robot"]
            );
            let mut cells: Vec<_> = there[2..].iter().take(own.len()).cloned().collect();
            let mut wanted = own;
            if !table.is_stored() {
                cells.sort();
                wanted.sort();
            }
            assert_eq!(cells, wanted, "{}", table.name());
        }
        let secured = client
            .query("SELECT c.oid::regclass::text FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace \
                    WHERE n.nspname IN ('fleet', 'map', 'log') AND c.relkind IN ('r', 'p') AND NOT c.relispartition \
                    AND NOT c.relrowsecurity", &[])
            .await
            .expect("reads");
        let open: Vec<String> = secured.iter().map(|r| r.get(0)).collect();
        assert_eq!(
            open,
            ["fleet.key"],
            "all but the keys, which nobody may read, are guarded by rows"
        );
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn beyond_this_machine_there_is_no_line_without_tls() {
    let Some(postgres) = Postgres::start(QUICK) else { return };
    let key = furnish(&postgres.address(), &[(1, 1)]).await.remove(0);
    let pool = db::pool(&postgres.address(), 2).expect("an address");
    let open = "0.0.0.0:0".parse().expect("an address");
    let refused = orthoframe_fleet::serve::serve(pool.clone(), open, None, &[], |_| ()).await;
    assert!(matches!(refused, Err(FleetError::Plain { .. })));
    for url in ["http://fleet.example:7433", "http://192.168.1.5", "http://127.0.0.1.evil.example"]
    {
        assert!(matches!(Line::new(url, &key, None), Err(FleetError::Plain { .. })), "{url}");
    }
    let dir = scratch();
    let made = rcgen::generate_simple_self_signed(["localhost".to_owned()]).expect("a certificate");
    let (certificate, secret) = (dir.path().join("cert.pem"), dir.path().join("key.pem"));
    std::fs::write(&certificate, made.cert.pem()).expect("writes");
    std::fs::write(&secret, made.signing_key.serialize_pem()).expect("writes");
    let tls = orthoframe_fleet::serve::Tls { certificate: certificate.clone(), key: secret };
    let (told, heard) = std::sync::mpsc::channel();
    tokio::spawn(async move {
        let ready = move |address| told.send(address).expect("it is waited for");
        orthoframe_fleet::serve::serve(pool, open, Some(tls), &[], ready).await
    });
    let port = heard.recv_timeout(Duration::from_secs(30)).expect("it serves").port();
    let url = format!("https://localhost:{port}");
    let (store, home) = (dir.path().join("store"), home());
    live(&store, 5, 1, &home, false);
    let pushed = tokio::task::spawn_blocking(move || {
        let trusting = Line::new(&url, &key, Some(&certificate)).expect("a line");
        let pushed = trusting.push(&store).expect("it is taken");
        let strange = Line::new(&url, &key, None).expect("a line");
        assert!(
            matches!(strange.position(), Err(FleetError::Line { .. })),
            "not signed by any known"
        );
        let sent = whole(&store).expect("reads");
        (pushed, sent.sequence)
    });
    let (pushed, last) = pushed.await.expect("no panic");
    assert_eq!(pushed.sequence as u64, last);
}

#[tokio::test(flavor = "multi_thread")]
async fn the_database_beyond_this_machine_is_spoken_to_with_tls_alone() {
    let name = "db.fleet.example";
    let made = rcgen::generate_simple_self_signed([name.to_owned()]).expect("a certificate");
    let other = rcgen::generate_simple_self_signed([name.to_owned()]).expect("a certificate");
    let (pem, secret) = (made.cert.pem(), made.signing_key.serialize_pem());
    let Some((mut postgres, port)) = Postgres::start_with_tls(&pem, &secret) else { return };
    let dir = scratch();
    let (authority, stranger) = (dir.path().join("ca.pem"), dir.path().join("other.pem"));
    std::fs::write(&authority, &pem).expect("writes");
    std::fs::write(&stranger, other.cert.pem()).expect("writes");
    // A name that is not this machine's, though the server happens to be here.
    let far = format!("host={name} hostaddr=127.0.0.1 port={port} user=owner dbname=postgres");
    let encrypted = "SELECT ssl FROM pg_stat_ssl WHERE pid = pg_backend_pid()";
    let server = db::Server::new(&far, Some(&authority)).expect("an address");
    let client = server.connect().await.expect("it speaks TLS");
    assert!(client.query_one(encrypted, &[]).await.expect("reads").get::<_, bool>(0));
    let pooled = server.pool(1).expect("a pool").get().await.expect("connects");
    assert!(pooled.query_one(encrypted, &[]).await.expect("reads").get::<_, bool>(0));
    let near = format!("host=localhost port={port} user=owner dbname=postgres");
    let client = db::connect(&near).await.expect("connects");
    assert!(!client.query_one(encrypted, &[]).await.expect("reads").get::<_, bool>(0));
    // The whole program, with the authority as it is told on the command line.
    let ran = std::process::Command::new(env!("CARGO_BIN_EXE_ortho-fleet"))
        .args(["migrate", "--db", &far, "--db-authority"])
        .arg(&authority)
        .output()
        .expect("it runs");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    // Another's certificate, nobody's, another name: not believed.
    for (address, by) in [
        (far.clone(), Some(stranger.as_path())),
        (far.clone(), None),
        (far.replace(name, "db.other.example"), Some(&authority)),
    ] {
        let refused = db::Server::new(&address, by).expect("an address").connect().await;
        let Err(FleetError::Database { what }) = refused else { panic!("{address}") };
        assert!(what.to_string().contains("certificate"), "{what}");
    }
    let plain = db::Server::new(&format!("{far} sslmode=disable"), Some(&authority));
    assert!(matches!(plain, Err(FleetError::PlainDatabase { host }) if host == name));
    // A server that speaks none, or a thief in its place, hears nothing of us.
    postgres.restart_plain();
    let Err(FleetError::Database { what }) = server.connect().await else { panic!("it is plain") };
    assert!(what.to_string().contains("TLS"), "{what}");
}
