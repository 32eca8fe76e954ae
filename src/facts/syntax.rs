//! A rule text as it stands: items, rules and expressions with their places, names not yet resolved.

use std::ops::Range;

use miette::SourceSpan;

use super::program::Kind;

/// Byte range in one of the program's texts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Span {
    pub(super) file: u32,
    pub(super) start: u32,
    pub(super) end: u32,
}

impl Span {
    pub(super) fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// From the start of this span to the end of the other.
    pub(super) fn to(self, other: Self) -> Self {
        Self { end: other.end.max(self.end), ..self }
    }
}

impl From<Span> for SourceSpan {
    fn from(span: Span) -> Self {
        span.range().into()
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) at: Span,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Item {
    /// `.type Place <: symbol`; with `=` the base may be several types, whose values are then the type's.
    Type { name: Name, bases: Vec<Name>, is_union: bool },
    /// `.include "other.dl"`
    Include { path: String, at: Span },
    /// `.decl above(a: symbol, b: symbol) = НАД`; several names may share one list of columns.
    Relation {
        names: Vec<Name>,
        columns: Vec<(Name, Name)>,
        second: Option<Name>,
        roles: Vec<Role>,
    },
    /// `.input`, `.output`, `.printsize`, `.limitsize`.
    Directive { role: Role, relations: Vec<Name>, parameters: Vec<(String, String)> },
    /// A fact is a rule without a body.
    Rule(Rule),
    /// Read over on purpose, such as `.pragma`.
    Nothing,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Input,
    Output,
    PrintSize,
    LimitSize,
    /// `eqrel`: closed under equivalence.
    Equivalence,
    /// `inline`: its rules are put where it is read.
    Inline,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rule {
    pub(super) heads: Vec<Atom>,
    pub(super) body: Body,
    pub(super) at: Span,
}

/// `?- body. order X desc. limit 5`
#[derive(Debug, Clone)]
pub(super) struct Question {
    /// What is asked for, where a head says it.
    pub(super) exprs: Option<Vec<Expr>>,
    pub(super) body: Body,
    /// Names of answer columns, each with whether it descends.
    pub(super) order: Vec<(Name, bool)>,
    pub(super) limit: Option<usize>,
    /// The text that it stands in.
    pub(super) text: String,
    pub(super) at: Span,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Body {
    All(Vec<Self>),
    Any(Vec<Self>),
    Not(Box<Self>),
    Atom(Atom),
    Compare { op: Comparison, left: Expr, right: Expr, at: Span },
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Atom {
    pub(super) relation: Name,
    pub(super) args: Vec<Expr>,
    pub(super) at: Span,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Expr {
    Any(Span),
    Variable(Name),
    Number(i64, Span),
    /// In millionths.
    Decimal(i64, Span),
    Text(String, Span),
    /// `as(value, type)`
    As {
        value: Box<Self>,
        type_name: Box<Name>,
        at: Span,
    },
    Call {
        functor: Functor,
        args: Vec<Self>,
        at: Span,
    },
    Aggregate {
        function: Aggregation,
        value: Option<Box<Self>>,
        body: Box<Body>,
        at: Span,
    },
}

impl Expr {
    pub(super) fn at(&self) -> Span {
        match self {
            Self::Variable(name) => name.at,
            Self::Any(at)
            | Self::Number(_, at)
            | Self::Decimal(_, at)
            | Self::Text(_, at)
            | Self::As { at, .. }
            | Self::Call { at, .. }
            | Self::Aggregate { at, .. } => *at,
        }
    }
}

/// How two values are compared; `Contains` is Soufflé's `contains(part, whole)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Comparison {
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Contains,
    NotContains,
}

impl Comparison {
    /// The comparison that holds exactly when this one does not.
    pub(super) fn negated(self) -> Self {
        match self {
            Self::Equal => Self::NotEqual,
            Self::NotEqual => Self::Equal,
            Self::Less => Self::GreaterOrEqual,
            Self::LessOrEqual => Self::Greater,
            Self::Greater => Self::LessOrEqual,
            Self::GreaterOrEqual => Self::Less,
            Self::Contains => Self::NotContains,
            Self::NotContains => Self::Contains,
        }
    }

    /// The comparison with its sides exchanged; none for the two that are not about order.
    pub(super) fn mirrored(self) -> Option<Self> {
        Some(match self {
            Self::Equal => Self::Equal,
            Self::NotEqual => Self::NotEqual,
            Self::Less => Self::Greater,
            Self::LessOrEqual => Self::GreaterOrEqual,
            Self::Greater => Self::Less,
            Self::GreaterOrEqual => Self::LessOrEqual,
            Self::Contains | Self::NotContains => return None,
        })
    }

    /// As rule texts write it.
    #[must_use]
    pub fn sign(self) -> &'static str {
        match self {
            Self::Equal => "=",
            Self::NotEqual => "!=",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
            Self::Contains => "contains",
            Self::NotContains => "!contains",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aggregation {
    Count,
    Sum,
    Min,
    Max,
    Mean,
}

impl Aggregation {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Count => "count",
            Self::Sum => "sum",
            Self::Min => "min",
            Self::Max => "max",
            Self::Mean => "mean",
        }
    }
}

macro_rules! functors {
    ($($name:ident $word:literal $result:ident ($($arg:ident),*);)+) => {
        /// What computes a value from values. The list gives word, result and arguments (`N` number, `D` decimal,
        /// `S` symbol); the variants that end with `Decimals` are what a word means between decimals.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub(super) enum Functor { $($name),+ }

        impl Functor {
            pub(super) const ALL: &[Self] = &[$(Self::$name),+];

            pub(super) fn word(self) -> &'static str {
                match self { $(Self::$name => $word),+ }
            }

            pub(super) fn result(self) -> Kind {
                match self { $(Self::$name => functors!(@kind $result)),+ }
            }

            pub(super) fn takes(self) -> &'static [Kind] {
                match self { $(Self::$name => &[$(functors!(@kind $arg)),*]),+ }
            }
        }
    };
    (@kind N) => { Kind::Number };
    (@kind D) => { Kind::Float };
    (@kind S) => { Kind::Symbol };
}

functors! {
    Add "+" N(N, N);
    Subtract "-" N(N, N);
    Multiply "*" N(N, N);
    Divide "/" N(N, N);
    Remainder "%" N(N, N);
    Power "^" N(N, N);
    Negate "neg" N(N);
    Smaller "min" N(N, N);
    Larger "max" N(N, N);
    AddDecimals "+" D(D, D);
    SubtractDecimals "-" D(D, D);
    MultiplyDecimals "*" D(D, D);
    DivideDecimals "/" D(D, D);
    PowerOfDecimals "^" D(D, D);
    NegateDecimals "neg" D(D);
    SmallerOfDecimals "min" D(D, D);
    LargerOfDecimals "max" D(D, D);
    BitAnd "band" N(N, N);
    BitOr "bor" N(N, N);
    BitXor "bxor" N(N, N);
    BitNot "bnot" N(N);
    ShiftLeft "bshl" N(N, N);
    ShiftRight "bshr" N(N, N);
    ShiftRightUnsigned "bshru" N(N, N);
    LogicalAnd "land" N(N, N);
    LogicalOr "lor" N(N, N);
    LogicalXor "lxor" N(N, N);
    LogicalNot "lnot" N(N);
    Concatenate "cat" S(S, S);
    Length "strlen" N(S);
    Part "substr" S(S, N, N);
    ToText "to_string" S(N);
    TextToText "to_string" S(S);
    DecimalToText "to_string" S(D);
    ToNumber "to_number" N(S);
    DecimalToNumber "to_number" N(D);
    NumberToNumber "to_number" N(N);
    ToUnsigned "to_unsigned" N(S);
    NumberToUnsigned "to_unsigned" N(N);
    DecimalToUnsigned "to_unsigned" N(D);
    ToDecimal "to_float" D(S);
    DecimalToDecimal "to_float" D(D);
    NumberToDecimal "to_float" D(N);
    Ordinal "ord" N(S);
    Range "range" N(N, N, N);
}

impl Functor {
    /// What the word means for arguments of these kinds; itself where it has one meaning.
    pub(super) fn for_kinds(self, first: Option<Kind>) -> Self {
        match (self, first) {
            (Self::Add, Some(Kind::Float)) => Self::AddDecimals,
            (Self::Subtract, Some(Kind::Float)) => Self::SubtractDecimals,
            (Self::Multiply, Some(Kind::Float)) => Self::MultiplyDecimals,
            (Self::Divide, Some(Kind::Float)) => Self::DivideDecimals,
            (Self::Power, Some(Kind::Float)) => Self::PowerOfDecimals,
            (Self::Negate, Some(Kind::Float)) => Self::NegateDecimals,
            (Self::Smaller, Some(Kind::Float)) => Self::SmallerOfDecimals,
            (Self::Larger, Some(Kind::Float)) => Self::LargerOfDecimals,
            (Self::ToText, Some(Kind::Float)) => Self::DecimalToText,
            (Self::ToNumber, Some(Kind::Float)) => Self::DecimalToNumber,
            (Self::ToText, Some(Kind::Symbol)) => Self::TextToText,
            (Self::ToNumber, Some(Kind::Number)) => Self::NumberToNumber,
            (Self::ToUnsigned, Some(Kind::Number)) => Self::NumberToUnsigned,
            (Self::ToUnsigned, Some(Kind::Float)) => Self::DecimalToUnsigned,
            (Self::ToDecimal, Some(Kind::Number)) => Self::NumberToDecimal,
            (Self::ToDecimal, Some(Kind::Float)) => Self::DecimalToDecimal,
            _ => self,
        }
    }

    /// Whether the result is of the kind of the arguments.
    pub(super) fn is_arithmetic(self) -> bool {
        use Functor::{Add, Divide, Larger, Multiply, Negate, Power, Smaller, Subtract};
        matches!(self, Add | Subtract | Multiply | Divide | Power | Negate | Smaller | Larger)
    }
}
