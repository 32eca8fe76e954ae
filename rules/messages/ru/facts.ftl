# Что не так с правилами, фактами и вопросами к ним.

facts-in-file = «{ $name }»: { $errors ->
        [0] предупреждений { $warnings }
       *[other] ошибок { $errors }{ $warnings ->
            [0] {""}
           *[other] , предупреждений { $warnings }
        }
    }
facts-faults = ошибок в правилах: { $count }; первая – { $first }

facts-syntax = здесь ожидается { $expected }, а стоит { $found }
facts-character = символ «{ $character }» здесь ничего не значит
    .help = строки пишутся в двойных кавычках
facts-unclosed = { $what } не закрыт
    .help = поставьте { $closing }
    .at = открыт здесь
facts-number = число «{ $text }» не помещается в 64 бита
facts-unsupported = не поддерживается: { $what }
facts-misuse = { $what }
facts-too-large = { $what }: больше { $limit }
    .help = разбейте на несколько правил или отношений
facts-duplicate = «{ $name }» объявлено дважды
    .help = оставьте одно объявление
    .at = второе объявление
facts-unknown-relation = неизвестное отношение «{ $name }»
    .help = { GIVEN($nearest) ->
        [yes] может быть, «{ $nearest }»?
       *[no] объявите его: .decl
    }
facts-unknown-type = неизвестный тип «{ $name }»
    .help = { GIVEN($nearest) ->
        [yes] может быть, «{ $nearest }»?
       *[no] есть symbol, number, unsigned и объявленные: .type
    }
facts-unknown-component = неизвестный компонент «{ $name }»
    .help = { GIVEN($nearest) ->
        [yes] может быть, «{ $nearest }»?
       *[no] опишите его: .comp
    }
facts-record = у записи здесь нет известного типа: { $what }
    .help = тип даёт столбец отношения, имя варианта ($Имя) или as([…], Тип)
facts-hint = { $what }: подсказка здесь ни на что не влияет
    .help = итог программы от неё не зависит
facts-wide = число { $number } не помещается в 32 бита: Soufflé посчитает с ним иначе
    .help = здесь числа 64-битные и не переполняются молча
facts-rounded = число { $number } округлено до шести знаков: двоичная дробь Soufflé чуть другая
    .help = float здесь – точная десятичная дробь в миллионных долях
facts-long-text = текст длиннее { $limit } байт не хранится: строки с ним пропущены
    .help = рекурсивное правило с cat растит текст без конца; ограничьте его: strlen(x) < 1000
facts-pattern = «{ $pattern }» – не регулярное выражение: ничто ему не отвечает
    .help = { $why }
facts-unsigned = число «{ $text }» не помещается в 32 бита без знака
    .help = unsigned – от 0 до 4294967295
facts-arity = у «{ $name }» аргументов { $expected }, а дано { $found }
    .help = сверьтесь с объявлением «{ $name }»
    .at = дано { $found }
facts-types = «{ $what }»: нужен тип { $expected }, а здесь { $found }
    .help = числа пишутся без кавычек, строки — в кавычках; to_number и to_string переводят
    .at = тип { $found }
facts-ungrounded = переменная «{ $variable }» ничем не связана
    .help = назовите её в утвердительной посылке правила или приравняйте к известному
    .at = нет значения
facts-wildcard = «_» стоит там, где нужно значение
    .help = «_» годится только в посылках, на месте аргумента
facts-cycle = отношение зависит от собственного отрицания или счёта: { $cycle }
    .help = разорвите круг: отрицать и считать можно только выведенное раньше
    .at = эта посылка замыкает круг
facts-never-used = отношение «{ $name }» нигде не используется
    .help = покажите его наружу: .output { $name }
    .at = объявлено здесь
facts-never-derived = отношение «{ $name }» всегда пусто: его ничто не выводит
    .help = допишите правило или .input { $name }
    .at = объявлено здесь
facts-never-fires = правило никогда не сработает: { $why }
    .help = проверьте эту посылку
    .at = эта посылка не выполняется
facts-product = посылки «{ $one }» и «{ $other }» ничем не связаны: перебираются все пары
    .help = дайте им общую переменную или сравнение; если все пары и нужны, оставьте так
facts-single-variable = переменная «{ $variable }» встречается один раз
    .help = если так и задумано, пишите «_»

facts-fact-unknown-relation = неизвестное отношение «{ $name }»
    .help = { GIVEN($nearest) ->
        [yes] может быть, «{ $nearest }»?
       *[no] объявите его в файле правил: .decl
    }
facts-fact-arity = у «{ $relation }» столбцов { $expected }, а дано значений { $found }
    .help = сверьтесь с объявлением «{ $relation }»
facts-fact-types = «{ $relation }», столбец «{ $column }»: нужен тип { $expected }, а дано «{ $found }»
    .help = сверьтесь с объявлением «{ $relation }»

facts-too-many = { $rule }: отношение «{ $relation }» больше { $limit } строк
    .help = правило, видимо, порождает новое без конца; ограничьте числа в нём сравнением, задайте .limitsize или дайте больше строк (--row-limit)
facts-time = { $rule }: за { $seconds } с отношение «{ $relation }» не выведено, строк пока { $rows }
    .help = правило, видимо, порождает новое без конца: ограничьте в нём числа сравнением; или дайте больше времени (--time-limit)
facts-memory = { $rule }: отношение «{ $relation }» не помещается в { $megabytes } МиБ памяти, строк пока { $rows }
    .help = свяжите посылки правила общими переменными или ограничьте его сравнением; или дайте больше памяти (--memory-limit)
facts-stopped = { $rule }: отношение «{ $relation }» не выведено: остановлено

facts-not-known = { $place }отношение «{ $relation }» вычисляется, когда известны { $needs }
    .help = свяжите эти столбцы другими посылками или назовите их значения
facts-too-deep = «{ $relation }» зависит от слишком длинной цепочки отношений
    .help = выведите часть цепочки заранее

facts-file = { $path }: { $cause }
    .help = проверьте имя и права: факты отношения r читаются из r.facts, папка для вывода должна уже быть
facts-line = { $path }:{ $line }: { $cause }
    .help = значения разделяются табуляцией, по одному на столбец
facts-parameter = «{ $relation }»: не поддерживается { $name }={ $value }
    .help = есть IO=file, для .input IO=stdin, для .output IO=stdout, filename, delimiter, headers, rfc4180, для .input columns="1:0"
