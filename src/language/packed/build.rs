//! Compresses the dictionary of word forms for the program to carry.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // What it saves is paid once a build: the level that packs best for a window that any decoder takes.
    const LEVEL: i32 = 19;
    let packed =
        zstd::bulk::compress(rumorph_dict_ru::DICTIONARY, LEVEL).expect("memory for 20 MB");
    let out = std::env::var_os("OUT_DIR").expect("cargo names it");
    let path = std::path::Path::new(&out).join("ru.dict.zst");
    std::fs::write(&path, packed).expect("cargo's own folder can be written to");
}
