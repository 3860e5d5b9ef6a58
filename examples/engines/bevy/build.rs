// Where libsward.so lies: SWARD_LIBRARY_FOLDER=/opt/sward/lib cargo run --release -- meadow.sward
fn main() {
    if let Ok(folder) = std::env::var("SWARD_LIBRARY_FOLDER") {
        println!("cargo:rustc-link-search=native={folder}");
        println!("cargo:rustc-link-arg=-Wl,-rpath,{folder}");
    }
}
