//! Many robots push to one centre on lines that are cut, in any order, while either side and the server are killed at any
//! moment: afterwards the centre holds what each robot's own store holds, record by record.
//!
//! Robots are processes of their own, this very program begun anew, which live in their stores and push; they are killed like
//! the rest. The long form, 1 000 robots of 1 000 frames and a hundred rounds of killing:
//! `cargo test --release -p orthoframe-fleet --test show -- --ignored --nocapture`; `FLEET_ROBOTS`, `FLEET_FRAMES`,
//! `FLEET_ROUNDS` make it another.

#![expect(clippy::print_stdout, reason = "the figures are what it is for")]

mod common;

use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use common::badly::push_badly;
use common::robot::{home, live_until, must_be_same};
use common::{BadLine, Centre, Postgres, furnish, number, scratch};
use orthoframe_fleet::push::Line;
use orthoframe_fleet::{FleetError, db};

/// Robots of a process, one after the other.
const PARTS: u64 = 4;

struct Show {
    robots: usize,
    frames: u64,
    rounds: usize,
    processes: usize,
}

/// What one round killed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Robot,
    Centre,
    Server,
}

/// A process of robots, and how much of its work it has told of.
struct Robots {
    child: Child,
    from: usize,
    to: usize,
}

/// What all robots' processes share.
struct Stage {
    dir: PathBuf,
    url: String,
    frames: u64,
    done: Arc<AtomicU64>,
}

impl Stage {
    fn begin(&self, from: usize, to: usize) -> Robots {
        let mut child = Command::new(std::env::current_exe().expect("this program"))
            .args(["robots_of_the_show", "--exact", "--nocapture", "--test-threads", "1"])
            .env("FLEET_SHOW", &self.dir)
            .env("FLEET_SHOW_URL", &self.url)
            .env("FLEET_SHOW_FRAMES", self.frames.to_string())
            .env("FLEET_SHOW_ROBOTS", format!("{from} {to}"))
            .stdout(Stdio::piped())
            .spawn()
            .expect("it starts");
        let told = BufReader::new(child.stdout.take().expect("piped"));
        let done = Arc::clone(&self.done);
        std::thread::spawn(move || {
            for line in told.lines().map_while(Result::ok).filter(|line| line.contains("part done"))
            {
                done.fetch_add(line.matches("part done").count() as u64, Ordering::Relaxed);
            }
        });
        Robots { child, from, to }
    }
}

async fn show(Show { robots, frames, rounds, processes }: Show) {
    let quick = "-c fsync=off -c full_page_writes=off -c shared_buffers=256MB -c max_wal_size=4GB";
    let Some(postgres) = Postgres::start(quick) else { return };
    // Some buildings have two robots.
    let all: Vec<(i64, i64)> = (0..robots as i64).map(|n| (1 + n * 2 / 3, 1 + n)).collect();
    let keys = furnish(&postgres.address(), &all).await;
    let mut centre = Centre::start(&postgres.address());
    let bad = BadLine::to(centre.address, 60_000, 33);
    let dir = scratch();
    std::fs::write(dir.path().join("keys"), keys.join("\n")).expect("writes");
    let stage = Stage {
        dir: dir.path().to_owned(),
        url: format!("http://{}", bad.address),
        frames,
        done: Arc::default(),
    };
    let begin = Instant::now();
    let mut working: Vec<Robots> = (0..processes)
        .map(|n| stage.begin(robots * n / processes, robots * (n + 1) / processes))
        .collect();
    let mut rng = fastrand::Rng::with_seed(100);
    let parts = robots as u64 * PARTS;
    let mut killed = Vec::new();
    for round in 0..rounds as u64 {
        // Rounds are spread over the work, and strike it anywhere.
        let wanted = parts * round / rounds as u64;
        while stage.done.load(Ordering::Relaxed) < wanted {
            must_go_on(&mut working, &stage);
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_millis(rng.u64(0..120)));
        let mut sides = [Side::Robot, Side::Centre, Side::Server];
        rng.shuffle(&mut sides);
        // Each is struck in turn at least once; now and then two at once.
        let mut strikes = vec![[Side::Robot, Side::Centre, Side::Server][round as usize % 3]];
        strikes.extend((rng.u32(..4) == 0).then_some(sides[0]));
        for side in strikes {
            killed.push(side);
            match side {
                Side::Robot => {
                    let robots = &mut working[rng.usize(..processes)];
                    let _ = robots.child.kill();
                    let _ = robots.child.wait();
                    *robots = stage.begin(robots.from, robots.to);
                }
                Side::Centre => centre.kill_and_start(),
                Side::Server => postgres.kill_and_start(),
            }
        }
    }
    for robots in &mut working {
        while !robots.child.wait().expect("it ran").success() {
            *robots = stage.begin(robots.from, robots.to);
        }
    }
    let (sent, comparing) = (begin.elapsed(), Instant::now());
    let pool = db::pool(&postgres.address(), 4).expect("an address");
    let next = Arc::new(std::sync::atomic::AtomicUsize::new(0));
    let compare = (0..4).map(|_| {
        let (pool, all, next) = (pool.clone(), all.clone(), Arc::clone(&next));
        let dir = dir.path().to_owned();
        tokio::spawn(async move {
            while let n = next.fetch_add(1, Ordering::Relaxed)
                && let Some((building, robot)) = all.get(n)
            {
                must_be_same(&pool, *building, *robot, &store(&dir, n), false).await;
            }
        })
    });
    for compared in compare.collect::<Vec<_>>() {
        compared.await.expect("they are the same");
    }
    let client = pool.get().await.expect("connects");
    let sql = "SELECT count(*), sum(sequence)::bigint FROM fleet.robot WHERE robot > 0";
    let row = client.query_one(sql, &[]).await.expect("reads");
    let (count, total): (i64, i64) = (row.get(0), row.get(1));
    assert!(count == robots as i64 && total >= robots as i64 * frames as i64, "{count} {total}");
    let of = |side| killed.iter().filter(|s| **s == side).count();
    println!(
        "{robots} robots, {total} frames, {rounds} rounds: kill -9 of robots {}, centre {}, server {}; {} lines cut; \
         all sent after {:.0} s, compared record by record in {:.0} s",
        of(Side::Robot),
        of(Side::Centre),
        of(Side::Server),
        bad.cuts.load(Ordering::Relaxed),
        sent.as_secs_f64(),
        comparing.elapsed().as_secs_f64()
    );
}

