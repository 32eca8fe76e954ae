//! A rule text as it stands: items, rules and expressions with their places, names not yet resolved.

use std::ops::Range;

use miette::SourceSpan;

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
    /// `.type Pair = [x: number, y: symbol]`, `.type Tree = Leaf {} | Node {l: Tree, r: Tree}`.
    Structure { name: Name, branches: Vec<Branch>, is_record: bool },
    /// `.include "other.dl"`
    Include { path: String, at: Span },
    /// `.decl above(a: symbol, b: symbol) = НАД`; several names may share one list of columns.
    Relation {
        names: Vec<Name>,
        columns: Vec<(Name, Name)>,
        second: Option<Name>,
        roles: Vec<Role>,
        /// Of `choice-domain`: columns of which each combination stands in one tuple.
        domains: Vec<Vec<Name>>,
    },
    /// `.comp Graph<N> : Base<N> { … }`
    Component(Component),
    /// `.init g = Graph<Place>`
    Instance { name: Name, of: Type, at: Span },
    /// `.override rel`, within a component.
    Override(Name),
    /// `shortest(x, a) <= shortest(x, b) :- b < a.`: the left tuple goes where the right one stands.
    Subsumption { dominated: Atom, dominating: Atom, body: Body, at: Span },
    /// `.plan 0:(2,1)` behind a rule: in which order its atoms are to be joined. Read and not followed.
    Plan { orders: Vec<(i64, Vec<i64>)>, at: Span },
    /// `.pragma "time-limit" "10"`
    Pragma { name: String, value: String, at: Span },
    /// `.functor f(x: number): symbol stateful`: foreign code. What is declared need not be called.
    Foreign { name: Name, types: Vec<Name> },
    /// `.input`, `.output`, `.printsize`, `.limitsize`.
    Directive { role: Role, relations: Vec<Name>, parameters: Vec<(String, String)> },
    /// A fact is a rule without a body.
    Rule(Rule),
}

impl Item {
    /// Its place, or that of the first name in it.
    pub(super) fn at(&self) -> Span {
        match self {
            Self::Type { name, .. }
            | Self::Structure { name, .. }
            | Self::Override(name)
            | Self::Foreign { name, .. } => name.at,
            Self::Include { at, .. }
            | Self::Instance { at, .. }
            | Self::Subsumption { at, .. }
            | Self::Plan { at, .. }
            | Self::Pragma { at, .. } => *at,
            Self::Relation { names, .. } | Self::Directive { relations: names, .. } => {
                names.first().map(|name| name.at).unwrap_or_default()
            }
            Self::Component(component) => component.head.name.at,
            Self::Rule(rule) => rule.at,
        }
    }
}

/// A component's name with its parameters, or with the types that stand for them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Type {
    pub(super) name: Name,
    pub(super) args: Vec<Name>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Component {
    pub(super) head: Type,
    pub(super) bases: Vec<Type>,
    pub(super) items: Vec<Item>,
}

/// A way to build a value of a structure: its name and its fields with their types.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Branch {
    pub(super) name: Name,
    pub(super) fields: Vec<(Name, Name)>,
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
    /// Its rules may be replaced by a component that inherits it.
    Overridable,
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
    /// `5u`
    Unsigned(i64, Span),
    /// In millionths.
    Decimal(i64, Span),
    Text(String, Span),
    /// `[x, y]`, or with a branch's name `$Node(l, r)`.
    Record {
        branch: Option<Box<Name>>,
        args: Vec<Self>,
        at: Span,
    },
    /// `nil`, the record that is none.
    Nil(Span),
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
            | Self::Unsigned(_, at)
            | Self::Nil(at)
            | Self::Record { at, .. }
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
    /// Soufflé's `match(pattern, text)`: the whole text is of the regular expression.
    Matches,
    NotMatches,
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
            Self::Matches => Self::NotMatches,
            Self::NotMatches => Self::Matches,
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
            Self::Contains | Self::NotContains | Self::Matches | Self::NotMatches => return None,
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
            Self::Matches => "match",
            Self::NotMatches => "!match",
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

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    Symbol,
    Number,
    /// A number of 32 bits that is never negative and goes round.
    Unsigned,
    /// An exact decimal, see [`Decimal`](super::Decimal).
    Float,
    /// A record or a value of a branched type, by the number of the type.
    Record(u32),
}

impl Kind {
    /// Whether its words stand for numbers, which decimals are in millionths.
    pub(super) fn is_number(self) -> bool {
        !matches!(self, Self::Symbol | Self::Record(_))
    }
}

