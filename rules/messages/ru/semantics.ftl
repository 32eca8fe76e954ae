# Почему нет отношений.

semantics-unreadable = не удалось прочесть файл правил «{ $path }»: { $message }
    .help = проверьте путь и права доступа; файл должен быть в UTF-8
semantics-too-large = файл правил «{ $path }» слишком велик: { $bytes } байт, предел { $limit }
    .help = правила – это текст, написанный человеком; проверьте, тот ли это файл
semantics-empty = файл правил «{ $path }» пуст
    .help = уберите его, и будут действовать правила, которые есть в самой программе
semantics-schema = { $fault }
    .help = измеряемые отношения объявлены в rules/relations.dl, раздел «Измерения»; их столбцы менять нельзя
semantics-thresholds = { $first }
semantics-unknown-relation = нет отношения «{ $name }»
    .help = { GIVEN($nearest) ->
        [yes] может быть, «{ $nearest }»?
       *[no] имена отношений стоят в rules/relations.dl
    }
