//! The fleet's page in a real browser, and who is kept out of it.

#![expect(clippy::print_stdout, reason = "a test that was not made should say so")]

mod common;

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::Command;

use common::robot::{home, live};
use common::{Centre, Postgres, furnish};
use orthoframe_fleet::pull::Pulled;
use orthoframe_fleet::push::Line;
use orthoframe_fleet::{FleetError, db, keys, revise};
use orthoframe_store::{Change, Changes, Store, Timestamp};
use orthoframe_units::Frame;

/// Moves the last thing of a store's map a little, as a robot of its own does.
fn moved(store: &Path) {
    let (mut store, _) = Store::open(store).expect("opens");
    let before = store.world().expect("reads").expect("a map");
    let mut after = before.clone();
    let thing = after.replicas.values_mut().next_back().expect("some");
    let at = thing.frame;
    thing.frame = Frame::new(at.x.get() + 1.0, at.y.get(), at.z.get(), at.angle);
    let change = Change::new("робот", Timestamp(1_850_000_000_000), "сам");
    store
        .commit_changes(&Changes::between(&before, &after).expect("no key twice"), &change)
        .expect("commits");
}

fn judged(arguments: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::new("python3");
    command.arg(root.join("tests/judges/fleet.py")).args(arguments);
    // `FLEET_PICTURES` is a folder for what the page looks like.
    command.args(std::env::var_os("FLEET_PICTURES"));
    let Ok(done) = command.env("PYTHONPATH", root.join("../target/judges")).output() else {
        assert!(std::env::var_os("CI").is_none(), "python3 is missing");
        return println!("skipped: there is no python3");
    };
    let told = [done.stdout, done.stderr].concat();
    let told = String::from_utf8_lossy(&told);
    match done.status.code() {
        Some(0) => println!("{told}"),
        Some(77) if std::env::var_os("CI").is_none() => println!("skipped: there is no browser"),
        _ => panic!("{told}"),
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn an_operator_sees_the_fleet_and_makes_a_revision_in_a_browser() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    let made = furnish(&postgres.address(), &[(1, 1), (1, 2), (2, 1)]).await;
    let centre = Centre::start(&postgres.address());
    let pool = db::pool(&postgres.address(), 1).expect("an address");
    let mut client = pool.get().await.expect("connects");
    // A name is text, whatever stands in it.
    let name = "UPDATE fleet.robot SET name = '<b>robot</b> 2.1' WHERE building = 2 AND robot = 1";
    client.execute(name, &[]).await.expect("is renamed");
    let editor = keys::add_editor(&client, None, "Диспетчер").await.expect("new");
    let looker = keys::add_operator(&client, None, "Гость").await.expect("new");
    let (dir, home) = (tempfile::tempdir().expect("a folder"), home());
    let stores: Vec<_> = (0..3).map(|n| dir.path().join(n.to_string())).collect();
    let line = |n: usize| Line::new(&centre.url(), &made[n], None).expect("loopback");
    for n in [0, 2] {
        live(&stores[n], 60, n as u64 + 1, &home, false);
        line(n).push(&stores[n]).expect("taken");
    }
    let by = Change::new("Диспетчер", Timestamp(1_860_000_000_000), "от робота 1");
    let transaction = client.transaction().await.expect("begins");
    revise::adopt(&transaction, 1, 1, &by).await.expect("adopts");
    transaction.commit().await.expect("commits");
    assert!(matches!(line(1).pull(&stores[1]), Ok(Pulled::Taken { centre: 1, .. })));
    // Both change it.
    moved(&stores[1]);
    line(1).push(&stores[1]).expect("taken");
    moved(&stores[0]);
    moved(&stores[0]);
    line(0).push(&stores[0]).expect("taken");
    let transaction = client.transaction().await.expect("begins");
    assert_eq!(revise::adopt(&transaction, 1, 1, &by).await.expect("adopts"), 2);
    transaction.commit().await.expect("commits");
    assert!(matches!(line(1).pull(&stores[1]), Ok(Pulled::Apart(_))));
    let worked = Command::new(env!("CARGO_BIN_EXE_ortho-fleet"))
        .args(["work", "--once", "--db", &postgres.address()])
        .status();
    assert!(worked.expect("it runs").success());

    let url = centre.url();
    let looks = tokio::task::spawn_blocking(move || judged(&[&url, &editor, &looker]));
    looks.await.expect("the page does what it should");

    let sql = "SELECT revision FROM fleet.robot WHERE building = 1 AND robot = 0";
    let revision: i64 = client.query_one(sql, &[]).await.expect("reads").get(0);
    if revision == 2 {
        // There was no browser.
        return;
    }
    // What was made in the browser goes to the robots, with the author's name; the conflict was settled for the centre.
    for n in [0, 1] {
        let pulled = line(n).pull(&stores[n]).expect("answers");
        assert!(matches!(pulled, Pulled::Taken { centre: 3, .. }), "{n}: {pulled:?}");
        let (store, _) = Store::open_read_only(&stores[n]).expect("opens");
        let last = store.revisions().expect("reads").pop().expect("some");
        assert_eq!(last.user, "Диспетчер");
        assert!(last.reason.contains("сдвинули на обходе"), "{}", last.reason);
    }
    let sql = "SELECT count(*) FROM fleet.conflict WHERE settled IS NULL";
    assert_eq!(client.query_one(sql, &[]).await.expect("reads").get::<_, i64>(0), 0);
}

/// What was counted a moment ago is given to a page that asks by itself, to nobody else, and to no key that sees other buildings.
#[tokio::test(flavor = "multi_thread")]
async fn an_open_page_is_told_what_was_counted_for_those_who_see_the_same() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    furnish(&postgres.address(), &[(1, 1), (2, 1)]).await;
    let centre = Centre::start(&postgres.address());
    let client = db::connect(&postgres.address()).await.expect("connects");
    let of_all = keys::add_operator(&client, None, "Диспетчер").await.expect("new");
    let of_one = keys::add_operator(&client, Some(2), "Сторож").await.expect("new");
    let robots = |key: &str, again: bool| {
        let line = Line::new(&centre.url(), key, None).expect("loopback");
        let told = line.get(&format!("/v1/fleet?find=&again={again}")).expect("answers");
        let told: serde_json::Value = serde_json::from_slice(&told).expect("JSON");
        (told["name"].clone(), told["robots"]["rows"].as_array().expect("rows").len())
    };
    let name = |text: &str| serde_json::Value::from(text);
    assert_eq!(robots(&of_all, true), (name("Диспетчер"), 2));
    keys::add_robot(&client, 2, 2, "новый").await.expect("new");
    assert_eq!(robots(&of_all, true).1, 2, "as it was a moment ago");
    assert_eq!(robots(&of_one, true), (name("Сторож"), 2), "its own building, counted for itself");
    assert_eq!(robots(&of_all, false).1, 3, "who opens the page sees what is");
    assert_eq!(robots(&of_all, true).1, 3);
}

