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

# Слова и обороты, из которых складывается сказанное.

an-integer-in-quotation-marks = целое число в кавычках
choices-of-a-rule = вариантов у правила
premises-of-a-rule = посылок у правила
choices-of-a-question = вариантов у вопроса
columns-of-the-answer = столбцов ответа
premises-of-a-question = посылок у вопроса
between-values-of-the-type = { $sign } между значениями типа { $kind }
records-are-compared-for-equality-only = записи сравнивают только на равенство
choices-of-an-aggregate = вариантов у счёта
the-component-within-itself = компонент «{ $text }» внутри самого себя
break-the-circle-a-component-neither-inherits = разорвите круг: компонент не наследует себя и не создаёт себя
components-within-one-another = компонентов друг в друге
override-the-components-inherited-from-have-no = .override { $text }: у наследуемых компонентов нет такого отношения
override-the-relation-is-not-declared-overridable = .override { $text }: отношение не объявлено overridable
relations-of-the-components-inherited-from-are = заменяют отношения наследуемых компонентов, объявленные overridable
fields-of-a-record = полей записи
choice-domain-without-such-a-column = choice-domain «{ $text }» без такого столбца
name-columns-of-this-relation = назовите столбцы этого отношения
a-subtype-of-the-record-or-union = подтип «{ $text }» записи или объединения «{ $text2 }»
symbol-number-unsigned-float-and-their-subtypes = подтип бывает у symbol, number, unsigned, float и их подтипов; второе имя даёт «=»
columns-of-a-relation = столбцов отношения
no = нет
comparison = сравнение
numbers-in-order = числа по порядку
aggregate = счёт
new-rows = новые строки
earlier-rows = прежние строки
all-rows = все строки
n-1-row = строк 1
rows = строк { $len }
levels-of-an-expression = глубина выражения
operations-in-a-row = действий подряд
a-function-of-functor = функция из .functor
foreign-code-is-not-run-here-compute = чужой код здесь не выполняется: посчитайте её заранее и дайте таблицей фактов
a-value = значение
the-function = функция «{ $text }»
there-are-arithmetic-autoinc-cat-strlen-substr = есть арифметика, autoinc, cat, strlen, substr, range, to_string, to_number, to_unsigned, to_float, ord, as, min, max, битовые и логические действия
make-a-column-that-counts-steps = заведите столбец, который считает шаги
is-always-empty = «{ $name }» всегда пусто
the-comparison-is-always-false = сравнение всегда ложно
the-comparisons-exclude-each-other = сравнения исключают друг друга
another-premise-states-the-same = то же утверждает другая посылка
the-inline-relation-that-reads-itself = inline-отношение «{ $name }», которое читает само себя
remove-inline-and-bind-the-variables-of = уберите inline и свяжите переменные его правил
the-negation-of-the-inline-relation-with = отрицание inline-отношения «{ $name }» с переменными, которых нет в голове
a-record = запись
the-comment = комментарий
means-nothing-in-a-text = «\{ $letter }» в тексте ничего не значит
a-text-in-quotation-marks = текст в кавычках
the-closing-quotation-mark-on-the-same = закрывающую кавычку в той же строке
levels-of-brackets = вложенность скобок
what-a-rule-derives-can-be-counted = считать можно то, что выводит правило
autoinc-in-a-fact = autoinc() в факте
plan-the-order-does-not-name-every = .plan { $version }: порядок называет не все посылки правила по разу
list-the-numbers-of-all-relations-of = перечислите номера всех отношений тела, с 1
plan-the-rule-has-recursive-premises = .plan { $version }: у правила рекурсивных посылок { $versions }
versions-are-numbered-from-0-one-a = версии нумеруются с 0, по одной на рекурсивную посылку
remove-inline-the-relation-will-be-derived = уберите inline: отношение будет выведено как все
the-inline-relation-is-read-from-a = inline-отношение «{ $text }» читается из файла или выводится
the-inline-relation-reads-itself = inline-отношение «{ $text }» читает само себя
autoinc-in-an-inline-relation = autoinc() в inline-отношении
an-aggregate-over-the-inline-relation = счёт по inline-отношению «{ $name }»
autoinc-among-the-arguments-of-the-inline = autoinc() среди аргументов inline-отношения «{ $name }»
in-the-negation-of-the-inline-relation = «_» в отрицании inline-отношения «{ $name }»
a-search-that-goes-back = «{ $pattern }»: поиск с возвратами
do-without-1-and-they-cannot-be = обойдитесь без \1 и (?=…): они не решаются за линейное время
as-from-to = as из { $from } в { $to }
there-are-to-number-to-float-and = есть to_number, to_float и to_string
foreign-code-is-not-run-here-compute-2 = чужой код здесь не выполняется: посчитайте значения заранее и дайте их таблицей фактов
a-rule = правило
override-outside-of-a-component = .override вне компонента
replace-rules-within-a-comp-that-inherits = замените правила внутри .comp, который наследует другой
the-rounds-of-evaluation-are-not-kept = витки вычисления не хранятся: уберите эту строку
the-property-beside-what-is-said-already = свойство { $text } при том, что уже сказано
one-word-of-btree-brie-eqrel-btree = одно слово из btree, brie, eqrel, btree_delete и каждое другое по разу
btree-delete-of-a-relation-without-columns = btree_delete у отношения без столбцов
it-has-no-two-rows-of-which = в нём нет двух строк, чтобы одна вытеснила другую
a-declaration-or-a-rule = объявление или правило
the-greatest-can-be-kept-by-subsumption = оставить наибольшее можно вытеснением: r(x, a) <= r(x, b) :- a < b.
remove-this-word-relations-are-all-kept = уберите это слово: отношения хранятся одинаково
the-property = свойство { $word }
a-premise = посылка
a-relation = отношение
cs-preprocessor = препроцессор C: «#{ $line }»
there-are-define-undef-ifdef-ifndef-if = есть #define, #undef, #ifdef, #ifndef, #if, #elif, #else, #endif, #line и #include
the-preprocessors-condition = условие препроцессора «{ $trim }»
there-are-numbers-names-defined-and-brackets = есть числа, имена, defined, ! && || == != < <= > >= + - * / % и скобки
a-definition-in-which-not-all-is = определение, в котором не всё – слова языка
check-the-text-after-the-name = проверьте текст за именем
a-name = имя
define-without-a-name = #define без имени
substitutions-of-define = подстановок #define
a-question-of-the-inline-relation = вопрос об inline-отношении «{ $name }»
remove-inline-such-a-relation-has-no = уберите inline: у такого отношения нет своих строк
choice-domain-autoinc-or-limitsize-in-a = choice-domain, autoinc или limitsize в вопросе
put-such-a-relation-into-the-program = поставьте такое отношение в программу: там оно выводится целиком
such-a-directive-in-a-question = такая директива в вопросе
decl-type-rules-and-facts-serve-in = в вопросе годятся .decl, .type, правила и факты
a-rule-of-the-question-for-the = правило вопроса для отношения программы «{ $text }»
declare-a-relation-of-its-own-in = объявите в вопросе своё отношение: .decl
the-end-of-the-question = конец вопроса
the-end-of-the-text = конец текста
the-number = число { $number }
a-rule-a-fact-or-a-declaration = правило, факт или объявление
attempts-to-read-one-rule = попыток прочесть одно правило
a-number = число
a-comparison = сравнение
an-operation = действие
autoinc-in-a-recursive-rule = autoinc() в рекурсивном правиле
number-the-finished-relation-in-a-rule = пронумеруйте готовое отношение отдельным правилом
rows-of-one-relation-subsume-each-other = поглощают друг друга строки одного отношения
columns-of-a-relation-with-subsumption = столбцов отношения с поглощением
include-in-a-text-that-has-no = .include "{ $path }" в тексте, у которого нет папки
give-the-rule-texts-together-as-one = дайте тексты правил вместе, одной программой
order-clause = «.order»
limit-clause = «.limit»
end-of-comment = «*/»
escapes-of-a-text = есть \" \' \\ \n \t \r \a \b \f \v; сама обратная черта пишется дважды
closing-brace = «{"}"}»
sign-of-equality = «=»
directive-if = #if
directive-endif = #endif
relation-by = { $name } по { $key }
relation-in-part = { $relation }: { $part }
or = {" или "}
not = {"не "}

facts-no-decimal = не десятичная дробь с шестью знаками после точки
and = {" и "}
see-above = см. выше
filtered-by-a-comparison = , отбор сравнением
rule-took = { $milliseconds } мс  { $relation }  { $place }  запусков { $runs }, найдено { $found }
