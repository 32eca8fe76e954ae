# Что не так с описанием коридоров и с вопросами о пути.

corridor-file = описание коридоров не принято, ошибок: { $count }
corridor-file-help = исправьте отмеченные места

corridor-unknown-room = неизвестное помещение «{ $room }»: в коридоры не выходит вход с таким именем
    .help = { $hint }
corridor-unknown-vertex = вершины { $vertex } в системе коридоров нет
    .help = вершины нумеруются так: { $known }
corridor-several-entrances = у помещения «{ $room }» несколько входов: вершины { $vertices }
    .help = укажите вершину (например, #{ $example }) или последнюю пройденную дугу
corridor-unknown-arc = дуги ({ $from }, { $to }) в графе нет
    .help = последняя дуга ведёт в вершину { $to } из соседней с ней: { $neighbours }
corridor-last-arc-elsewhere = робот не может стоять в вершине { $vertex }, если последней пройдена дуга ({ $from }, { $to })
    .help = последняя дуга должна вести в вершину { $vertex }; если курс неизвестен, не указывайте её
corridor-unreachable = из «{ $from }» нельзя проехать по коридорам в «{ $to }»
    .help = { $hint }
corridor-at-junction = вершина { $vertex } – соединение коридоров: во втором варианте графа такой вершины нет
    .help = начните от входа или возьмите первый вариант
corridor-heading-needed = вершина { $vertex } – соединение коридоров: без курса не сказать, куда повернуть
    .help = укажите последнюю пройденную дугу
corridor-goal-is-junction = цель – вершина { $vertex }, а это соединение коридоров, не вход
    .help = назовите помещение или вершину входа
corridor-no-length = длина участка ({ $from }, { $to }) неизвестна, а путь надо мерить в метрах
    .help = укажите metres у всех участков или measure = "arcs"
corridor-unknown-map = карты с номером { $map } в мире нет
corridor-no-corridors = на карте «{ $name }» нет коридоров
    .help = дайте коридорам тип помещения с признаком corridor, например «Коридор»

corridor-syntax = текст не читается как TOML: { $message }
    .help = образец: maps/corridor-paper4.toml
corridor-notation = это не файл коридоров: текст начинается как JSON, а файл коридоров – TOML
    .help = образец: maps/corridor-paper4.toml; по карте ходят так: ortho corridor --map ФАЙЛ
corridor-unknown-field = неизвестное поле «{ $field }»
    .help = { $hint }
    .at = это поле
corridor-missing-field = не хватает поля «{ $field }»
    .help = { $hint }
corridor-wrong-value = поле «{ $field }»: нужно { $expected }
    .help = исправьте значение
    .at = это значение
corridor-unknown-format = формат { $found } неизвестен
    .help = эта версия программы читает format = 1
    .at = этот номер
corridor-empty = в описании нет ни одного коридора
    .help = добавьте [[corridor]] со списком along
corridor-room-and-junction = вершина { $vertex } – и вход, и соединение коридоров
    .help = оставьте room с side или junction; у разных мест – разные номера вершин
corridor-repeated-entrance = вход { $vertex } уже стоит в другом месте
    .help = каждый вход описывается один раз; общей у двух коридоров бывает только вершина соединения
    .at = второй раз здесь
    .first = первый раз здесь
corridor-undeclared-vertex = у вершины { $vertex } нигде не сказано, вход это или какое соединение коридоров
    .help = укажите room и side (вход) или junction (вид соединения) хотя бы в одном коридоре
corridor-vertex-meets-itself = вершина { $vertex } стоит в списке дважды подряд
    .help = уберите повторение; кольцо замыкает closed = true
    .at = второй раз здесь
corridor-ahead-not-at-end = дверь вершины { $vertex } стоит прямо (ahead), но коридор за ней продолжается
    .help = прямо бывает только дверь в торце тупика: первая или последняя в списке
    .at = эта сторона
corridor-junction-without-approach = к соединению { $vertex } не ведёт ни один участок этого коридора
    .help = вид соединения описывается так, как его видно с этого коридора: добавьте соседнюю вершину
corridor-no-such-way = соединение { $vertex }: вид «{ $kind }» не имеет пути { $way }
    .help = пути этого вида: { $ways }
    .at = этот путь
corridor-no-such-neighbour = соединение { $vertex }: соседа { $neighbour } у него нет или к нему ведут несколько коридоров
    .help = соседи по описанию: { $neighbours }
    .at = этот сосед
corridor-arms-disagree = соединение { $vertex }: вид «{ $kind }» требует коридоров: { $wanted }, а описано: { $found } (соседи { $neighbours })
    .help = исправьте вид, допишите коридор или отметьте пустой путь: blind = ["right"]
    .at = этот вид
corridor-ambiguous-arms = соединение { $vertex }: не ясно, какой коридор куда ведёт (соседи { $neighbours })
    .help = назовите соседей, как их видно с этого коридора: straight = …, right = …, left = …
    .at = это соединение
corridor-junction-disagrees = соединение { $vertex }: здесь сказано «{ $said }», а по описанию другого коридора отсюда видно «{ $seen }»
    .help = одно и то же соединение с разных сторон выглядит по-разному; исправьте одно из описаний
    .at = это описание
    .first = другое описание
corridor-way-disagrees = соединение { $vertex }: путь { $way } ведёт отсюда к «{ $said }», а по описанию другого коридора – к «{ $seen }»
    .help = исправьте одно из описаний
    .at = этот путь

# Слова и обороты, из которых складывается сказанное.

a-dead-end = тупик
perhaps-2 = может быть, «{ $near }»?
the-description-has-no-entrance = в описании нет ни одного входа
there-are-entrances = есть входы: { $known }
is-on-on-a-lift-is-needed = «{ $from }» – на «{ $floor }», «{ $to }» – на «{ $other }»: нужен лифт
their-corridors-are-not-joined = их коридоры не соединены
in-the-first-line-format-1 = первой строкой: format = 1
a-number-from-0-to-1000000 = число от 0 до 1000000
tables-corridor = таблицы [[corridor]]
true-or-false = true или false
an-entry-like-vertex-0 = запись вида {"{"} vertex = 0, … {"}"}
a-positive-number-of-metres = положительное число метров
the-vertexs-number-such-as-vertex-7 = номер вершины, например vertex = 7
an-integer-from-0-to-4294967295 = целое число от 0 до 4294967295
on-which-side-the-door-is-side = с какой стороны дверь: side = "right" или "left"
which-room-is-behind-the-door-room = какое помещение за дверью: room = "201"
the-kind-of-the-junction-junction-branch = вид соединения: junction = "branch-right"
here-there-may-be = здесь бывают: { $known }
a-list = список [ … ]
a-text-in-quotation-marks-not-empty = непустая строка в кавычках
an-integer = целое число
one-of-the-words = одно из слов: { $words }
at-the-goal = Робот уже у цели.
no-numbers = нет

# Чем едут по коридору: как указание в таблице и как предложение.

face-right = встать вдоль коридора, чтобы дверь была справа
face-left = встать вдоль коридора, чтобы дверь была слева
face-ahead = встать спиной к двери
to-junction = движение до соединения коридоров
take-straight = движение прямо
take-right = поворот направо
take-left = поворот налево
take-nth = поворот { $n ->
        [2] во
       *[other] в
    } { $nth }-й коридор, считая справа
to-door-right = движение до двери справа
to-door-left = движение до двери слева
to-door-ahead = движение до двери прямо
u-turn = разворот
stand-right = Встаньте вдоль коридора, чтобы дверь была справа.
stand-left = Встаньте вдоль коридора, чтобы дверь была слева.
stand-ahead = Встаньте спиной к двери.
drive-to-junction = Проезжайте до соединения коридоров.
drive-past-entrances = Проезжайте мимо { $passed } { $passed ->
        [one] входа
       *[other] входов
    } до соединения коридоров.
drive-to-entrance = Проезжайте до { $nth }-го входа, дверь { $side ->
        [right] справа
        [left] слева
       *[ahead] прямо
    }.
go-straight = Двигайтесь прямо.
turn-right = Поверните направо.
turn-left = Поверните налево.
turn-nth = Сверните { $n ->
        [2] во
       *[other] в
    } { $nth }-й коридор, считая справа.
make-u-turn = Развернитесь.

# Как зовётся вход, у которого нет ни двери, ни имени.

exit = Выход
