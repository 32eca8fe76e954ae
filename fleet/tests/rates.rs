//! Rates beside COPY of the same bytes, and questions over millions of facts. Run by hand, in release:
//! `cargo test --release -p orthoframe-fleet --test rates -- --ignored --nocapture --test-threads 1`.

#![expect(clippy::print_stdout, reason = "the figures are what it is for")]

mod common;

use std::io::Cursor;
use std::time::{Duration, Instant};

use common::robot::{home, live};
use common::{Postgres, furnish, number};
use futures_util::SinkExt;
use orthoframe_fleet::query::Question;
use orthoframe_fleet::rows::place;
use orthoframe_fleet::{db, derive, ingest, keys};
use orthoframe_semantics::RelationRules;
use orthoframe_store::Table;
use orthoframe_store::shipping::{Following, frames_after};

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes"]
async fn frames_beside_copy() {
    let Some(postgres) = Postgres::start("-c shared_buffers=512MB -c max_wal_size=8GB") else {
        return;
    };
    let (transactions, rounds) = (number("FLEET_FRAMES", 4000), number("FLEET_ROUNDS", 5));
    let dir = tempfile::tempdir_in("/dev/shm").expect("a folder");
    let store = dir.path().join("store");
    live(&store, transactions as u64, 1, &home(), false);
    let mut frames = Vec::new();
    while let Following::Frames(more) = frames_after(
        &store,
        frames.len() as u64,
        frames.last().map(|f: &orthoframe_store::shipping::Frame| f.checksum),
        8 << 20,
    )
    .expect("reads")
        && !more.is_empty()
    {
        frames.extend(more);
    }
    let bytes: usize = frames.iter().map(|f| f.bytes.len()).sum();
    let all: Vec<(i64, i64)> = (1..=rounds as i64).map(|n| (n, 1)).collect();
    let made = furnish(&postgres.address(), &all).await;
    let pool = db::pool(&postgres.address(), 2).expect("an address");
    let mut client = pool.get().await.expect("connects");
    client.batch_execute("CREATE SCHEMA bare").await.expect("is made");
    let tables: Vec<String> = Table::ALL
        .iter()
        .filter(|t| t.is_stored())
        .map(|t| place(*t))
        .chain(["frame", "mission", "work", "proposed"].map(|name| format!("fleet.{name}")))
        .collect();
    let [mut applied, mut copied, mut streamed, mut plain] = [const { Vec::new() }; 4];
    for (n, key) in made.iter().enumerate() {
        let building = n as i64 + 1;
        let begin = Instant::now();
        let mut batch = Vec::new();
        let mut size = 0;
        for frame in frames.iter().cloned() {
            size += frame.bytes.len();
            batch.push(frame);
            if size > 4 << 20 {
                ingest::take_frames(&mut client, key, std::mem::take(&mut batch))
                    .await
                    .expect("taken");
                size = 0;
            }
        }
        ingest::take_frames(&mut client, key, batch).await.expect("taken");
        applied.push(begin.elapsed());
        // The rows that this made, by COPY into the same tables.
        let folder = "/tmp";
        let mut rows = 0;
        for (at, table) in tables.iter().enumerate() {
            let sql = format!(
                "COPY (SELECT * FROM {table} WHERE building = {building}) TO '{folder}/fleet_rates_{at}' (FORMAT binary)"
            );
            rows += client.execute(&sql, &[]).await.expect("copies");
            client
                .execute(&format!("DELETE FROM {table} WHERE building = {building}"), &[])
                .await
                .expect("deletes");
        }
        client.batch_execute("VACUUM").await.expect("vacuums");
        let begin = Instant::now();
        let transaction = client.transaction().await.expect("begins");
        for (at, table) in tables.iter().enumerate() {
            let sql = format!("COPY {table} FROM '{folder}/fleet_rates_{at}' (FORMAT binary)");
            transaction.execute(&sql, &[]).await.expect("copies");
        }
        transaction.commit().await.expect("commits");
        copied.push(begin.elapsed());
        for table in &tables {
            let sql = format!("DELETE FROM {table} WHERE building = {building}");
            client.execute(&sql, &[]).await.expect("deletes");
        }
        client.batch_execute("VACUUM").await.expect("vacuums");
        // As a client brings them, by the line on which the frames came.
        let read = |at| std::fs::read(format!("{folder}/fleet_rates_{at}")).expect("reads");
        let files: Vec<Vec<u8>> = (0..tables.len()).map(read).collect();
        let begin = Instant::now();
        let transaction = client.transaction().await.expect("begins");
        for (table, file) in tables.iter().zip(files) {
            let sql = format!("COPY {table} FROM STDIN (FORMAT binary)");
            let mut sink = std::pin::pin!(transaction.copy_in(&sql).await.expect("copies"));
            for piece in file.chunks(64 << 10) {
                sink.feed(Cursor::new(piece.to_vec())).await.expect("is sent");
            }
            sink.close().await.expect("copies");
        }
        transaction.commit().await.expect("commits");
        streamed.push(begin.elapsed());
        // The frames alone, into a table with a key and nothing else.
        client
            .batch_execute(&format!(
                "DROP TABLE IF EXISTS bare.frame; CREATE TABLE bare.frame (LIKE fleet.frame, PRIMARY KEY (building, robot, epoch, sequence)); \
                 COPY (SELECT * FROM fleet.frame WHERE building = {building}) TO '{folder}/fleet_rates_bare' (FORMAT binary)"
            ))
            .await
            .expect("is made");
        let begin = Instant::now();
        client
            .execute(
                &format!("COPY bare.frame FROM '{folder}/fleet_rates_bare' (FORMAT binary)"),
                &[],
            )
            .await
            .expect("copies");
        plain.push(begin.elapsed());
        println!(
            "round {n}: applied {:?}, rows by COPY {:?} ({rows} rows), by COPY of a client {:?}, frames alone by COPY {:?}",
            applied[n], copied[n], streamed[n], plain[n]
        );
    }
    let ratios = |of: &[Duration]| {
        let mut all: Vec<f64> =
            of.iter().zip(&applied).map(|(o, a)| o.as_secs_f64() / a.as_secs_f64()).collect();
        all.sort_by(f64::total_cmp);
        format!("{:.2} (pair by pair {:.2?})", all[all.len() / 2], all)
    };
    println!("beside COPY of a file {}; of a client {}", ratios(&copied), ratios(&streamed));
    let [a, c, s, p] = [applied, copied, streamed, plain].map(median);
    println!(
        "{} frames, {bytes} bytes: applied {a:?} = {:.0} frames/s, {:.1} MB/s; the same rows by COPY {c:?}, {:.2} of its rate; by COPY of a client {s:?}, {:.2}; frames alone {p:?}, {:.2}",
        frames.len(),
        frames.len() as f64 / a.as_secs_f64(),
        bytes as f64 / 1e6 / a.as_secs_f64(),
        c.as_secs_f64() / a.as_secs_f64(),
        s.as_secs_f64() / a.as_secs_f64(),
        p.as_secs_f64() / a.as_secs_f64(),
    );
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes"]
async fn questions_over_millions_of_facts() {
    let Some(postgres) =
        Postgres::start("-c shared_buffers=2GB -c max_wal_size=16GB -c fsync=off -c jit=off")
    else {
        return;
    };
    let buildings = number("FLEET_BUILDINGS", 2000);
    let each = number("FLEET_FACTS", 5000);
    furnish(&postgres.address(), &[]).await;
    let client = db::connect(&postgres.address()).await.expect("connects");
    let of_all = keys::add_operator(&client, None, "op").await.expect("new");
    let of_one = keys::add_operator(&client, Some(7), "op 7").await.expect("new");
    let begin = Instant::now();
    client
        .batch_execute(&format!(
            "INSERT INTO fleet.building SELECT b, 'Корпус-' || b FROM generate_series(1, {buildings}) b;
             INSERT INTO fleet.robot (building, robot, name) SELECT b, 1, 'r' || b FROM generate_series(1, {buildings}) b;
             INSERT INTO fleet.fact
             SELECT b, 1, r.relation, 'Вещь-' || (n * 7 + b * 13) % 40000, r.prefix || (n * 11 + b * 17) % r.size, 1 + n % 3,
                    CASE WHEN n % 10 = 0 THEN 5 END, timestamptz '2026-01-01', CASE WHEN n % 10 = 0 THEN timestamptz '2026-02-01' END
             FROM generate_series(1, {buildings}) b, generate_series(1, {each} / 5) n,
                  (VALUES ('ON_TOP_OF', 'Стол-', 20000), ('CLOSE_TO', 'Вещь-', 40000), ('NEXT_TO', 'Вещь-', 40000),
                          ('INSIDE', 'Комната-', 200), ('IS_A', 'Вид-', 50)) AS r (relation, prefix, size)
             ON CONFLICT DO NOTHING"
        ))
        .await
        .expect("fills");
    client.batch_execute("VACUUM ANALYZE fleet.fact").await.expect("vacuums");
    let facts: i64 =
        client.query_one("SELECT count(*) FROM fleet.fact", &[]).await.expect("reads").get(0);
    let size: String = client
        .query_one("SELECT pg_size_pretty(sum(pg_total_relation_size(inhrelid))) FROM pg_inherits WHERE inhparent = 'fleet.fact'::regclass", &[])
        .await
        .expect("reads")
        .get(0);
    println!("{facts} facts of {buildings} buildings, {size}, filled in {:?}", begin.elapsed());
    let pool = db::pool(&postgres.address(), 1).expect("an address");
    let mut pooled = pool.get().await.expect("connects");
    let hundred: Vec<String> = (1..=100).map(|n| n.to_string()).collect();
    for (name, key, text) in [
        ("what stands on X anywhere", &of_all, "?- ON_TOP_OF(X, \"Стол-777\")"),
        ("what stands on X, of one building", &of_one, "?- ON_TOP_OF(X, \"Стол-777\")"),
        (
            "things of a kind on one table, and what they are close to",
            &of_all,
            "?- ON_TOP_OF(X, \"Стол-778\"), CLOSE_TO(X, Y), IS_A(X, K)",
        ),
        (
            "free things of a kind in a room",
            &of_all,
            "?- INSIDE(X, \"Комната-5\"), IS_A(X, \"Вид-7\"), !ON_TOP_OF(_, X)",
        ),
    ] {
        let question = Question::parse(text).expect("reads");
        let mut times = Vec::new();
        let mut rows = 0;
        for _ in 0..11 {
            let transaction = pooled.transaction().await.expect("begins");
            db::enter(&transaction, key).await.expect("a key");
            let begin = Instant::now();
            rows = question.run(&transaction).await.expect("runs").rows.len();
            times.push(begin.elapsed());
        }
        println!("{name}: median {:?}, {rows} rows", median(times));
    }
    // A join of all things of a hundred buildings.
    let sql = format!(
        "SELECT count(*) FROM fleet.fact a JOIN fleet.fact b ON b.building = a.building AND b.robot = a.robot \
           AND b.relation = 'IS_A' AND b.subject = a.subject AND b.revision_to IS NULL \
         WHERE a.relation = 'ON_TOP_OF' AND a.revision_to IS NULL AND a.building IN ({}) AND b.building IN ({0})",
        hundred.join(", ")
    );
    let mut times = Vec::new();
    let mut rows: i64 = 0;
    for _ in 0..11 {
        let transaction = pooled.transaction().await.expect("begins");
        db::enter(&transaction, &of_all).await.expect("a key");
        let begin = Instant::now();
        rows = transaction.query_one(&sql, &[]).await.expect("runs").get(0);
        times.push(begin.elapsed());
    }
    println!("join over 100 buildings: median {:?}, {rows} rows", median(times));
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes"]
async fn buildings_derived() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    let most = number("FLEET_BUILDINGS", 2000);
    let all: Vec<(i64, i64)> = (1..=most as i64).map(|n| (n, 1)).collect();
    let made = furnish(&postgres.address(), &all).await;
    let pool = db::pool(&postgres.address(), 4).expect("an address");
    let mut client = pool.get().await.expect("connects");
    let dir = tempfile::tempdir_in("/dev/shm").expect("a folder");
    let store = dir.path().join("store");
    live(&store, 0, 1, &home(), false);
    let Following::Frames(frames) = frames_after(&store, 0, None, 1 << 30).expect("reads") else {
        panic!("frames")
    };
    for key in &made {
        ingest::take_frames(&mut client, key, frames.clone()).await.expect("taken");
    }
    for part in [most / 4, most / 2, most] {
        let sql = "INSERT INTO fleet.work (building, robot, revision, anew) SELECT b, 1, 1, true FROM generate_series(1, $1::bigint) b ON CONFLICT DO NOTHING";
        client.execute("DELETE FROM fleet.work", &[]).await.expect("clears");
        client.execute(sql, &[&(part as i64)]).await.expect("asks");
        let begin = Instant::now();
        let mut workers = Vec::new();
        for _ in 0..2 {
            let pool = pool.clone();
            workers.push(tokio::spawn(async move {
                let rules = RelationRules::standard();
                let mut client = pool.get().await.expect("connects");
                while derive::work_once(&mut client, &rules).await.expect("works") {}
            }));
        }
        for worker in workers {
            worker.await.expect("no panic");
        }
        println!("{part} buildings derived anew by 2 workers: {:?}", begin.elapsed());
    }
}

/// What a robot's store takes for a transaction, alone and while all that it writes is sent at once. Under `taskset -c 1` the
/// line and the centre have that core, the store the other: as if the centre were another machine.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes"]
async fn a_store_beside_its_line() {
    let Some(postgres) = Postgres::start("") else { return };
    let made = furnish(&postgres.address(), &[(1, 1)]).await;
    let centre = common::Centre::start(&postgres.address());
    let dir = tempfile::tempdir().expect("a folder");
    let store = dir.path().join("store");
    if std::thread::available_parallelism().is_ok_and(|n| n.get() == 1) {
        let thread = std::fs::read_link("/proc/thread-self").expect("a system with threads");
        let id = thread.file_name().expect("its number");
        let moved = std::process::Command::new("taskset").args(["-cp", "0"]).arg(id).status();
        assert!(moved.expect("taskset runs").success());
    }
    live(&store, 200, 1, &home(), false);
    let mut each = [Vec::new(), Vec::new()];
    for round in 0..10 {
        for (is_pushed, times) in each.iter_mut().enumerate() {
            let pushing = (is_pushed == 1).then(|| {
                std::process::Command::new(env!("CARGO_BIN_EXE_ortho-fleet"))
                    .args([
                        "push",
                        "--every",
                        "1",
                        "--to",
                        &centre.url(),
                        "--key",
                        &made[0],
                        "--store",
                    ])
                    .arg(&store)
                    .stdout(std::process::Stdio::null())
                    .spawn()
                    .expect("it starts")
            });
            std::thread::sleep(Duration::from_millis(300));
            let begin = Instant::now();
            live(&store, 300, round * 2 + is_pushed as u64, &home(), false);
            times.push(begin.elapsed() / 300);
            if let Some(mut pushing) = pushing {
                let _ = pushing.kill();
                let _ = pushing.wait();
            }
        }
    }
    let [alone, pushed] = each.map(median);
    println!("a transaction of a robot's store: {alone:?} alone, {pushed:?} while it is pushed");
}

/// What robots that are on line do all day: a few frames a request, of many robots at once.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes"]
async fn small_requests_of_many_robots() {
    let Some(postgres) = Postgres::start("-c shared_buffers=512MB -c max_wal_size=8GB") else {
        return;
    };
    let (robots, each, threads) = (number("FLEET_ROBOTS", 200), 3, 8);
    let all: Vec<(i64, i64)> = (0..robots as i64).map(|n| (1 + n / 5, 1 + n)).collect();
    let made = furnish(&postgres.address(), &all).await;
    let centre = common::Centre::start(&postgres.address());
    let dir = tempfile::tempdir_in("/dev/shm").expect("a folder");
    let store = dir.path().join("store");
    live(&store, 90, 1, &home(), false);
    // All of them live the same life: to the centre they are many all the same.
    let Following::Frames(frames) = frames_after(&store, 0, None, 1 << 30).expect("reads") else {
        panic!("frames")
    };
    let (first, rest) = frames.split_at(1);
    let url = centre.url();
    let work = |n: usize, frames: &[orthoframe_store::shipping::Frame], size: usize| {
        let mut times = Vec::new();
        let mine: Vec<_> = made.iter().skip(n).step_by(threads).collect();
        let lines: Vec<_> = mine
            .iter()
            .map(|key| orthoframe_fleet::push::Line::new(&url, key, None).expect("loopback"))
            .collect();
        for part in frames.chunks(size) {
            for line in &lines {
                let begin = Instant::now();
                line.send(part).expect("taken");
                times.push(begin.elapsed());
            }
        }
        times
    };
    let all_work = |frames: &[orthoframe_store::shipping::Frame], size: usize| {
        std::thread::scope(|scope| {
            let running: Vec<_> =
                (0..threads).map(|n| scope.spawn(move || work(n, frames, size))).collect();
            running.into_iter().flat_map(|w| w.join().expect("no panic")).collect::<Vec<_>>()
        })
    };
    all_work(first, 1);
    let begin = Instant::now();
    let times = all_work(rest, each);
    let (took, requests) = (begin.elapsed().as_secs_f64(), times.len() as f64);
    println!(
        "{robots} robots, {requests} requests of {each} frames, {threads} at once: {:.0} requests/s, {:.0} frames/s, median {:?}",
        requests / took,
        requests * each as f64 / took,
        median(times)
    );
}
