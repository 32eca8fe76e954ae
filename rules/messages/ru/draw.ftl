# Чего нет рисунка.

draw-svg = рисунок не читается как SVG: { $message }
    .help = передайте SVG, который построила эта программа
draw-size = картинка { $width }×{ $height } точек не помещается в память
    .help = уменьшите ширину: --width 2000

# Что написано на рисунках.

facade = Фасад
profile = Профиль
plan = План
dimensions-in-centimetres = Размеры в сантиметрах
metres = { $number } м
square-metres = { $number } м²
view = Вид. { $room }: ({ $x }; { $y }) { UNIT() }, курс { $heading }°, глаз на высоте { $height }, угол обзора { $field }°

# Условные знаки.

wall = стена
window = окно
passage = проём, проход
stairs = ступени
lift = лифт: крест
place = место
vertex = вершина сети Пассфреймов
edge = переход между Пассфреймами
doorway-edge = переход через проём
doorway = проём
robot = робот
route = маршрут
start = начало
goal = цель
badge = номер директивы
fixed = мебель
movable = подвижное
portable = переносное
overhead = под потолком
passframe = Пассфреймы
dead-zone = мёртвые зоны
sight = обозреваемый пол
seen = видимые грани
door = дверь
swing = ход створки
locked = заперто
keep-out = запретная зона
closed = закрытая зона
slow = медленная зона
one-way = односторонняя зона
