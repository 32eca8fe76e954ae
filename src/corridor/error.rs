//! What can be wrong with a question about the way.

use miette::Diagnostic;
use thiserror::Error;

use crate::units::Bilingual;

/// Why there are no directions.
#[derive(Debug, Clone, PartialEq, Eq, Error, Diagnostic)]
#[non_exhaustive]
pub enum CorridorError {
    #[error("неизвестное помещение «{room}»: в коридоры не выходит вход с таким именем")]
    #[diagnostic(code(corridor::unknown_room), help("{hint}"))]
    UnknownRoom { room: String, hint: Bilingual },

    #[error("вершины {vertex} в системе коридоров нет")]
    #[diagnostic(code(corridor::unknown_vertex), help("вершины нумеруются так: {known}"))]
    UnknownVertex { vertex: String, known: String },

    #[error("у помещения «{room}» несколько входов: вершины {vertices}")]
    #[diagnostic(
        code(corridor::several_entrances),
        help("укажите вершину (например, #{example}) или последнюю пройденную дугу")
    )]
    SeveralEntrances { room: String, vertices: String, example: u32 },

    #[error("дуги ({from}, {to}) в графе нет")]
    #[diagnostic(
        code(corridor::unknown_arc),
        help("последняя дуга ведёт в вершину {to} из соседней с ней: {neighbours}")
    )]
    UnknownArc { from: u32, to: u32, neighbours: String },

    #[error(
        "робот не может стоять в вершине {vertex}, если последней пройдена дуга ({from}, {to})"
    )]
    #[diagnostic(
        code(corridor::last_arc_elsewhere),
        help(
            "последняя дуга должна вести в вершину {vertex}; если курс неизвестен, не указывайте её"
        )
    )]
    LastArcElsewhere { vertex: u32, from: u32, to: u32 },

    #[error("из «{from}» нельзя проехать по коридорам в «{to}»")]
    #[diagnostic(code(corridor::unreachable), help("{hint}"))]
    Unreachable { from: String, to: String, hint: Bilingual },

    #[error("вершина {vertex} – соединение коридоров: во втором варианте графа такой вершины нет")]
    #[diagnostic(code(corridor::at_junction), help("начните от входа или возьмите первый вариант"))]
    AtJunction { vertex: u32 },

    #[error("вершина {vertex} – соединение коридоров: без курса не сказать, куда повернуть")]
    #[diagnostic(code(corridor::heading_needed), help("укажите последнюю пройденную дугу"))]
    HeadingNeeded { vertex: u32 },

    #[error("цель – вершина {vertex}, а это соединение коридоров, не вход")]
    #[diagnostic(code(corridor::goal_is_junction), help("назовите помещение или вершину входа"))]
    GoalIsJunction { vertex: u32 },

    #[error("длина участка ({from}, {to}) неизвестна, а путь надо мерить в метрах")]
    #[diagnostic(
        code(corridor::no_length),
        help("укажите metres у всех участков или measure = \"arcs\"")
    )]
    NoLength { from: u32, to: u32 },

    #[error("карты с номером {map} в мире нет")]
    #[diagnostic(code(corridor::unknown_map))]
    UnknownMap { map: u32 },

    #[error("на карте «{name}» нет коридоров")]
    #[diagnostic(
        code(corridor::no_corridors),
        help("дайте коридорам тип помещения с признаком corridor, например «Коридор»")
    )]
    NoCorridors { name: String },
}
