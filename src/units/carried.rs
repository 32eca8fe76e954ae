//! [`Carried`]: texts that the program carries within itself.

use std::sync::LazyLock;

/// A text that the program carries, ready when it is first read.
///
/// With the feature `packed` it stands in the program compressed, a quarter as long; without it as it is. What makes one is
/// [`carried!`]:
///
/// ```
/// use orthoframe_units::{Carried, carried};
///
/// static MANIFEST: Carried = carried!("Cargo.toml");
/// assert!(MANIFEST.starts_with("[package]"));
/// ```
pub type Carried = LazyLock<&'static str>;

pub use orthoframe_units_carried::carried;

/// The text of what [`carried!`] has packed.
#[cfg(feature = "packed")]
#[doc(hidden)]
#[must_use]
pub fn unpacked(packed: &[u8]) -> &'static str {
    use std::io::Read as _;

    let mut text = String::new();
    lzma_rust2::LzmaReader::new_mem_limit(packed, u32::MAX, None)
        .and_then(|mut reader| reader.read_to_string(&mut text))
        .expect("a text is whole that was packed when the program was made");
    text.leak()
}
