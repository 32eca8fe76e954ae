# Что говорят все части программы одинаково.

here = здесь
and-here = и здесь

# После слова, которое неизвестно.
perhaps = { GIVEN($nearest) ->
        [yes] ; может быть, «{ $nearest }»?
       *[no] {""}
    }

# Между именами, которые стоят в одних кавычках.
between-names = », «

# Почему файл не прочитан.

file-too-large = слишком велик: байт не меньше { $bytes }, предел { $limit }
file-silent = ничего не приходит уже { $seconds } с
file-not-text = не текст в UTF-8: байт { $at }

# Почему число не длина и не угол, а слова – не время.

number-not-finite = число должно быть конечным, а не { $value }
length-too-large = длина { $length } больше предела ±{ $limit }
not-a-time = время пишется так: 2026-11-21T09:30:00.000Z

# Как называются тексты, которые не файлы.

own-order = задание
own-edit = правка
own-assumption = предположение
own-measurements = измерения (встроенные)
own-relations = rules/relations.dl (встроенный)

# Единицы.

cm = см
m = м
a-second = { $length }/с
