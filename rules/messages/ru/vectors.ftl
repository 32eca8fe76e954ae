# Что не так с журналом сканов, с датчиком, с картинкой.

vectors-log = журнал прочитан не весь, ошибок: { $count }
vectors-log-help = остальные строки прочитаны

vectors-log-unknown = формат журнала не узнан
    .help = ожидается журнал CARMEN (FLASER, ROBOTLASER1), таблица дальностей с заголовком или строки чисел BreezySLAM
    .at = первая строка
vectors-log-empty = в журнале нет ни одного скана
    .help = сканы – это строки FLASER, ROBOTLASER1 или RAWLASER1
    .at = журнал начинается здесь
vectors-log-not-number = «{ $found }» – не число
    .help = здесь стоит число, дробная часть – после точки; между «;» и табуляциями годится и запятая
    .at = это слово
vectors-log-no-place = «{ $found }» – не место
    .help = координата позы – конечное число, меньше 10⁷ м или рад
    .at = это число
vectors-log-beams = число лучей «{ $found }» невозможно
    .help = целое число от 0 до 65536
    .at = число лучей
vectors-log-field = { $count } лучей: какое поле зрения, журнал не говорит
    .help = укажите шаг в градусах строкой «PARAM laser_front_laser_resolution 0.25»
    .at = эта строка
vectors-log-cut = строка обрывается: есть слов { $found }, нужно { $needed }
    .help = допишите строку или удалите её
    .at = здесь конец строки
vectors-log-too-long = в строке слов { $found }, а должно быть { $needed }
    .help = лишнее удалите; слились две строки – разделите их
    .at = отсюда лишнее
vectors-log-no-message = «{ $found }» – не сообщение журнала
    .help = строка журнала CARMEN начинается именем сообщения; обрывок строки удалите
    .at = начало строки
vectors-log-column-twice = столбец «{ $column }» назван дважды
    .help = оставьте один из двух
    .at = второй раз
vectors-log-unit = единица столбца «{ $found }» не узнана
    .help = длины – m, cm или mm, углы – rad или deg, время – s, ms, us или ns
    .at = этот столбец
vectors-log-heading = в заголовке нет столбца «{ $column }»
    .help = заголовок: angle_min, angle_increment, range_min, range_max, затем ranges0, ranges1, …; угол в рад, длина в м
    .at = заголовок
vectors-log-sensor = датчик невозможен: { $fault }
    .help = исправьте углы и дальности этой строки
    .at = эта строка

vectors-sensor-field = { $count } лучей через { $step } рад от { $first } рад – это не поле зрения
    .help = шаг больше нуля, лучей от 0 до 65536, вместе не больше полного оборота
vectors-sensor-reach = дальность от { LENGTH($nearest, places: 2) } до { LENGTH($farthest, places: 2) } невозможна
    .help = 0 ≤ ближняя < дальняя ≤ 100 000 см
vectors-sensor-noise = погрешность { $it0 } невозможна
    .help = дальность: больше 0 см; доля и угол: от 0

vectors-picture-size = картинка { $width }×{ $height } не складывается из { $pixels } точек
    .help = точек должно быть ширина × высота, сторона не длиннее 16384
vectors-picture-file = картинка не читается: { $reason }
    .help = нужен целый файл PNG