/// A process that ended badly by itself is a failure; what was killed is begun anew where it was killed.
fn must_go_on(working: &mut [Robots], stage: &Stage) {
    for robots in working {
        if let Some(status) = robots.child.try_wait().expect("it ran") {
            assert!(status.success(), "robots {}..{} failed", robots.from, robots.to);
            // Its work is done: the rounds that are left find the others.
            *robots = stage.begin(robots.from, robots.to);
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

fn store(dir: &Path, n: usize) -> PathBuf {
    dir.join(n.to_string())
}

/// What a process of robots does; nothing where it is not one.
#[test]
fn robots_of_the_show() {
    let Some(dir) = std::env::var_os("FLEET_SHOW").map(PathBuf::from) else { return };
    let told = |name: &str| std::env::var(name).expect("it is told");
    let frames: u64 = told("FLEET_SHOW_FRAMES").parse().expect("a number");
    let (url, range) = (told("FLEET_SHOW_URL"), told("FLEET_SHOW_ROBOTS"));
    let _: SocketAddr = url.trim_start_matches("http://").parse().expect("an address");
    let (from, to) = range.split_once(' ').expect("two numbers");
    let keys = std::fs::read_to_string(dir.join("keys")).expect("reads");
    let keys: Vec<&str> = keys.lines().collect();
    let home = home();
    let number = |text: &str| text.parse::<usize>().expect("a number");
    let mine = keys.iter().enumerate().take(number(to)).skip(number(from));
    for (n, key) in mine {
        let store = store(&dir, n);
        let line = Line::new(&url, key, None).expect("loopback");
        let mut rng = fastrand::Rng::new();
        let mut acknowledged = 0;
        for part in 1..=PARTS {
            let mark = dir.join(format!("{n}.{part}"));
            if mark.exists() {
                continue;
            }
            live_until(&store, frames * part / PARTS, rng.u64(..), &home);
            let begin = Instant::now();
            loop {
                match push_badly(&line, &store, &mut rng) {
                    Ok(at) => {
                        assert!(at >= acknowledged, "what was acknowledged is there");
                        acknowledged = at;
                        break;
                    }
                    Err(FleetError::Line { .. } | FleetError::Gap { .. }) => {}
                    Err(error) => panic!("{error}"),
                }
                assert!(begin.elapsed() < Duration::from_secs(600), "no way through");
                std::thread::sleep(Duration::from_millis(rng.u64(1..30)));
            }
            println!("part done");
            std::fs::write(mark, "").expect("writes");
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn whoever_is_killed_the_tables_are_what_robots_hold() {
    show(Show { robots: 9, frames: 160, rounds: 6, processes: 3 }).await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes half an hour"]
async fn the_long_form() {
    let robots = number("FLEET_ROBOTS", 1000);
    let frames = number("FLEET_FRAMES", 1000) as u64;
    let rounds = number("FLEET_ROUNDS", 100);
    show(Show { robots, frames, rounds, processes: 4 }).await;
}
