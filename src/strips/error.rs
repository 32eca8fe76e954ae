//! What can be wrong with a rule file, a scenario or a PDDL file, each fault with its place and its remedy.

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::units::{Bilingual, Source};

/// A stretch of a text that was read.
#[derive(Debug, Clone)]
pub struct Place {
    pub source: Source,
    pub span: SourceSpan,
}

impl Place {
    /// Line and column, both from 1, the column in characters.
    #[must_use]
    pub fn position(&self) -> (usize, usize) {
        self.source.position(self.span.offset())
    }
}

/// One thing wrong in a rule file, a scenario or a PDDL file.
#[derive(Debug, Clone, PartialEq, Eq, Error, Diagnostic)]
#[non_exhaustive]
pub enum RuleError {
    /// The file system refused.
    #[error("файл «{path}» не читается: {reason}")]
    #[diagnostic(code(strips::unreadable), help("проверьте путь и права доступа"))]
    Unreadable { path: String, reason: Bilingual },

    /// Rubbish instead of UTF-8.
    #[error("файл «{path}» – не текст в UTF-8: байт {offset} не читается")]
    #[diagnostic(code(strips::not_text), help("сохраните файл как текст в кодировке UTF-8"))]
    NotText { path: String, offset: usize },

    /// More than [`super::MAX_FILE_BYTES`].
    #[error("файл «{path}» слишком велик: {bytes} байт, предел {limit}")]
    #[diagnostic(
        code(strips::too_large),
        help("разделите файл на части и включите их: «Включить: часть.strips»")
    )]
    TooLarge { path: String, bytes: u64, limit: u64 },

    /// Nothing but white space and comments.
    #[error("файл «{path}» пуст")]
    #[diagnostic(
        code(strips::empty),
        help(
            "файл правил состоит из разделов «Действие: …», сценарий – из «Исходная позиция: …», «Целевая позиция: …»"
        )
    )]
    Empty { path: String },

    /// A character that no word of the language may hold.
    #[error("непонятный знак «{sign}»")]
    #[diagnostic(
        code(strips::unexpected_character),
        help("имена с такими знаками берут в кавычки: «имя»")
    )]
    UnexpectedCharacter {
        sign: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// One word stands where another is due.
    #[error("ожидается {expected}, а стоит {found}")]
    #[diagnostic(code(strips::syntax))]
    Syntax {
        expected: Bilingual,
        found: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// `Слово:` that opens no section.
    #[error("неизвестный раздел «{heading}»")]
    #[diagnostic(code(strips::unknown_heading))]
    UnknownHeading {
        heading: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A bracket was opened and never closed.
    #[error("скобка не закрыта")]
    #[diagnostic(code(strips::missing_parenthesis), help("поставьте «)» перед следующим разделом"))]
    MissingParenthesis {
        #[label("открыта здесь")]
        at: SourceSpan,
    },

    /// One closing bracket too many; the paper's own rule ends so.
    #[error("лишняя закрывающая скобка")]
    #[diagnostic(code(strips::surplus_parenthesis), severity(Warning), help("её можно убрать"))]
    SurplusParenthesis {
        #[label("здесь")]
        at: SourceSpan,
    },

    /// Brackets within brackets beyond all sense.
    #[error("скобки вложены глубже {limit} уровней")]
    #[diagnostic(code(strips::too_deep), help("упростите выражение"))]
    TooDeep {
        limit: usize,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// PDDL beyond :strips :typing :negative-preconditions :equality :action-costs.
    #[error("«{what}» не поддерживается")]
    #[diagnostic(code(strips::unsupported), help("{help}"))]
    Unsupported {
        what: String,
        help: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A PDDL requirement beyond what is read; a file that declares it need not use it.
    #[error("требование «{name}» шире того, что читается")]
    #[diagnostic(
        code(strips::requirement),
        severity(Warning),
        help(
            "читаются :strips :typing :negative-preconditions :equality :action-costs; что сверх того, будет названо там, где стоит"
        )
    )]
    Requirement {
        name: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// `(define …)` is closed, and more sections follow.
    #[error("«(define …)» здесь закрыто, а дальше стоит {next}")]
    #[diagnostic(code(strips::early_end), help("уберите лишнюю «)» здесь или раньше"))]
    EarlyEnd {
        next: Bilingual,
        #[label("закрыто здесь")]
        at: SourceSpan,
    },

    /// An assumption to be withdrawn that nobody made.
    #[error("такого предположения нет: {fact}{}", if *is_fact { " (это факт)" } else { "" })]
    #[diagnostic(code(strips::not_assumed))]
    NotAssumed {
        fact: String,
        is_fact: bool,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A scenario that is to be driven states what neither the map nor the robot knows to be so.
    #[error("карта и робот этого не знают: {fact}")]
    #[diagnostic(code(strips::not_believed))]
    NotBelieved {
        fact: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A scenario that is to be driven wants what nothing that the robot does brings about.
    #[error("этого робот исполнить не может: {fact}")]
    #[diagnostic(code(strips::not_driven), help("{help}"))]
    NotDriven {
        fact: String,
        help: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A type that is declared nowhere, though types are declared.
    #[error("неизвестный тип «{name}»")]
    #[diagnostic(code(strips::unknown_type))]
    UnknownType {
        name: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A type that inherits from itself.
    #[error("тип «{name}» наследует сам себе")]
    #[diagnostic(code(strips::type_cycle), help("разорвите круг наследования в разделе «Типы»"))]
    TypeCycle {
        name: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A predicate that no action and no declaration introduces.
    #[error("неизвестный предикат «{name}»")]
    #[diagnostic(code(strips::unknown_predicate))]
    UnknownPredicate {
        name: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A predicate that one action alone speaks of, and that differs from another by a slip of the pen.
    #[error("предикат «{name}» встречается только в действии «{action}» – не описка ли это?")]
    #[diagnostic(code(strips::lonely_predicate), severity(Warning))]
    LonelyPredicate {
        name: String,
        action: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A parent that is declared nowhere and differs from a declared type by a slip of the pen.
    #[error("тип «{name}» не объявлен – не описка ли это?")]
    #[diagnostic(code(strips::lonely_type), severity(Warning), help("{help}"))]
    LonelyType {
        name: String,
        help: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A number that no `:functions` declares.
    #[error("неизвестная функция «{name}»")]
    #[diagnostic(code(strips::unknown_function))]
    UnknownFunction {
        name: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A PDDL problem of another domain than the one read with it.
    #[error("задача относится к области «{wanted}», а прочитана область «{found}»")]
    #[diagnostic(
        code(strips::other_domain),
        severity(Warning),
        help("проверьте, те ли файлы названы в --domain и --problem")
    )]
    OtherDomain {
        wanted: String,
        found: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A PDDL metric that the planner does not know.
    #[error("критерий «{metric}» не учитывается")]
    #[diagnostic(
        code(strips::metric),
        severity(Warning),
        help(
            "учитывается (:metric minimize (total-cost)), также (+ (* 3 (is-violated имя)) …); без него план – с наименьшим числом шагов"
        )
    )]
    Metric {
        metric: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A PDDL metric that weighs a preference that there is none of.
    #[error("неизвестное желание «{name}»")]
    #[diagnostic(code(strips::unknown_preference))]
    UnknownPreference {
        name: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// Too few or too many arguments.
    #[error("«{name}»: аргументов {expected}, а дано {found}")]
    #[diagnostic(code(strips::arity), help("{help}"))]
    Arity {
        name: String,
        expected: usize,
        found: usize,
        help: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A variable that the action's parameters do not name.
    #[error("действие «{action}»: переменная «{variable}» не объявлена")]
    #[diagnostic(code(strips::undeclared_variable))]
    UndeclaredVariable {
        action: String,
        variable: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A variable where only objects may stand.
    #[error("переменная «{variable}» вне действия")]
    #[diagnostic(code(strips::variable_in_fact), help("в фактах и целях стоят имена объектов"))]
    VariableInFact {
        variable: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// The same name given twice where once is enough.
    #[error("{what} «{name}»: второе объявление")]
    #[diagnostic(code(strips::duplicate), help("{help}"))]
    Duplicate {
        what: Bilingual,
        name: String,
        help: Bilingual,
        #[label("второй раз – здесь")]
        at: SourceSpan,
        #[label("первый раз – здесь")]
        first: Option<SourceSpan>,
    },

    /// A second name is given to an action.
    #[error("«{name}» – действие: второе имя бывает у предикатов и типов")]
    #[diagnostic(
        code(strips::second_name_of_action),
        help("уберите второе имя; слова в кавычках останутся")
    )]
    SecondNameOfAction {
        name: String,
        #[label("второе имя")]
        at: SourceSpan,
    },

    /// An object declared twice, with types that have nothing in common.
    #[error("объект «{name}» объявлен дважды: здесь – «{found}», а раньше – «{earlier}»")]
    #[diagnostic(code(strips::object_twice), help("{help}"))]
    ObjectTwice {
        name: String,
        found: Bilingual,
        earlier: Bilingual,
        help: Bilingual,
        #[label("второй раз – здесь")]
        at: SourceSpan,
        #[label("первый раз – здесь")]
        first: Option<SourceSpan>,
    },

    /// A phrase with a variable that its head does not name.
    #[error("в словах стоит «{variable}», а среди аргументов её нет")]
    #[diagnostic(code(strips::phrase_variable))]
    PhraseVariable {
        variable: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// The same atom is added and deleted.
    #[error(
        "действие «{action}»: эффект противоречит сам себе: «{atom}» и прибавляется, и убирается"
    )]
    #[diagnostic(
        code(strips::contradictory_effect),
        help("оставьте факт в одном из «Эффект+», «Эффект-»")
    )]
    ContradictoryEffect {
        action: String,
        atom: String,
        #[label("убирается здесь")]
        at: SourceSpan,
    },

    /// A precondition that no state satisfies.
    #[error(
        "действие «{action}»: предусловие противоречит само себе: «{atom}» и требуется, и запрещается"
    )]
    #[diagnostic(code(strips::contradictory_precondition), help("уберите одно из двух"))]
    ContradictoryPrecondition {
        action: String,
        atom: String,
        #[label("запрещается здесь")]
        at: SourceSpan,
    },

    /// An argument of one type where the predicate wants another.
    #[error(
        "«{name}»: {number}-й аргумент должен быть типа «{expected}», а «{term}» – типа «{found}»"
    )]
    #[diagnostic(code(strips::argument_type), help("{help}"))]
    ArgumentType {
        name: String,
        number: usize,
        expected: Bilingual,
        term: String,
        found: Bilingual,
        help: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// `(дверь ?x)` in the body, `(помещение ?x)` in the parameters.
    #[error("переменная «{variable}» объявлена как «{declared}», а здесь названа «{found}»")]
    #[diagnostic(code(strips::variable_type), help("назовите тип так же, как в «Параметры»"))]
    VariableType {
        variable: String,
        declared: Bilingual,
        found: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// An object that no fact, declaration or map knows.
    #[error("неизвестный объект «{name}»")]
    #[diagnostic(code(strips::unknown_object))]
    UnknownObject {
        name: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// Two uses of an object ask for two types that have nothing in common.
    #[error("объект «{name}» здесь типа «{found}», а в другом месте – «{earlier}»")]
    #[diagnostic(
        code(strips::object_type),
        help("объявите тип объекта в разделе «Объекты» или исправьте факт")
    )]
    ObjectType {
        name: String,
        found: Bilingual,
        earlier: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// Facts that cannot hold together.
    #[error("«{atom}» и утверждается, и отрицается")]
    #[diagnostic(code(strips::contradictory_fact), help("оставьте одно из двух"))]
    ContradictoryFact {
        atom: String,
        #[label("отрицается здесь")]
        at: SourceSpan,
    },

    /// A file that includes itself through others.
    #[error("файл включает сам себя")]
    #[diagnostic(code(strips::include_cycle), help("уберите это включение"))]
    IncludeCycle {
        #[label("здесь")]
        at: SourceSpan,
    },

    /// An included file that cannot be had.
    #[error("файл «{path}» не включается: {reason}")]
    #[diagnostic(
        code(strips::include),
        help("путь отсчитывается от файла, в котором стоит «Включить»")
    )]
    Include {
        path: String,
        reason: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A number that is none, or is negative, or too large.
    #[error("«{text}» – не стоимость")]
    #[diagnostic(
        code(strips::cost),
        help("стоимость – число от 0 до 1000000, не больше трёх знаков после точки")
    )]
    Cost {
        text: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A scenario without a goal.
    #[error("у сценария нет цели")]
    #[diagnostic(
        code(strips::no_goal),
        help("добавьте раздел «Целевая позиция: …», в PDDL – «(:goal …)»")
    )]
    NoGoal,

    /// A scenario whose rules know no action.
    #[error("нет ни одного действия")]
    #[diagnostic(
        code(strips::no_actions),
        help("включите файл правил: «Включить: ../service-robot.strips»")
    )]
    NoActions,

    /// A plan names an action that the rules do not have.
    #[error("неизвестное действие «{name}»")]
    #[diagnostic(code(strips::unknown_action))]
    UnknownAction {
        name: String,
        #[help]
        help: Option<Bilingual>,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// A plan has an object where one of another type is due.
    #[error("«{name}» не подходит: здесь должен стоять объект типа «{expected}»")]
    #[diagnostic(code(strips::wrong_object))]
    WrongObject {
        name: String,
        expected: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// An action of a plan whose turn comes too early.
    #[error("действие невыполнимо: не выполнено {fact}")]
    #[diagnostic(code(strips::plan_precondition))]
    PlanPrecondition {
        fact: String,
        #[label("здесь план обрывается")]
        at: SourceSpan,
    },

    /// Two actions of a step that cannot go together.
    #[error("действия одного шага мешают друг другу: из-за {fact} нельзя вместе с «{other}»")]
    #[diagnostic(code(strips::plan_interference), help("разнесите их по разным шагам"))]
    PlanInterference {
        fact: String,
        other: String,
        #[label("здесь план обрывается")]
        at: SourceSpan,
    },

    /// A plan that does not do what it is for.
    #[error("в конце не выполнена цель {fact}")]
    #[diagnostic(code(strips::plan_misses_goal))]
    PlanMissesGoal { fact: String },

    /// Grounding takes more memory than it may.
    #[error("действия правил над этими объектами не помещаются в {megabytes} МиБ памяти")]
    #[diagnostic(
        code(strips::too_many_operators),
        help(
            "добавьте правилам предусловий, связывающих их параметры, или уменьшите число объектов"
        )
    )]
    TooManyOperators { megabytes: usize },

    /// A condition with «or», quantifiers or effects under conditions falls into more cases than anybody plans with.
    #[error("условия в «{of}» распадаются больше чем на {limit} случаев")]
    #[diagnostic(
        code(strips::too_many_cases),
        help(
            "разделите действие на несколько или уменьшите число объектов под «для всех» и «если»"
        )
    )]
    TooManyCases { of: String, limit: usize },

    /// Actions that last: each is planned as one, from its start to its end.
    #[error(
        "действия с длительностью планируются целиком, одно за другим; шаги считаются по ним самим, длительность – стоимость"
    )]
    #[diagnostic(
        severity(Warning),
        code(strips::durations),
        help("план, которому нужно, чтобы одно шло внутри другого, так не находится")
    )]
    Durations {
        #[label("первое такое действие")]
        at: SourceSpan,
    },

    /// What is asked while an action lasts is no plain fact, and its start may touch it.
    #[error(
        "пока действие длится, нужны простые факты: своё начало задевает то, о чём спрашивает условие"
    )]
    #[diagnostic(
        code(strips::lasting_condition),
        help("разделите условие на факты, или спросите его в начале")
    )]
    LastingCompound {
        #[label("здесь")]
        at: SourceSpan,
    },

    /// What a rule derives is stated, or changed by an action.
    #[error(
        "предикат «{name}» выводится правилом, поэтому его нельзя ни утверждать, ни менять действием"
    )]
    #[diagnostic(code(strips::derived_stated), help("уберите это или правило вывода"))]
    DerivedStated {
        name: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// What is derived rests on its own absence.
    #[error("«{name}» выводится из того, что «{name}» не выводится")]
    #[diagnostic(
        code(strips::derived_by_absence),
        help("разорвите круг: отрицание под правилом вывода не должно вести к нему же")
    )]
    DerivedByAbsence {
        name: String,
        #[label("это правило")]
        at: SourceSpan,
    },

    /// A cost is a function's value, and the problem does not give it.
    #[error(
        "задача не говорит, сколько стоит {action}{}: это считается бесплатным",
        if *more == 0 { String::new() } else { format!(" (и ещё действий: {more})") }
    )]
    #[diagnostic(
        severity(Warning),
        code(strips::no_price),
        help("задайте значение в «:init»: (= (функция объект …) число)")
    )]
    NoPrice { action: String, more: usize },
}
