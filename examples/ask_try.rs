use orthoframe::Engine;
use orthoframe::engine::Memory;
fn main() {
    let mut args = std::env::args().skip(1);
    let store = args.next().unwrap();
    let e = Engine::open_existing(store.as_ref(), None).unwrap();
    let keep = args.next().is_some();
    let mut m = Memory::default();
    for line in std::io::stdin().lines() {
        let line = line.unwrap();
        if !keep {
            m = Memory::default();
        }
        match e.ask(&line, &mut m).unwrap() {
            Ok(a) => {
                println!("{line}\n    {} | {:?}", a.text, a.said);
                if keep {
                    println!("      {}", e.rule_of(&a).unwrap());
                }
            }
            Err(u) => println!("{line}\n    [{}] {}", u.doubt.kind(), u.text),
        }
    }
}