/// The status of an answer to some lines of a request.
fn status(centre: &Centre, lines: &[&str], body: &str) -> (u16, String) {
    let mut stream = TcpStream::connect(centre.address).expect("connects");
    let more = format!("Connection: close\r\nContent-Length: {}\r\n\r\n{body}", body.len());
    let request = format!("{}\r\n{more}", lines.join("\r\n"));
    stream.write_all(request.as_bytes()).expect("writes");
    let mut told = String::new();
    stream.read_to_string(&mut told).expect("reads");
    let status = told.split(' ').nth(1).and_then(|code| code.parse().ok());
    (status.expect("a status"), told)
}

#[tokio::test(flavor = "multi_thread")]
async fn other_pages_and_strangers_are_kept_out() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    let robots = furnish(&postgres.address(), &[(1, 1), (2, 1)]).await;
    let client = db::connect(&postgres.address()).await.expect("connects");
    let editor = keys::add_editor(&client, Some(1), "Редактор").await.expect("new");
    let looker = keys::add_operator(&client, None, "Гость").await.expect("new");
    let centre = Centre::start(&postgres.address());
    let host = format!("Host: {}", centre.address);
    let origin = format!("Origin: http://{}", centre.address);
    let (site, json) = ("Sec-Fetch-Site: same-origin", "Content-Type: application/json");
    let enter = |key: &str, lines: &[&str]| {
        let all = [&["POST /v1/enter HTTP/1.1"], lines].concat();
        status(&centre, &all, &format!("{{\"key\":\"{key}\"}}"))
    };
    let (came, told) = enter(&looker, &[&host, &origin, site, json]);
    assert_eq!(came, 200);
    for wanted in ["content-security-policy: default-src 'self'", "x-content-type-options: nosniff"]
    {
        assert!(told.to_lowercase().contains(wanted), "{told}");
    }
    let cookie = told.lines().find_map(|line| line.strip_prefix("set-cookie: ")).expect("one");
    assert!(cookie.contains("HttpOnly") && cookie.contains("SameSite=Strict"), "{cookie}");
    assert!(!told.contains(&looker), "the key itself stays out of the browser");
    let cookie = format!("Cookie: {}", cookie.split(';').next().expect("a pair"));
    let get =
        |lines: &[&str]| status(&centre, &[&["GET /v1/fleet HTTP/1.1"], lines].concat(), "").0;
    assert_eq!(get(&[&host, &cookie]), 200);
    assert_eq!(get(&[&host]), 401);
    assert_eq!(get(&["Host: evil.example", &cookie]), 421);
    assert_eq!(get(&[&host, &cookie, "Sec-Fetch-Site: cross-site"]), 403);
    let question = "{\"question\":\"Что изменилось за неделю?\"}";
    let ask = |lines: &[&str]| {
        status(&centre, &[&["POST /v1/ask HTTP/1.1", json], lines].concat(), question).0
    };
    assert_eq!(ask(&[&host, &cookie, &origin, site]), 200);
    assert_eq!(ask(&[&host, &cookie]), 403);
    assert_eq!(ask(&[&host, &cookie, "Origin: http://evil.example", site]), 403);
    assert_eq!(ask(&[&host, &cookie, &origin, "Sec-Fetch-Site: cross-site"]), 403);
    // A robot's key opens no session, nor does a session open another; what ends is over.
    for key in [robots[0].as_str(), cookie.split('=').next_back().expect("it"), "", "'; --"] {
        assert_eq!(enter(key, &[&host, &origin, site, json]).0, 401, "{key}");
    }
    let left =
        status(&centre, &["POST /v1/leave HTTP/1.1", &host, &cookie, &origin, site, json], "");
    assert_eq!(left.0, 200);
    assert_eq!(get(&[&host, &cookie]), 401);
    let (_, told) = enter(&looker, &[&host, &origin, site, json]);
    let cookie = told.lines().find_map(|line| line.strip_prefix("set-cookie: ")).expect("one");
    let cookie = format!("Cookie: {}", cookie.split(';').next().expect("a pair"));
    assert_eq!(get(&[&host, &cookie]), 200);
    keys::revoke(&client, "Гость").await.expect("there is one");
    assert_eq!(get(&[&host, &cookie]), 401, "with a key its sessions end");

    // Who edits one building does so there alone, by the rows' own security.
    let pool = db::pool(&postgres.address(), 1).expect("an address");
    let mut pooled = pool.get().await.expect("connects");
    for (building, may) in [(1_i64, true), (2, false)] {
        let transaction = pooled.transaction().await.expect("begins");
        db::enter(&transaction, &editor).await.expect("a key");
        let made = revise::revise(
            &transaction,
            building,
            None,
            &home(),
            &Change::new("Редактор", Timestamp(1_860_000_000_000), "карта"),
        )
        .await;
        match made {
            Ok(1) if may => transaction.commit().await.expect("commits"),
            Err(FleetError::Unknown { .. }) if !may => {}
            other => panic!("{building}: {other:?}"),
        }
    }
    let looks = keys::add_operator(&client, None, "Ещё гость").await.expect("new");
    let transaction = pooled.transaction().await.expect("begins");
    db::enter(&transaction, &looks).await.expect("a key");
    let sql = "UPDATE map.\"Area\" SET \"Name\" = 'x' WHERE building = 1";
    assert_eq!(transaction.execute(sql, &[]).await.expect("changes nothing"), 0);
}
