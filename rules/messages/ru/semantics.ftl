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

# Слова и обороты, из которых складывается сказанное.

a-length-in-tenths-of-a-millimetre = длина в десятых долях миллиметра, от 0 до 1000000 (100 м)
an-angle-in-hundredths-of-a-degree = угол в сотых долях градуса, от 0 до 18000
a-share-in-thousandths-from-0-to = доля в тысячных, от 0 до 1000
a-number-of-times-from-1-to = число раз, от 1 до 1000
a-solid-angle-in-millionths-of-a = телесный угол в миллионных долях стерадиана, от 0 до 12566370
there-is-no-profile = нет профиля «{ $profile }»
there-are-common-surveyed-and-detected = бывают common, surveyed и detected
the-threshold-cannot-be = порог «{ $name }» не может быть { $value }
the-threshold-is-given-twice-and = порог «{ $name }» назван дважды: { $first } и { $value }
keep-one-here-or = оставьте один: здесь или { $place }
the-limit-of-measuring-cannot-be = предел измерения «{ $name }» не может быть { $value }
it-is = это { $what }
semantics-threshold = { $message }
