//! `#[derive(Fault)]`: a fault is data, and its words stand in the message files of its crate (rules/messages).
//!
//! ```text
//! #[derive(Debug, Fault)]
//! #[fault(strips)]                             // its codes begin so
//! pub enum RuleError {
//!     NotText { path: String, offset: usize }, // strips::not_text, told by the message strips-not-text
//!     #[fault(warning)]
//!     Surplus { at: SourceSpan },              // a place: told by the attribute .at, or simply «здесь»
//!     #[fault(code = "draw::format")]
//!     Format { help: Option<Bilingual> },      // this is the remedy; of others it is the attribute .help
//!     #[fault(transparent)]
//!     Other(#[from] OtherFault),               // tells what is within
//! }
//! ```
//!
//! Where another fault has the same code and other words, `message = "…"` names its message.
//!
//! What stands in no message, such as the text of a file, is marked `#[fault(untold)]`; what holds that text, `#[source_code]`;
//! the faults that it is made of, `#[related]`; a field `source` is its cause.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use syn::{Data, DeriveInput, Error, Field, Fields, LitStr, Result, Variant};

#[proc_macro_derive(Fault, attributes(fault, from, source_code, related))]
pub fn fault(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = syn::parse_macro_input!(input as DeriveInput);
    derived(&input).unwrap_or_else(Error::into_compile_error).into()
}

/// What `#[fault(…)]` says of an enum, of a variant or of a field.
#[derive(Default)]
struct Said {
    family: Option<Ident>,
    code: Option<String>,
    message: Option<String>,
    warning: bool,
    transparent: bool,
    untold: bool,
}

fn said(attributes: &[syn::Attribute]) -> Result<Said> {
    let mut said = Said::default();
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("fault")) {
        attribute.parse_nested_meta(|meta| {
            if meta.path.is_ident("code") {
                said.code = Some(meta.value()?.parse::<LitStr>()?.value());
            } else if meta.path.is_ident("message") {
                said.message = Some(meta.value()?.parse::<LitStr>()?.value());
            } else if meta.path.is_ident("warning") {
                said.warning = true;
            } else if meta.path.is_ident("transparent") {
                said.transparent = true;
            } else if meta.path.is_ident("untold") {
                said.untold = true;
            } else {
                said.family = Some(meta.path.require_ident()?.clone());
            }
            Ok(())
        })?;
    }
    Ok(said)
}

fn has(field: &Field, name: &str) -> bool {
    field.attrs.iter().any(|attribute| attribute.path().is_ident(name))
}

/// The arms of the methods, variant by variant.
#[derive(Default)]
struct Arms {
    kinds: Vec<TokenStream>,
    kind: Vec<TokenStream>,
    values: Vec<TokenStream>,
    spans: Vec<TokenStream>,
    inner: Vec<TokenStream>,
    cause: Vec<TokenStream>,
    text: Vec<TokenStream>,
    related: Vec<TokenStream>,
    from: Vec<TokenStream>,
}

fn derived(input: &DeriveInput) -> Result<TokenStream> {
    let name = &input.ident;
    let whole = said(&input.attrs)?;
    let mut arms = Arms::default();
    match &input.data {
        Data::Enum(data) => {
            for variant in &data.variants {
                let ident = &variant.ident;
                let (code, own) = (code(&whole, variant)?, said(&variant.attrs)?);
                arms.add(name, &quote!(#name::#ident), &code, &variant.fields, &own)?;
            }
        }
        Data::Struct(data) => {
            let code = whole.code.clone().ok_or_else(|| Error::new_spanned(name, "no code"))?;
            arms.add(name, &quote!(#name), &code, &data.fields, &whole)?;
        }
        Data::Union(_) => return Err(Error::new_spanned(name, "a union is no fault")),
    }
    let Arms { kinds, kind, values, spans, inner, cause, text, related, from } = arms;
    Ok(quote! {
        impl ::orthoframe_units::Fault for #name {
            const KINDS: &'static [::orthoframe_units::Kind] = &[#(#kinds),*];
            fn messages(&self) -> &'static ::orthoframe_units::Messages {
                &crate::MESSAGES
            }
            fn kind(&self) -> ::std::option::Option<usize> {
                match self { #(#kind)* }
            }
            fn values(&self) -> ::std::vec::Vec<&dyn ::orthoframe_units::Value> {
                match self { #(#values)* }
            }
            fn spans(&self) -> ::std::vec::Vec<::std::option::Option<::miette::SourceSpan>> {
                match self { #(#spans)* _ => ::std::vec::Vec::new() }
            }
            fn inner(&self) -> ::std::option::Option<&dyn ::orthoframe_units::InEnglish> {
                match self { #(#inner)* _ => ::std::option::Option::None }
            }
        }
        impl ::orthoframe_units::Value for #name {
            fn told(
                &self,
                language: ::orthoframe_units::Language,
            ) -> ::std::option::Option<::orthoframe_units::Argument<'_>> {
                ::std::option::Option::Some(::orthoframe_units::Fault::tell(self, language).into())
            }
        }
        impl ::std::fmt::Display for #name {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                f.write_str(&::orthoframe_units::Fault::tell(self, ::orthoframe_units::Language::Russian))
            }
        }
        impl ::std::error::Error for #name {
            fn source(&self) -> ::std::option::Option<&(dyn ::std::error::Error + 'static)> {
                match self { #(#cause)* _ => ::std::option::Option::None }
            }
        }
        impl ::miette::Diagnostic for #name {
            fn code<'a>(&'a self) -> ::std::option::Option<::std::boxed::Box<dyn ::std::fmt::Display + 'a>> {
                ::orthoframe_units::Fault::told_code(self)
            }
            fn severity(&self) -> ::std::option::Option<::miette::Severity> {
                ::orthoframe_units::Fault::told_severity(self)
            }
            fn help<'a>(&'a self) -> ::std::option::Option<::std::boxed::Box<dyn ::std::fmt::Display + 'a>> {
                ::orthoframe_units::Fault::told_help(self)
            }
            fn labels(
                &self,
            ) -> ::std::option::Option<::std::boxed::Box<dyn ::std::iter::Iterator<Item = ::miette::LabeledSpan> + '_>> {
                ::orthoframe_units::Fault::told_labels(self)
            }
            fn source_code(&self) -> ::std::option::Option<&dyn ::miette::SourceCode> {
                match self { #(#text)* _ => ::orthoframe_units::Fault::inner(self)?.source_code() }
            }
            fn related<'a>(
                &'a self,
            ) -> ::std::option::Option<::std::boxed::Box<dyn ::std::iter::Iterator<Item = &'a dyn ::miette::Diagnostic> + 'a>> {
                match self { #(#related)* _ => ::orthoframe_units::Fault::inner(self)?.related() }
            }
        }
        #(#from)*
    })
}

