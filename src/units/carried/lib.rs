//! [`carried!`]: what the compiler puts in the place of a text that the program carries.

use proc_macro::{Span, TokenStream, TokenTree};

/// A text file of the sources as part of the program: a value for a `static` of the type `Carried`.
///
/// The file stands beside the one that calls, as for [`include_str!`]; its path may come in several pieces.
#[proc_macro]
pub fn carried(path: TokenStream) -> TokenStream {
    let at = first(path.clone()).map_or_else(Span::call_site, |first| first.span());
    let pieces = literals(path);
    // The compiler reads the path where the caller stands, and sees when the file changes.
    let plain = format!("include_str!(concat!({}))", pieces.join(","));
    value(at, &pieces, &plain).parse().expect("what stands above is an expression")
}

/// The first literal: what another macro hands on stands where that was called, and so does the way from there.
fn first(tokens: TokenStream) -> Option<TokenTree> {
    tokens.into_iter().next().and_then(|token| match token {
        TokenTree::Group(group) => first(group.stream()),
        other => Some(other),
    })
}

/// The literals of a macro's argument, those that another macro hands on among them.
fn literals(tokens: TokenStream) -> Vec<String> {
    let piece = |token| match token {
        TokenTree::Group(group) => literals(group.stream()),
        other => vec![other.to_string()],
    };
    tokens.into_iter().flat_map(piece).collect()
}

#[cfg(not(feature = "packed"))]
fn value(_at: Span, _pieces: &[String], plain: &str) -> String {
    format!("::std::sync::LazyLock::new(|| {plain})")
}

#[cfg(feature = "packed")]
fn value(at: Span, pieces: &[String], plain: &str) -> String {
    let caller = at.local_file().expect("a macro is called in a file");
    let path: String = pieces.iter().map(|piece| piece.trim_matches('"')).collect();
    let path = caller.with_file_name(path);
    let text = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let packed = proc_macro::Literal::byte_string(&packed(&text).expect("memory for a text"));
    format!(
        "::std::sync::LazyLock::new(|| {{
            const _: &str = {plain};
            ::orthoframe_units::unpacked({packed})
        }})"
    )
}

#[cfg(feature = "packed")]
fn packed(text: &[u8]) -> std::io::Result<Vec<u8>> {
    use std::io::Write as _;

    use lzma_rust2::{LzmaOptions, LzmaWriter};

    // What it saves is paid once a build.
    const LEVEL: u32 = 9;
    const LEAST_WINDOW: usize = 4096;
    let window = u32::try_from(text.len().max(LEAST_WINDOW)).map_err(std::io::Error::other)?;
    // A letter's place says nothing of it.
    let options = LzmaOptions {
        dict_size: window,
        pb: 0,
        nice_len: LzmaOptions::NICE_LEN_MAX,
        ..LzmaOptions::with_preset(LEVEL)
    };
    let mut packed = LzmaWriter::new_use_header(Vec::new(), &options, Some(text.len() as u64))?;
    packed.write_all(text)?;
    packed.finish()
}
