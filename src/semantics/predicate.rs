//! The predicates in which the Map, the rule files and the robot speak of the world.
//!
//! The contract stands at the head of `rules/service-robot.strips`; a rule file that uses these names is
//! understood by the robot, whatever its actions are called.

/// (помещение)
pub const ROBOT_IN: &str = "РОБОТ-НАХОДИТСЯ-В";
/// (дверь)
pub const ROBOT_AT_DOOR: &str = "РОБОТ-НАХОДИТСЯ-У-ДВЕРИ";
/// (место)
pub const ROBOT_AT_PLACE: &str = "РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ";
/// (предмет)
pub const ROBOT_HOLDS: &str = "РОБОТ-ДЕРЖИТ";
/// ()
pub const HAND_FREE: &str = "РУКА-СВОБОДНА";
/// (место, помещение)
pub const PLACE_IN: &str = "ПОЗИЦИЯ_НАХОДИТСЯ-В";
/// (место, объект)
pub const PLACE_BY: &str = "ПОЗИЦИЯ_НАХОДИТСЯ-У";
/// (дверь, помещение)
pub const DOOR_IN: &str = "ДВЕРЬ_НАХОДИТСЯ-В";
/// (дверь, помещение): from there it cannot be opened again once it is shut
pub const NO_RETURN: &str = "ДВЕРЬ-НЕ-ОТКРЫТЬ-ИЗ";
/// (дверь)
pub const DOOR_HAS_LEAF: &str = "ДВЕРЬ_ИМЕЕТ-СТВОРКУ";
/// (дверь, помещение, помещение)
pub const DOOR_OPEN: &str = "ДВЕРЬ_ИЗ_В_ОТКРЫТА";
/// (дверь, помещение, помещение)
pub const DOOR_CLOSED: &str = "ДВЕРЬ_ИЗ_В_ЗАКРЫТА";
/// (дверь, помещение, помещение)
pub const DOOR_LOCKED: &str = "ДВЕРЬ_ИЗ_В_ЗАПЕРТА";
/// (предмет, дверь)
pub const KEY_FITS: &str = "КЛЮЧ_ПОДХОДИТ-К";
/// (человек, дверь)
pub const PERSON_HAS_KEY: &str = "ЧЕЛОВЕК_ИМЕЕТ-КЛЮЧ-ОТ";
/// (предмет, объект)
pub const THING_ON: &str = "ПРЕДМЕТ_НАХОДИТСЯ-НА";
/// (предмет, объект): in what the robot opens and shuts
pub const THING_IN: &str = "ПРЕДМЕТ_НАХОДИТСЯ-В";
/// (объект): what the robot can open and shut stands open
pub const STANDS_OPEN: &str = "ОБЪЕКТ-ОТКРЫТ";
/// (объект)
pub const STANDS_SHUT: &str = "ОБЪЕКТ-ЗАКРЫТ";
/// (предмет, место)
pub const THING_AT_PLACE: &str = "ПРЕДМЕТ_НАХОДИТСЯ-В-ПОЗИЦИИ";
/// (человек, место)
pub const PERSON_AT_PLACE: &str = "ЧЕЛОВЕК_НАХОДИТСЯ-В-ПОЗИЦИИ";
/// (предмет, человек)
pub const HANDED_OVER: &str = "ПРЕДМЕТ_ПЕРЕДАН";
/// (объект)
pub const DEVICE_HAS_BUTTON: &str = "УСТРОЙСТВО-ИМЕЕТ-КНОПКУ";
/// (объект)
pub const DEVICE_ON: &str = "УСТРОЙСТВО-ВКЛЮЧЕНО";
/// (объект)
pub const DEVICE_OFF: &str = "УСТРОЙСТВО-ВЫКЛЮЧЕНО";
/// (помещение)
pub const ROOM_LIT: &str = "ПОМЕЩЕНИЕ-ОСВЕЩЕНО";
/// (объект, помещение)
pub const SWITCH_OF_LIGHT: &str = "ВЫКЛЮЧАТЕЛЬ_УПРАВЛЯЕТ-СВЕТОМ-В";
/// (помещение)
pub const ROOM_INSPECTED: &str = "ПОМЕЩЕНИЕ-ОСМОТРЕНО";
/// (объект, помещение)
pub const MAY_BE_IN: &str = "ПРЕДМЕТ_МОЖЕТ-БЫТЬ-В";
/// (объект)
pub const FOUND: &str = "ПРЕДМЕТ-НАЙДЕН";
/// (предмет, объект)
pub const STORED_ON: &str = "ПРЕДМЕТ_ХРАНИТСЯ-НА";
/// (предмет)
pub const IN_ITS_PLACE: &str = "ПРЕДМЕТ-НА-СВОЁМ-МЕСТЕ";
/// (объект): what is thrown away goes into it
pub const FOR_WASTE: &str = "ОБЪЕКТ-ДЛЯ-МУСОРА";
/// (предмет)
pub const THROWN_AWAY: &str = "ПРЕДМЕТ-ВЫБРОШЕН";
/// (предмет, объект): it proved to have no place there
pub const NO_ROOM: &str = "НЕТ-МЕСТА-НА";
/// (объект): the robot may push it
pub const LIGHT: &str = "ОБЪЕКТ-ЛЁГКИЙ";
/// (объект, дверь, помещение)
pub const BLOCKS_DOOR: &str = "ОБЪЕКТ_ПРЕГРАЖДАЕТ-ДВЕРЬ";
/// (дверь, помещение)
pub const WAY_BLOCKED: &str = "ПОДХОД-К-ДВЕРИ-ПРЕГРАЖДЁН";
/// (человек)
pub const CALLED: &str = "ЧЕЛОВЕК-ПОЗВАН";
/// (этаж)
pub const ROBOT_ON_STOREY: &str = "РОБОТ-НАХОДИТСЯ-НА-ЭТАЖЕ";
/// (помещение, этаж): of every room that is not the cabin of a lift
pub const ROOM_ON_STOREY: &str = "ПОМЕЩЕНИЕ_НАХОДИТСЯ-НА-ЭТАЖЕ";
/// (лифт, помещение): one on each storey at which it stops
pub const LIFT_HAS_CABIN: &str = "ЛИФТ_ИМЕЕТ-КАБИНУ";
/// (лифт, дверь)
pub const LIFT_HAS_DOOR: &str = "ЛИФТ_ИМЕЕТ-ДВЕРЬ";
/// (лифт)
pub const LIFT_WORKS: &str = "ЛИФТ-РАБОТАЕТ";
/// (лифт, дверь)
pub const CABIN_AT: &str = "КАБИНА_СТОИТ-У";