impl Arms {
    fn add(
        &mut self,
        whole: &Ident,
        path: &TokenStream,
        code: &str,
        fields: &Fields,
        said: &Said,
    ) -> Result<()> {
        // A tuple's fields have numbers, by which patterns may name them too.
        let member = |(i, field): (usize, &Field)| match &field.ident {
            Some(ident) => quote!(#ident),
            None => {
                let number = syn::Index::from(i);
                quote!(#number)
            }
        };
        for (i, field) in fields.iter().enumerate() {
            let (kind, member) = (&field.ty, member((i, field)));
            if has(field, "from") {
                self.from.push(quote! {
                    impl ::std::convert::From<#kind> for #whole {
                        fn from(from: #kind) -> Self {
                            #path { #member: from }
                        }
                    }
                });
            }
            if field.ident.as_ref().is_some_and(|ident| ident == "source") {
                self.cause
                    .push(quote!(#path { #member: it, .. } => ::std::option::Option::Some(it),));
            }
            if has(field, "source_code") {
                self.text
                    .push(quote!(#path { #member: it, .. } => ::std::option::Option::Some(it),));
            }
            if has(field, "related") {
                self.related.push(quote! {
                    #path { #member: it, .. } => ::std::option::Option::Some(::std::boxed::Box::new(
                        it.iter().map(|one| one as &dyn ::miette::Diagnostic),
                    )),
                });
            }
        }
        if said.transparent {
            self.kind.push(quote!(#path { .. } => ::std::option::Option::None,));
            self.values.push(quote!(#path { .. } => ::std::vec::Vec::new(),));
            let is_boxed = fields.iter().any(|field| type_text(&field.ty).starts_with("Box <"));
            let within = if is_boxed { quote!(&**it) } else { quote!(it) };
            self.inner.push(quote!(#path(it) => ::std::option::Option::Some(#within),));
            self.cause.push(quote!(#path(it) => ::std::error::Error::source(it),));
            return Ok(());
        }
        let (mut names, mut members, mut idents) = (Vec::new(), Vec::new(), Vec::new());
        let (mut places, mut at, mut spans) = (Vec::new(), Vec::new(), Vec::new());
        for (i, field) in fields.iter().enumerate() {
            let untold = self::said(&field.attrs)?.untold;
            if untold || has(field, "source_code") || has(field, "related") {
                continue;
            }
            let (member, ident) = (member((i, field)), format_ident!("it{i}"));
            let name = field.ident.as_ref().map_or_else(|| ident.to_string(), Ident::to_string);
            let (names, members, idents) = match is_place(&field.ty) {
                true => (&mut places, &mut at, &mut spans),
                false => (&mut names, &mut members, &mut idents),
            };
            names.push(name);
            members.push(member);
            idents.push(ident);
        }
        let message =
            said.message.clone().unwrap_or_else(|| code.replace("::", "-").replace('_', "-"));
        let (warning, number) = (said.warning, self.kinds.len());
        self.kinds.push(quote! {
            ::orthoframe_units::Kind {
                code: #code,
                message: #message,
                warning: #warning,
                fields: &[#(#names),*],
                places: &[#(#places),*],
            }
        });
        self.kind.push(quote!(#path { .. } => ::std::option::Option::Some(#number),));
        self.values.push(quote!(#path { #(#members: #idents,)* .. } => ::std::vec![#(#idents),*],));
        if !spans.is_empty() {
            self.spans.push(quote! {
                #path { #(#at: #spans,)* .. } => ::std::vec![#((*#spans).into()),*],
            });
        }
        Ok(())
    }
}

/// The code of a variant: its name in the family of the enum, if nothing else is said.
fn code(whole: &Said, variant: &Variant) -> Result<String> {
    let own = said(&variant.attrs)?;
    if own.transparent {
        return Ok(String::new());
    }
    match (own.code, &whole.family) {
        (Some(code), _) => Ok(code),
        (None, Some(family)) => Ok(format!("{family}::{}", snake(&variant.ident.to_string()))),
        (None, None) => Err(Error::new_spanned(variant, "neither a code nor a family of codes")),
    }
}

fn snake(name: &str) -> String {
    let mut snake = String::new();
    for (i, letter) in name.char_indices() {
        if letter.is_uppercase() && i > 0 {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// Whether a field is a stretch of a text, or one that may be left out.
fn is_place(kind: &syn::Type) -> bool {
    ["SourceSpan", "Option < SourceSpan >"].contains(&type_text(kind).as_str())
}

fn type_text(kind: &syn::Type) -> String {
    quote!(#kind).to_string()
}
