//! A server of one's own, robots that live at random, and the comparison of what both hold.

#![allow(dead_code, reason = "each test uses a part")]
#![allow(unreachable_pub, reason = "shared by several tests")]
#![allow(clippy::print_stderr, reason = "what a test tells")]

pub mod badly;
pub mod robot;

use std::io::{Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use orthoframe_fleet::{db, keys, migrate};
use tempfile::TempDir;

pub fn number(name: &str, usual: usize) -> usize {
    std::env::var(name).ok().map_or(usual, |text| text.parse().expect("a number"))
}

/// Stores in memory where the system has such a folder: a store waits for the disk at each transaction.
pub fn scratch() -> TempDir {
    let shm = Path::new("/dev/shm");
    let place = if shm.is_dir() { shm.to_owned() } else { std::env::temp_dir() };
    tempfile::Builder::new().prefix("fleet").tempdir_in(place).expect("a folder")
}

/// A PostgreSQL in a folder of its own, listening to a socket there.
pub struct Postgres {
    dir: TempDir,
    bin: PathBuf,
    options: String,
}

/// Where the server's programs are; the newest. None where it is not installed: with `CI` set that is a failure.
pub fn programs() -> Option<PathBuf> {
    let versions = std::fs::read_dir("/usr/lib/postgresql").ok()?.flatten();
    let mut found: Vec<_> =
        versions.map(|v| v.path().join("bin")).filter(|b| b.join("initdb").exists()).collect();
    found.sort();
    let bin = found.pop();
    assert!(bin.is_some() || std::env::var_os("CI").is_none(), "PostgreSQL is not installed");
    bin
}

fn is_root() -> bool {
    let id = Command::new("id").arg("-u").output().expect("id runs");
    id.stdout == b"0\n"
}

impl Postgres {
    /// None where there is no server to be had.
    pub fn start(options: &str) -> Option<Self> {
        let server = Self::made(options)?;
        server.up();
        Some(server)
    }

    /// One that listens to a port of this machine too, and speaks TLS there with this certificate and key (PEM).
    pub fn start_with_tls(certificate: &str, key: &str) -> Option<(Self, u16)> {
        let port = TcpListener::bind("127.0.0.1:0").expect("a port").local_addr().expect("bound");
        let mut server = Self::made("")?;
        for (name, text) in [("server.crt", certificate), ("server.key", key)] {
            let path = server.dir.path().join("data").join(name);
            std::fs::write(&path, text).expect("writes");
            if is_root() {
                let owned = Command::new("chown").arg("postgres").arg(&path).status();
                assert!(owned.expect("chown runs").success());
            }
            let secret = Command::new("chmod").arg("600").arg(&path).status();
            assert!(secret.expect("chmod runs").success());
        }
        server.options =
            format!("-c fsync=off -c ssl=on -c listen_addresses=127.0.0.1 -c port={}", port.port());
        server.up();
        Some((server, port.port()))
    }

    fn made(options: &str) -> Option<Self> {
        let Some(bin) = programs() else {
            eprintln!("PostgreSQL is not installed: nothing was tested");
            return None;
        };
        let dir = tempfile::Builder::new().prefix("pg").tempdir().expect("a folder");
        if is_root() {
            let owned = Command::new("chown").arg("postgres").arg(dir.path()).status();
            assert!(owned.expect("chown runs").success());
        }
        let server = Self { dir, bin, options: options.to_owned() };
        let data = server.data();
        server.run(
            "initdb",
            &["-A", "trust", "-U", "owner", "-E", "UTF8", "--locale=C", "-D", &data],
        );
        Some(server)
    }

    fn data(&self) -> String {
        self.dir.path().join("data").display().to_string()
    }

    fn command(&self, program: &str) -> Command {
        let program = self.bin.join(program);
        let mut command = if is_root() {
            let mut command = Command::new("runuser");
            command.args(["-u", "postgres", "--"]).arg(program);
            command
        } else {
            Command::new(program)
        };
        command.current_dir(self.dir.path()).stdout(Stdio::null()).stderr(Stdio::null());
        command
    }

    fn run(&self, program: &str, arguments: &[&str]) {
        let status = self.command(program).args(arguments).status().expect("it runs");
        assert!(status.success(), "{program} {arguments:?}");
    }

    pub fn up(&self) {
        let socket = self.dir.path().display();
        let options = format!(
            "-c listen_addresses='' -c unix_socket_directories='{socket}' -c max_connections=60 \
             -c logging_collector=off {}",
            self.options
        );
        let log = self.dir.path().join("log").display().to_string();
        self.run(
            "pg_ctl",
            &["-D", &self.data(), "-l", &log, "-o", &options, "-w", "-t", "120", "start"],
        );
    }

    fn postmaster(&self) -> Option<String> {
        let file = std::fs::read_to_string(self.dir.path().join("data/postmaster.pid")).ok()?;
        file.lines().next().map(str::to_owned)
    }

    /// Kills the server, all at once, and starts it again.
    pub fn kill_and_start(&self) {
        let pid = self.postmaster().expect("it runs");
        let _ = Command::new("kill").args(["-9", &pid]).status();
        // Its children end by themselves; until they have, a new one does not start.
        for _ in 0..600 {
            std::thread::sleep(Duration::from_millis(50));
            if !Path::new(&format!("/proc/{pid}")).exists() && self.try_up() {
                return;
            }
        }
        panic!("the server does not come back");
    }

    fn try_up(&self) -> bool {
        let socket = self.dir.path().display();
        let options = format!(
            "-c listen_addresses='' -c unix_socket_directories='{socket}' -c max_connections=60 {}",
            self.options
        );
        let log = self.dir.path().join("log").display().to_string();
        let started = self
            .command("pg_ctl")
            .args(["-D", &self.data(), "-l", &log, "-o", &options, "-w", "-t", "120", "start"])
            .status();
        started.expect("it runs").success()
    }

    /// Starts without TLS from now on, at the same port.
    pub fn restart_plain(&mut self) {
        self.run("pg_ctl", &["-D", &self.data(), "-m", "fast", "-w", "stop"]);
        self.options = self.options.replace("ssl=on", "ssl=off");
        self.up();
    }

    pub fn address(&self) -> String {
        format!("host={} user=owner dbname=postgres", self.dir.path().display())
    }

    pub fn named(&self, database: &str) -> String {
        format!("host={} user=owner dbname={database}", self.dir.path().display())
    }
}

impl Drop for Postgres {
    fn drop(&mut self) {
        let data = self.data();
        let _ =
            self.command("pg_ctl").args(["-D", &data, "-m", "immediate", "-w", "stop"]).status();
        if is_root() {
            // What belongs to another user is removed by root all the same.
            let _ = std::fs::remove_dir_all(self.dir.path());
        }
    }
}

/// Buildings of some robots each, and the robots' keys.
pub async fn furnish(address: &str, robots: &[(i64, i64)]) -> Vec<String> {
    let mut client = db::connect(address).await.expect("connects");
    migrate::migrate(&mut client, false).await.expect("migrates");
    let mut keys_made = Vec::new();
    let mut known = std::collections::BTreeSet::new();
    for (building, robot) in robots {
        if known.insert(*building) {
            keys::add_building(&client, *building, &format!("Корпус-{building}"))
                .await
                .expect("new");
        }
        let name = format!("robot {building}.{robot}");
        keys_made.push(keys::add_robot(&client, *building, *robot, &name).await.expect("new"));
    }
    keys_made
}

/// `ortho-fleet serve` as a program of its own.
pub struct Centre {
    child: Child,
    pub address: SocketAddr,
    db: String,
}

impl Centre {
    pub fn start(db: &str) -> Self {
        Self::start_at(db, "127.0.0.1:0".parse().expect("an address"))
    }

    fn start_at(db: &str, listen: SocketAddr) -> Self {
        use std::io::BufRead;
        let begin = Instant::now();
        loop {
            let mut child = Command::new(env!("CARGO_BIN_EXE_ortho-fleet"))
                .args(["serve", "--db", db, "--listen", &listen.to_string()])
                .stdout(Stdio::piped())
                .spawn()
                .expect("the centre starts");
            let mut line = String::new();
            let out = child.stdout.take().expect("piped");
            let read = std::io::BufReader::new(out).read_line(&mut line);
            if let (Ok(_), Some(told)) = (read, line.trim().strip_prefix("http://")) {
                let address = told.parse().expect("an address");
                return Self { child, address, db: db.to_owned() };
            }
            let _ = child.wait();
            // The port of one that was just killed may be held a moment.
            assert!(begin.elapsed() < Duration::from_secs(60), "the centre does not start: {line}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    pub fn url(&self) -> String {
        format!("http://{}", self.address)
    }

    pub fn kill_and_start(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        *self = Self::start_at(&self.db.clone(), self.address);
    }
}

impl Drop for Centre {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A line that is cut after so many bytes, now and then.
pub struct BadLine {
    pub address: SocketAddr,
    pub cuts: Arc<AtomicU64>,
}

impl BadLine {
    /// Each connection lasts up to `most` bytes in one of two cases.
    pub fn to(centre: SocketAddr, most: usize, seed: u64) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let address = listener.local_addr().expect("bound");
        let cuts = Arc::new(AtomicU64::new(0));
        let counted = Arc::clone(&cuts);
        std::thread::spawn(move || {
            let mut rng = fastrand::Rng::with_seed(seed);
            for robot in listener.incoming().flatten() {
                let limit = rng.bool().then(|| rng.usize(1..most));
                let back = rng.bool();
                let counted = Arc::clone(&counted);
                std::thread::spawn(move || {
                    let Ok(centre) = TcpStream::connect(centre) else { return };
                    let (Ok(r), Ok(c)) = (robot.try_clone(), centre.try_clone()) else { return };
                    let there = limit.filter(|_| !back);
                    // What comes back is short: an acknowledgement that is lost.
                    let here = limit.filter(|_| back).map(|n| n % 120);
                    let cut = Arc::clone(&counted);
                    let going = std::thread::spawn(move || pass(&robot, &centre, there, &cut));
                    pass(&c, &r, here, &counted);
                    let _ = going.join();
                });
            }
        });
        Self { address, cuts }
    }
}

fn pass(mut from: &TcpStream, mut to: &TcpStream, limit: Option<usize>, cuts: &AtomicU64) {
    let mut left = limit.unwrap_or(usize::MAX);
    let mut bytes = [0; 4096];
    while let Ok(n @ 1..) = from.read(&mut bytes) {
        let n = n.min(left);
        if to.write_all(&bytes[..n]).is_err() {
            break;
        }
        left -= n;
        if left == 0 {
            cuts.fetch_add(1, Ordering::Relaxed);
            break;
        }
    }
    let _ = from.shutdown(Shutdown::Both);
    let _ = to.shutdown(Shutdown::Both);
}