macro_rules! functors {
    ($($name:ident $word:literal $result:ident ($($arg:ident),*);)+) => {
        /// What computes a value from values. The list gives word, result and arguments (`N` number, `U` unsigned,
        /// `D` decimal, `S` symbol); a word that stands several times means what fits its first argument.
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
    (@kind U) => { Kind::Unsigned };
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
    AddUnsigned "+" U(U, U);
    SubtractUnsigned "-" U(U, U);
    MultiplyUnsigned "*" U(U, U);
    DivideUnsigned "/" U(U, U);
    RemainderUnsigned "%" U(U, U);
    PowerUnsigned "^" U(U, U);
    NegateUnsigned "neg" U(U);
    SmallerUnsigned "min" U(U, U);
    LargerUnsigned "max" U(U, U);
    AddDecimals "+" D(D, D);
    SubtractDecimals "-" D(D, D);
    MultiplyDecimals "*" D(D, D);
    DivideDecimals "/" D(D, D);
    PowerOfDecimals "^" D(D, D);
    NegateDecimals "neg" D(D);
    SmallerOfDecimals "min" D(D, D);
    LargerOfDecimals "max" D(D, D);
    AddTexts "+" S(S, S);
    SmallerText "min" S(S, S);
    LargerText "max" S(S, S);
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
    BitAndUnsigned "band" U(U, U);
    BitOrUnsigned "bor" U(U, U);
    BitXorUnsigned "bxor" U(U, U);
    BitNotUnsigned "bnot" U(U);
    ShiftLeftUnsigned "bshl" U(U, U);
    ShiftRightOfUnsigned "bshr" U(U, U);
    ShiftRightUnsignedOfUnsigned "bshru" U(U, U);
    LogicalAndUnsigned "land" U(U, U);
    LogicalOrUnsigned "lor" U(U, U);
    LogicalXorUnsigned "lxor" U(U, U);
    LogicalNotUnsigned "lnot" U(U);
    Concatenate "cat" S(S, S);
    Length "strlen" N(S);
    Part "substr" S(S, N, N);
    ToText "to_string" S(N);
    TextToText "to_string" S(S);
    DecimalToText "to_string" S(D);
    UnsignedToText "to_string" S(U);
    ToNumber "to_number" N(S);
    DecimalToNumber "to_number" N(D);
    NumberToNumber "to_number" N(N);
    UnsignedToNumber "to_number" N(U);
    ToUnsigned "to_unsigned" U(S);
    NumberToUnsigned "to_unsigned" U(N);
    DecimalToUnsigned "to_unsigned" U(D);
    UnsignedToUnsigned "to_unsigned" U(U);
    ToDecimal "to_float" D(S);
    DecimalToDecimal "to_float" D(D);
    NumberToDecimal "to_float" D(N);
    UnsignedToDecimal "to_float" D(U);
    Ordinal "ord" N(S);
    Range "range" N(N, N, N);
    RangeUnsigned "range" U(U, U, U);
    RangeOfDecimals "range" D(D, D, D);
    Counter "autoinc" N();
    Record "[]" S();
    Field "[n]" S();
}

impl Functor {
    /// What the word means for a first argument of this kind; itself where it has one meaning.
    pub(super) fn for_kind(self, first: Option<Kind>) -> Self {
        let fits = |functor: &Self| {
            functor.word() == self.word() && functor.takes().first().copied() == first
        };
        Self::ALL.iter().copied().find(fits).unwrap_or(self)
    }

    /// Whether the result is of the kind of the arguments.
    pub(super) fn is_arithmetic(self) -> bool {
        let same = self.takes().iter().all(|kind| *kind == self.result());
        same && !self.takes().is_empty()
            && !matches!(
                self.word(),
                "cat" | "to_string" | "to_number" | "to_unsigned" | "to_float"
            )
    }

    pub(super) fn is_range(self) -> bool {
        matches!(self, Self::Range | Self::RangeUnsigned | Self::RangeOfDecimals)
    }
}

/// A record in a rule: its branch, its fields and its place.
pub(super) struct Record<'a> {
    pub(super) branch: Option<&'a Name>,
    pub(super) args: &'a [Expr],
    pub(super) at: Span,
}

impl<'a> Record<'a> {
    pub(super) fn of(expr: &'a Expr) -> Option<Self> {
        match expr {
            Expr::Record { branch, args, at } => {
                Some(Self { branch: branch.as_deref(), args, at: *at })
            }
            _ => None,
        }
    }
}
