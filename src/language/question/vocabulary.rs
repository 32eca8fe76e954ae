//! The words of questions in both languages, and what each does in a sentence.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::mark::{Mark, Pronoun};
use super::query::{Closeness, Dimension, Extreme, Rel};
use super::uses;
use crate::report::Detail;
use crate::units::name_key;

const WORDS: &[(Mark, &str)] = &[
    (
        Mark::Where,
        "where would you look for|where would you look|where should i look|where would one look|where would i look|где бы мне найти|где мне найти|где бы найти|где бы взять|где бы мне взять|где мне взять|куда я мог положить|куда я могла положить|куда я мог деть|куда я положил|куда я положила|куда я дел|куда я дела|куда подевался|куда подевалась|куда пропал|куда пропала|куда запропастился|куда запропастилась|where could i have put|where could i have left|where might i have left|where have i put|where have i left|помоги найти|помоги мне найти|помогите найти|помогите мне найти|help me find|не могу найти|никак не найду|не нахожу|потерял|потеряла|потеряли|ищу|я не могу найти|i can t find|i cannot find|i can not find|can t find|cannot find|i lost|i have lost|any idea where|do you happen to know where|где|где же|где именно|в каком месте|куда делся|куда делась|куда делось|куда делись|куда пропал|куда пропала|куда пропали|где мне найти|\
        где найти|где можно найти|где взять|покажи где|скажи где|не знаешь где|подскажи где|where|where s|whereabouts|where abouts|\
        where can i find|where do i find|where should i look for|where do i look for|where can i look for|where must i look for|where to look for|where should we look for|where could i find|where to find|where can we find|where would i find|\
        do you know where|can you tell me where|tell me where|show me where|in what place|what is the location of|\
        what s the location of|the location of|location of|местоположение|местонахождение|укажи местоположение|в каком углу",
    ),
    (
        Mark::What,
        "what can i use to|what could i use to|what should i use to|what do you use to|what do i use to|что|чего|чему|чём|что же|что именно|what|what s|whats|what all|tell me what|скажи что|which things",
    ),
    (
        Mark::Anything,
        "anything|something|nothing|что нибудь|что либо|чему нибудь|чему либо|чём нибудь|чём либо|чего нибудь|что то|чего либо|ничего|ничто",
    ),
    (
        Mark::Kinds,
        "kinds of|types of|sorts of|виды|видов|вида|видами|типы|типов|сорта|сортов|разновидности|разновидностей",
    ),
    (Mark::Hang, "висит|висят|висел|висела|висели|развешано|развешены|hang|hangs|hanging|hung"),
    (
        Mark::Opens,
        "открыть|отпереть|отомкнуть|to open|to unlock|открывает|отпирает|открывается|отпирается|подходит|подойдёт|от чего|opens|unlocks|unlock|is for|fits",
    ),
    (Mark::Whither, "куда|куда же|where to"),
    (Mark::How, "как|how|каким образом"),
    (
        Mark::Move,
        "идти|ехать|пройти мне|проходить|прохожу|проеду|проезжаю|pass|подняться|спуститься|покинуть|попасть|проехать|пройти|добраться|доехать|дойти|выйти|перейти|выехать|переехать|подъехать|доберусь|попаду|доберёшься|проедешь|доедешь|get|enter|reach|reached|be reached|accessible|drive|walk|travel|come|move|navigate|get there",
    ),
    (Mark::As, "as|что и|как и|с чем"),
    (
        Mark::Which,
        "который из|которая из|которое из|которые из|котором из|которой из|каком из|каких из|каким из|какой именно|какой|какая|какое|какие|какого|каком|какую|каких|каким|какому|какими|какою|который|которая|которое|которые|которой|которого|котором|\
        которую|которых|каков|какова|каково|каковы|какие из|какой из|какая из|какое из|какую из|каких из|which|what kind of|what type of|what sort of|which of|which of the",
    ),
    (
        Mark::HowMany,
        "скока|скок|сколька|на сколько|насколько|на сколько сантиметров|на сколько метров|на сколько см|на сколько квадратных метров|by how much|сколько|скольких|скольким|сколько всего|сколько штук|какое количество|каково количество|количество|число|каково число|как много|how many|how much|number of|the number of|\
        what is the number of|what number of|amount of|the amount of|total number of|the total number of|quantity of|скажи сколько|сколько же",
    ),
    (Mark::Count, "посчитай|сосчитай|подсчитай|count|count up|count all|count the number of"),
    (
        Mark::Side,
        "on which side of|which side of|on what side of|what side of|с какой стороны от|с какой стороны|по какую сторону от",
    ),
    (
        Mark::HowFar,
        "как далеко|далеко ли|далеко|насколько далеко|какое расстояние|каково расстояние|расстояние|на каком расстоянии|как близко|близко ли|сколько метров|сколько это метров|сколько это примерно метров|сколько это в метрах|сколько сантиметров|сколько ехать|сколько идти|\
        how far|how far away is it|is it far|how far away|how far apart|how close|how near|what is the distance|what s the distance|the distance|distance|how long is the way|how long is the route|how many metres is it|how many meters is it|how many metres|how many meters|how many centimetres",
    ),
    (
        Mark::HowLong,
        "сколько времени|сколько времени займёт|сколько времени занимает|сколько времени уйдёт|сколько времени уйдёт на|сколько времени понадобится|сколько времени тебе понадобится|сколько времени потребуется|сколько времени нужно|сколько времени надо|сколько времени нужно на|сколько минут|сколько секунд|как долго|долго ли|за сколько|за сколько времени|за сколько минут|за сколько секунд|за какое время|как скоро|как быстро|\
        how long does it take|how long would it take|how long will it take|how long does it take you|how long would it take you|how long will it take you|how long do you need|how long would you need|how long will you need|how long is the drive|how long is the trip|how much time|how much time does it take|how much time would it take|how much time will it take|how much time do you need|how many minutes|how many minutes does it take|how many seconds|how many seconds does it take|how many seconds would it take|how fast can you|how quickly can you|how soon can you",
    ),
    (
        Mark::HowGet,
        "how do i get out of|how can i get out of|how do you get out of|how do we get out of|how to get out of|how does one get out of|how do i leave|how can i leave|how to leave|how do i exit|how do i get out|how can i get out|как покинуть|как подняться|как спуститься|как мне подняться|как мне спуститься|как дойти|как проще попасть|как быстрее попасть|как быстрее добраться|как лучше пройти|how would one get|how might i get|как пройти|как проехать|как добраться|как попасть|как доехать|как дойти|как мне пройти|как мне проехать|как мне добраться|как мне попасть|как мне доехать|\
        как мне дойти|как пройти мне|как можно пройти|как можно попасть|как можно добраться|как ты проедешь|как ты доедешь|как ты попадёшь|как выйти|как выехать|как мне выйти|как вернуться|как перейти|как подъехать|как подойти|как зайти|как прийти|как тебе проехать|\
        какой дорогой|на пути|на этом пути|по пути|по этому пути|по дороге|каким путём|каким маршрутом|путь|дорога|дорогу|маршрут|проложи маршрут|построй маршрут|покажи дорогу|покажи путь|опиши путь|опиши дорогу|опиши маршрут|кратчайший путь|какой путь|какой маршрут|\
        how do i get|how can i get|how to get|how do you get|how can you get|how would i get|how would you get|how do i go|how can i go|how to go|how do i reach|how can i reach|how to reach|how do you reach|how do i find my way|\
        how does one get|how do we get|how can we get|how could i get|how should i get|how do you go|how do i come|how to come|how do i walk|how do i drive|\
        the way|way|what is the way|which way|the route|route|what is the route|what is the shortest way|what is the shortest route|shortest way|shortest route|shortest path|the shortest way|the shortest route|the shortest path|what is the shortest path|path|\
        directions|give me directions|show me the way|tell me the way|describe the way|describe the route|what is the best way|the best way|the quickest way",
    ),
    (
        Mark::When,
        "когда|как давно|в котором часу|when|how long ago|since when|at what time|at which time",
    ),
    (
        Mark::Why,
        "почему|отчего|с чего ты взял|с чего ты это взял|откуда ты знаешь|откуда это известно|откуда ты это знаешь|откуда известно|почему ты думаешь что|почему ты считаешь что|почему ты решил что|с чего ты взял что|откуда ты знаешь что|почему ты так думаешь|почему ты так решил|why do you think that|why do you think|why do you believe|why do you say that|почему так|почему это так|почему да|докажи|объясни|обоснуй|поясни|\
        why|why so|why is that|why is that so|how do you know|how do you know that|how come|explain|explain why|explain that|prove it|why do you think so|why do you say so|why do you say that|why is it so|why yes",
    ),
    (
        Mark::WhyNot,
        "почему нет|почему же нет|отчего нет|почему не|почему это не так|why not|why isn t it|why is it not|why aren t they|why no|why is that not so",
    ),
    (
        Mark::Who,
        "кто|кого|кому|кем|кто нибудь|кто либо|кто то|anybody|anyone|somebody|someone|people|person|persons|люди|людей|человек|человека|who|whom|whose|чей|чья|чьё|чьи",
    ),
    (
        Mark::HowBig(Dimension::All),
        "насколько велико|насколько велики|как велик|как велика|какого размера|каков размер|какой размер|какие размеры|каковы размеры|размер|размеры|габариты|каких размеров|насколько большой|насколько большая|насколько большое|насколько велик|насколько велика|\
        how big|how large|what size|what is the size|what is the size of|the size of|what are the dimensions|what are the dimensions of|dimensions|dimensions of|the dimensions of|size|size of|how small",
    ),
    (
        Mark::HowBig(Dimension::Elevation),
        "на какой высоте|на какой высоте от пола|насколько высоко висит|как высоко висит|at what height|at which height|how high up|how high above the floor|how far above the floor",
    ),
    (
        Mark::HowBig(Dimension::Height),
        "насколько высок|насколько высока|насколько высоко|насколько высоки|как высок|как высока|как высоко|высота потолка|какая высота потолка|какова высота потолка|высота потолков|какой высоты потолок|какой высоты потолки|how high is the ceiling|how high are the ceilings|ceiling height|what is the ceiling height|the ceiling height|какой высоты|какова высота|какая высота|высота|насколько высокий|насколько высокая|насколько высокое|how tall|how high|what height|what is the height|what is the height of|the height of|height of|height",
    ),
    (
        Mark::HowBig(Dimension::Width),
        "насколько широк|насколько широка|насколько широко|насколько широки|какой ширины|какова ширина|какая ширина|ширина|насколько широкий|насколько широкая|how wide|what width|what is the width|what is the width of|the width of|width of|width",
    ),
    (
        Mark::HowBig(Dimension::Length),
        "насколько длинен|насколько длинна|насколько длинно|насколько глубок|насколько глубока|какой длины|какова длина|какая длина|длина|насколько длинный|насколько длинная|глубина|какой глубины|какова глубина|how long|how deep|what length|what is the length|what is the length of|the length of|length of|the depth of|depth",
    ),
    (
        Mark::HowBig(Dimension::Area),
        "сколько места занимает|сколько места занимают|how much space does|how much room does|площади|какой общей площади|общая площадь|какова общая площадь|какая общая площадь|what is the total floor area|total floor area|the total floor area|what is the total area|total area|the total area|какой площади|какова площадь|какая площадь|площадь|what is the area of|what is the floor area of|what floor area|floor area|the floor area of|how spacious|what area|площади|каковы площади",
    ),
    (
        Mark::Exists,
        "есть|есть ли|имеется|имеются|имеется ли|имеются ли|существует|существуют|существует ли|найдётся|найдётся ли|нет ли|не найдётся ли|бывает|is there|is there a|are there|are there any|is there any|\
        is there anything|is there something|there is|there are|there s|exist|exists|do we have|do you have|have we got|have you got|is there some|isn t there|aren t there|does there exist|do there exist|can i find any",
    ),
    (
        Mark::Be,
        "keep|keeps|kept|живёт|живут|обитает|lives|live|living in|является|являются|осталось|остался|осталась|остались|остаётся|ли|is|are|was|were|be|been|being|s|находится|находятся|находилась|находился|находилось|находились|располагается|располагаются|находишься|находитесь|стоишь|расположен|расположена|расположено|расположены|стоит|стоят|стоящий|стоящая|стоящее|стоящие|\
        стоял|стояла|стояло|стояли|лежит|лежат|лежал|лежала|лежало|лежали|лежащая|лежащий|лежащее|лежащие|висящий|висящая|хранится|хранятся|был|была|было|были|размещается|размещён|размещена|поставлен|\
        поставлена|сейчас находится|находящийся|находящаяся|находящееся|находящиеся|содержится|содержатся|положен|положена|положили|прячется|\
        stand|stands|standing|lie|lies|lying|sits|sitting|located|situated|placed|kept|stored|found|positioned|currently|rest|rests|resting|stay|stays|been placed|laying|find|can i find|can we find|would i find|will i find|i can find|i could find|one can find|did i leave|did someone leave|did somebody leave|did anyone leave|did they leave|did he leave|did she leave|did someone put|did somebody put|did they put|was left|were left|did i put|did i keep|have i left|have i put|did we leave|did you put|did you leave|\
        я оставил|я оставила|я положил|я положила|я поставил|оставил|оставила|мы оставили|делся|девался|девалась",
    ),
    (
        Mark::Have,
        "have|has|contain|contains|containing|hold|holds|holding|имеет|имеют|содержит|содержат|includes|include|got|has got|have got|does have",
    ),
    (
        Mark::Lead,
        "share a door|shares a door|have a door between them|have a common door|share a wall with a door|имеют общую дверь|смежные|смежная|смежна|смежны|смежен|соседние|соседняя|попадёшь|попаду|окажешься|окажусь|попадём|окажемся|do i end up|end up|will i end up|would i end up|i end up|граничит|граничат|соседствует|соседствуют|прилегает|прилегают|borders|border|bordering|adjoins|adjoin|adjoining|ведёт|ведут|вела|ведущая|ведущие|ведущей|ведущую|выходит|выходят|выводит|соединяет|соединяют|соединяется|соединяются|сообщается|сообщаются|соединена|соединено|соединён|соединены|связывает|связывают|связана|связан|связаны|lead|leads|leading|go|goes|going|connect|connects|connecting|connected|open onto|open into|opens into|opens onto|joins|join|link|links",
    ),
    (
        Mark::Parts,
        "из чего состоит|из чего состоят|из каких частей|из каких частей состоит|состоит|состоят|из каких частей сделан|части|части у|какие части|какие части у|какие части есть у|детали|составные части|составные части у|\
        parts|parts of|the parts of|components of|the components of|consist of|consists of|made up of|composed of|component parts of|what parts does|which parts does|what are the parts of|pieces of|part of",
    ),
    (
        Mark::MadeOf,
        "из чего сделан|из чего сделана|из чего сделано|из чего сделаны|из чего|сделан|сделана|сделано|сделаны|изготовлен|изготовлена|изготовлено|изготовлены|из чего изготовлен|из чего изготовлена|\
        made of|made from|made out of|made out|made|built of|built from|made off",
    ),
    (
        Mark::Describe,
        "как называется|как называются|what is the name of|what s the name of|look like|looks like|what can you tell me about|can you tell me about|could you tell me about|what can you say about|что можешь рассказать о|что можешь рассказать про|что скажешь о|что скажешь про|что ты можешь сказать о|что это за|что это такое|расскажи про|расскажи о|расскажи об|расскажи|опиши|опишите|что ты знаешь про|что ты знаешь о|что ты знаешь об|что известно о|что можно сказать о|что можно сказать про|что можно рассказать о|что можешь сказать о|что можешь сказать про|что известно об|что известно про|опиши мне|describe|tell me everything about|tell me all about|tell me everything you know about|everything about|tell me about|расскажи всё про|расскажи всё о|расскажи всё об|расскажи мне про|расскажи мне о|расскажи мне об|что есть про|tell me more about|what do you know about|information about|give me information about|what is known about|что такое|кто такой|кто такая",
    ),
    (
        Mark::List,
        "дай список|дай мне список|дайте список|составь список|список|give me a list of|a list of|list of|what are the names of|the names of|names of|покажи мне всю|покажи всю|покажи мне весь|покажи весь|покажи мне все|покажи мне всё|покажи все|покажи всё|show me all|show all|show me all the|show all the|перечисли|перечислите|назови|назовите|перечень|список|выведи|выпиши|list|list all|name|enumerate|give me a list of|give me the list of|a list of|name all",
    ),
    (
        Mark::See,
        "can you see|do you see|do you see any|can you see any|what do you see|what can you see|what are you looking at|что ты видишь|видишь|видно|видите|see|seeing|look at|looking at|visible",
    ),
    (
        Mark::LastSeen,
        "видел в последний раз|видели в последний раз|ты видел в последний раз|в последний раз видел|в последний раз видели|последний раз видел|последний раз видели|последний раз|в последний раз|видел|видела|видели|видел ли|замечен|замечена|замечали|наблюдали|\
        last seen|seen last|last see|last observed|seen|saw|did you see|did you last see|have you seen|last|most recently seen|observed",
    ),
    (
        Mark::Before,
        "раньше|до этого|прежде|ранее|до того|перед этим|прежнее место|в прошлый раз|вчера|до перестановки|before|previously|earlier|used to be|formerly|before that|before now|yesterday|in the past",
    ),
    (
        Mark::Free,
        "how much room is left|how much room is there|how much room|how much space is left|how much space is there|how much space|how much free space is there|how much free space|how much empty space|хватит места|хватит ли места|хватит|хватит ли|хватает места|хватает ли места|достаточно места|достаточно ли места|сколько места осталось|сколько осталось места|сколько ещё места|сколько места|сколько свободного места|свободно|свободное место|свободного места|свободен|свободна|место|места|free space|free|space|room left|enough room|enough space|empty space|space left|room for|any room left|any room for|any room on|have any room|has any room|uncluttered|free room|there room|is there room|is there space|is there any space|is there any room|is there enough room|is there enough space|is there space for|is there room for|is there enough room for|is there enough space for|space for|место для|поместится|поместятся|уместится|влезет|помещается|fit|fits|is there free space|is there any free space",
    ),
    (
        Mark::Sit,
        "сидят|посижу|присяду|усесться|сесть|посидеть|присесть|сидеть|sit|sit down|take a seat|have a seat|relax|be seated|take a rest",
    ),
    (
        Mark::LieDown,
        "спят|лежат люди|лягу|прилягу|вздремнуть|лечь|полежать|прилечь|поспать|спать|отдохнуть|lie down|sleep|nap|take a nap|get some sleep",
    ),
    (Mark::PutDown, "положить|поставить|разместить|put|place|set down|put down|lay down|leave"),
    (
        Mark::Can,
        "может|могут|может ли|could you|can i|сумеешь|можно|можно ли|можешь|могу|могу ли|могу ли я|сможешь|можешь ли|можно мне|могли бы|мог бы|получится|смогу|can i|can one|could i|can we|may i|is it possible to|should i|can you|can|could|could one|might i|able|possible",
    ),
    (
        Mark::Hold,
        "держишь|у тебя в руках|ты держишь|в твоих руках|несёшь|are you holding|do you hold|you are holding|carrying|in your hand|in your hands|in your gripper",
    ),
    (
        Mark::You,
        "собой|себя|себе|ты|тебя|тебе|тобой|тобою|вы|вас|вам|робот|робота|роботу|роботом|роботе|рб|рб 2|you|yourself|robot|the robot|rb 2",
    ),
    (Mark::Me, "я|мне|меня|мной|i|me|myself|us|we|нам|нас|мы"),
    (
        Mark::Not,
        "can t|cannot|cant|couldn t|won t|не|нету|нет|ни|not|n t|isn t|aren t|wasn t|weren t|doesn t|don t|no|isnt|arent|doesnt|dont",
    ),
    (
        Mark::Avoiding,
        "не заходя в|не заходя во|не заезжая в|не заезжая во|не проходя через|не проезжая через|не заходя на|минуя|в обход|не через|без захода в|avoiding|that avoids|bypassing|without going through|without passing through|without passing|without crossing|without entering|without using|without taking|without riding|not using|not taking|не пользуясь|не используя|без использования|without going into|without driving through|without walking through|not going through|not passing through",
    ),
    (
        Mark::Unopened,
        "не открывая дверей|не открывая двери|не открывая дверь|не открывая ни одной двери|не открывая никаких дверей|не открывая|without opening a door|without opening a single door|without opening any door|without opening any doors|without opening doors|without having to open a door|without having to open any doors",
    ),
    (Mark::MustOpen, "придётся открывать двери|have to open any doors"),
    (
        Mark::Must,
        "нужно ли|надо ли|обязательно|обязательно ли|обязательно ли надо|придётся|придётся ли|придётся мне|придётся ли мне|must i|must one|must you|have to|do i have to|do you have to|does one have to|do we have to|need to|is it necessary to|no way but",
    ),
    (Mark::Cannot, "нельзя|невозможно|can t one|can t i|can t you|impossible to"),
    (
        Mark::Differ,
        "чем отличается|чем отличаются|чем различаются|в чём разница между|в чём отличие|в чём различие между|какая разница между|чем же отличаются|отличается|отличаются|what is the difference between|what s the difference between|the difference between|difference between|differ|differs|different from",
    ),
    (
        Mark::Alike,
        "что общего у|что общего между|что общего|have in common|has in common|in common",
    ),
    (Mark::Without, "без|without|with no|without any|without a|безо"),
    (
        Mark::Directly,
        "сразу|напрямую|непосредственно|directly|straight|без захода|not through another room",
    ),
    (
        Mark::OccupiedBy,
        "чем занят|чем занята|чем занято|чем заняты|чем заставлен|чем заставлена|чем заполнен|чем заполнена|чем загромождён",
    ),
    (
        Mark::Took,
        "взял|взяла|взяли|забрал|забрала|забрали|унёс|унесла|унесли|брал|брала|брали|took|taken|has taken|did you take|have you taken",
    ),
    (
        Mark::Moved,
        "двигал|двигала|трогал|трогала|трогали|переносил|переносила|touched|переставили|переставил|переставила|передвинули|передвинул|передвинула|перенесли|перенёс|переставляли|передвигали|двигали|перемещали|переместили|moved|been moved|relocated|rearranged|last moved",
    ),
    (
        Mark::OnlyOne,
        "один ли|одна ли|одно ли|только один|только одна|только одно|лишь один|лишь одна|лишь одно|всего один|всего одна|всего одно|ровно один|ровно одна|ровно одно|only one|just one|exactly one|only a single|just a single",
    ),
    (Mark::And, "и|а также|и еще|and|as well as|and also|together with|plus"),
    (Mark::Or, "или|либо|or|or else"),
    (
        Mark::ThanTo,
        "чем к|чем от|чем до|нежели к|чем ко|than to|than from|than it is to|than it is from|than the distance to",
    ),
    (Mark::Than, "чем|нежели|than|than is|compared to|compared with"),
    (
        Mark::All,
        "everything|всей|все|всё|всех|всем|вся|всю|весь|каждый|каждая|каждое|каждую|каждом|каждой|каждого|каждому|каждым|любой|любая|любое|оба|обе|обоих|обеих|обоим|обеим|обоими|обеими|all|all of|every one of|each of|both of|все из|all the|all of the|every|each|both|both the|entire|whole",
    ),
    (
        Mark::Except,
        "not counting|without counting|excluding|not including|leaving out|besides|кроме|помимо|не считая|за исключением|исключая|если не считать|except|except for|apart from|other than|aside from",
    ),
    (
        Mark::Other,
        "другой|другая|другое|другую|другого|другим|другие|других|ещё|остальные|остальных|остальное|остальную|other|another|else|the other|remaining|the rest of",
    ),
    (Mark::Link(Rel::In), "left in|в|во|внутри|внутрь|in|inside|inside of|within|into|in side"),
    (
        Mark::Link(Rel::On),
        "left on|на|поверх|сверху на|сверху|on|on top of|atop|upon|onto|on the surface of|on the top of|at the top of|over the top of",
    ),
    (
        Mark::Link(Rel::Under),
        "под|подо|снизу|снизу под|внизу под|under|below|beneath|underneath|under neath|bellow|at the bottom of|directly below|directly under|right under",
    ),
    (Mark::Link(Rel::Above), "над|надо|сверху над|above|over|directly above|right above"),
    (
        Mark::Link(Rel::NextTo),
        "вдоль|along|against|up against|рядом с|рядом со|рядом|возле|около|у|подле|бок о бок с|сбоку от|по соседству с|вплотную к|next to|beside|by|alongside|adjacent to|at the side of|to the side of|right next to|directly next to|nearby",
    ),
    (
        Mark::Link(Rel::Near),
        "близко к|близко от|вблизи|вблизи от|недалеко от|неподалёку от|поблизости от|вблизи с|вокруг|near|close to|near to|around|close by|surround|surrounds|in the vicinity of|not far from|surrounding",
    ),
    (
        Mark::Link(Rel::LeftOf),
        "слева от|слева|левее|to the left|on the left|по левую сторону от|с левой стороны от|по левую руку от|left of|to the left of|on the left of|on the left side of|to the left side of|at the left of|left to|on the left hand side of|on the left from|to the left from|left from",
    ),
    (
        Mark::Link(Rel::RightOf),
        "справа от|справа|правее|to the right|on the right|по правую сторону от|с правой стороны от|по правую руку от|right of|to the right of|on the right of|on the right side of|to the right side of|at the right of|right to|on the right hand side of|on the right from|to the right from|right from",
    ),
    (
        Mark::Link(Rel::Behind),
        "за|позади|сзади|сзади от|позади от|behind|in back of|at the back of|in the back of|to the rear of",
    ),
    (
        Mark::Link(Rel::InFrontOf),
        "перед|передо|впереди|спереди от|спереди|напротив|in front of|before the|ahead of|opposite|opposite to|across from|in the front of|the opposite of|opposite of",
    ),
    (
        Mark::Link(Rel::Between),
        "между|посередине между|меж|between|in between|in the middle between|directly between|directly in between",
    ),
    (
        Mark::Link(Rel::Facing),
        "смотрит на|смотрят на|смотрит в сторону|смотрят в сторону|лицом к|передом к|повёрнут|повёрнута|повёрнуто|повёрнуты|повёрнут к|повёрнута к|повёрнуто к|повёрнуты к|обращён к|обращена к|обращено к|обращены к|если смотреть на|если посмотреть на|если смотреть в сторону|если глядеть на|если стоять лицом к|если встать лицом к|если повернуться лицом к|если повернуться к|если сидеть лицом к|глядя на|смотря на|стоя лицом к|when you face|if you face|if i face|when i face|when facing|if facing|if you are facing|when you are facing|when one faces|if one faces|when you look at|if you look at|when looking at|if i look at|looking at|when one looks at|while facing|развёрнут к|развёрнута к|развёрнуто к|facing|faces|turned towards|turned to",
    ),
    (
        Mark::Link(Rel::Middle),
        "посередине|посреди|в центре|в середине|по центру|в самом центре|в самой середине|in the middle of|in the middle|in the centre of|in the center of|at the centre of|at the center of",
    ),
    (
        Mark::Link(Rel::Leaning),
        "прислонён к|прислонена к|прислонено к|прислонены к|прислонён|прислонена|прислонено|прислонены|опирается о|leaning against|leans against|leaning on|leans on|leaned against|lean against|propped against|leaning",
    ),
    (
        Mark::FacingIt,
        "если стоять к нему лицом|если стоять к ней лицом|если стоять лицом к нему|если стоять лицом к ней|если смотреть на него|если смотреть на неё|если к нему стоять лицом|если к ней стоять лицом|стоя к нему лицом|стоя к ней лицом|when you face it|if you face it|when facing it|if facing it|if you are facing it|when you are facing it|facing it|when you look at it|when looking at it|if you look at it|looking at it",
    ),
    (Mark::Link(Rel::Has), "with|having"),
    (Mark::Link(Rel::Outside), "вне|снаружи|за пределами|outside|outside of|out side"),
    (
        Mark::Link(Rel::From),
        "if i m in|if i am in|if you are in|when i am in|when i m in|если я в|если я нахожусь в|если я во|находясь в|будучи в|из|изо|от|ото|с|со|из под|out of|from|off|starting from|leaving|begin at",
    ),
    (
        Mark::Link(Rel::To),
        "к|ко|до|для|to|towards|toward|into the|up to|for the|for|till|as far as",
    ),
    (Mark::Link(Rel::Through), "через|сквозь|through|via|by way of"),
    (Mark::Link(Rel::At), "at|при"),
    (Mark::Link(Rel::Of), "of|belonging to"),
    (Mark::Nearer(Closeness::Nearer), "ближе|поближе|closer|nearer|less far"),
    (
        Mark::Nearer(Closeness::Farther),
        "дальше|подальше|farther|further|more distant|farther away|further away",
    ),
    (
        Mark::Best(Extreme::Nearest),
        "ближайший|ближайшая|ближайшее|ближайшие|ближайшего|ближайшую|ближайшей|ближайшем|ближайшему|ближайших|самый близкий|самому близкому|самым близким|самом близком|самая близкая|самое близкое|самые близкие|самую близкую|ближе всего|ближе всех|наиболее близкий|по близости|nearest|closest",
    ),
    (
        Mark::Best(Extreme::Farthest),
        "самый дальний|самому дальнему|самым дальним|самом дальнем|самая дальняя|самое дальнее|самые дальние|самую дальнюю|дальше всего|дальше всех|наиболее удалённый|самый далёкий|самая далёкая|самое далёкое|самый удалённый|самая удалённая|самое удалённое|по удалённости|по дальности|farthest|furthest|most distant|farthest away|furthest away",
    ),
    (Mark::BestTo(Extreme::Nearest), "nearest to|closest to|the nearest to|the closest to"),
    (
        Mark::BestTo(Extreme::Farthest),
        "farthest from|furthest from|farthest away from|furthest away from|the farthest from|the furthest from|most distant from",
    ),
    (
        Mark::Best(Extreme::Biggest),
        "самое просторное|самые просторные|самую просторную|самом просторном|самой просторной|самый большой|самому большому|самым большим|самом большом|самая большая|самое большое|самые большие|самую большую|самого большого|самой большой|самых больших|больше всех|по величине|по размеру|по площади|by size|in size|by area|наибольший|наибольшая|наибольшее|крупнейший|самый крупный|самая крупная|самое крупное|самые крупные|самую крупную|самый просторный|самая просторная|biggest|largest|greatest|most spacious|roomiest",
    ),
    (
        Mark::Best(Extreme::Smallest),
        "самый тесный|самая тесная|самое тесное|самую тесную|самой тесной|самом тесном|самый маленький|самому маленькому|самым маленьким|самом маленьком|самая маленькая|самое маленькое|самые маленькие|самую маленькую|самого маленького|самой маленькой|самых маленьких|меньше всех|наименьший|наименьшая|самый малый|самая малая|самый мелкий|самая мелкая|самое мелкое|smallest|littlest|tiniest",
    ),
    (
        Mark::Best(Extreme::Tallest),
        "самый высокий|самому высокому|самым высоким|самом высоком|самая высокая|самое высокое|самые высокие|самую высокую|самого высокого|самой высокой|выше всех|выше всего|по высоте|by height|in height|tallest",
    ),
    (
        Mark::Best(Extreme::Lowest),
        "самый низкий|самая низкая|самое низкое|самые низкие|самую низкую|ниже всех|ниже всего|shortest",
    ),
    (
        Mark::Best(Extreme::Topmost),
        "верхний|верхняя|верхнее|верхние|верхнюю|верхнего|верхней|верхнем|верхнему|верхним|верхних|top|upper|самый верхний|самая верхняя|самое верхнее|самые верхние|самую верхнюю|самого верхнего|самой верхней|highest|topmost|uppermost|highest up",
    ),
    (
        Mark::Best(Extreme::Bottommost),
        "нижний|нижняя|нижнее|нижние|нижнюю|нижнего|нижней|нижнем|нижнему|нижним|нижних|bottom|самый нижний|самая нижняя|самое нижнее|самые нижние|самую нижнюю|самого нижнего|самой нижней|lowest|bottommost|lowest down",
    ),
    (
        Mark::Best(Extreme::Midmost),
        "средний|средняя|среднее|средние|среднюю|среднего|средней|среднем|среднему|средним|средних|middle",
    ),
    (
        Mark::CountedFrom(Extreme::Topmost),
        "from the top|from above|counting from the top|counted from the top",
    ),
    (
        Mark::CountedFrom(Extreme::Bottommost),
        "from the bottom|from below|counting from the bottom|counted from the bottom",
    ),
    (Mark::CountedFrom(Extreme::LeftMost), "counting from the left"),
    (Mark::CountedFrom(Extreme::RightMost), "counting from the right"),
    (
        Mark::Best(Extreme::Thickest),
        "самый толстый|самая толстая|самое толстое|самые толстые|самую толстую|толще всех|толще всего|по толщине|thickest|by thickness",
    ),
    (
        Mark::Best(Extreme::Thinnest),
        "самый тонкий|самая тонкая|самое тонкое|самые тонкие|самую тонкую|тоньше всех|тоньше всего|thinnest|slimmest",
    ),
    (Mark::More(Extreme::Thickest), "толще|потолще|thicker"),
    (Mark::More(Extreme::Thinnest), "тоньше|потоньше|thinner|slimmer"),
    (
        Mark::Best(Extreme::Widest),
        "самый широкий|самая широкая|самое широкое|самую широкую|самые широкие|шире всех|по ширине|by width|widest|broadest",
    ),
    (
        Mark::Best(Extreme::Narrowest),
        "самый узкий|самая узкая|самое узкое|самую узкую|самые узкие|уже всех|narrowest",
    ),
    (
        Mark::Best(Extreme::Longest),
        "самый длинный|самая длинная|самое длинное|самую длинную|длиннее всех|по длине|by length|longest",
    ),
    (
        Mark::Best(Extreme::Shortest),
        "самый короткий|самая короткая|самое короткое|самую короткую|самые короткие|короче всех",
    ),
    (
        Mark::Best(Extreme::LeftMost),
        "левый|левая|левое|левую|левой|левого|левом|левому|левые|левых|the left|самый левый|самая левая|самое левое|левее всех|крайний слева|крайняя слева|крайнее слева|left most|leftmost|furthest to the left|farthest to the left|furthest left|farthest left|most to the left|farthest on the left|furthest on the left|дальше всех влево",
    ),
    (
        Mark::Best(Extreme::RightMost),
        "правый|правая|правое|правую|правой|правого|правом|правому|правые|правых|the right|самый правый|самая правая|самое правое|правее всех|крайний справа|крайняя справа|крайнее справа|right most|rightmost|furthest to the right|farthest to the right|furthest right|farthest right|most to the right|farthest on the right|furthest on the right|дальше всех вправо",
    ),
    (
        Mark::Best(Extreme::Most),
        "больше всего|всего больше|наибольшее количество|наибольшее число|самое большое количество|the most|most|the largest number of|the greatest number of|the highest number of",
    ),
    (
        Mark::Best(Extreme::Fewest),
        "меньше всего|всего меньше|наименьшее количество|наименьшее число|самое маленькое количество|the fewest|fewest|the least|least|the smallest number of|the lowest number of",
    ),
    (Mark::More(Extreme::Most), "more"),
    (Mark::More(Extreme::Fewest), "fewer|less"),
    (
        Mark::Grade(Extreme::Biggest),
        "большой|большая|большое|большую|большого|большом|большому|крупный|крупная|крупное|крупную|крупного|крупной|крупном|просторный|просторная|просторное|просторную|просторной|просторном|big|large|spacious",
    ),
    (
        Mark::Grade(Extreme::Smallest),
        "маленький|маленькая|маленькое|маленькую|маленького|маленькой|маленьком|маленькому|небольшой|небольшая|небольшое|небольшую|небольшого|небольшом|small|little|tiny",
    ),
    (
        Mark::Grade(Extreme::Tallest),
        "высокий|высокая|высокое|высокую|высокого|высокой|высоком|высокому|tall",
    ),
    (Mark::Grade(Extreme::Lowest), "низкий|низкая|низкое|низкую|низкого|низкой|низком|низкому"),
    (
        Mark::Grade(Extreme::Longest),
        "длинный|длинная|длинное|длинную|длинного|длинной|длинном|длинному|long",
    ),
    (
        Mark::Grade(Extreme::Shortest),
        "короткий|короткая|короткое|короткую|короткого|короткой|коротком",
    ),
    (
        Mark::Rank(1),
        "первый|первая|первое|первые|первого|первую|первых|первым|первом|первой|first|1st|1 st",
    ),
    (
        Mark::Rank(2),
        "второй|вторая|второе|вторые|второго|второму|вторую|вторых|вторым|втором|second|2nd|2 nd",
    ),
    (
        Mark::Rank(3),
        "третьем|третьему|третьим|третий|третья|третье|третьи|третьего|третьей|третью|третьих|third|3rd|3 rd",
    ),
    (
        Mark::Rank(4),
        "четвёртом|четвёртому|четвёртым|четвёртый|четвёртая|четвёртое|четвёртые|четвёртого|четвёртой|четвёртую|fourth|4th|4 th",
    ),
    (Mark::Rank(5), "пятом|пятому|пятым|пятый|пятая|пятое|пятые|пятого|пятой|пятую|fifth|5th|5 th"),
    (
        Mark::Help,
        "что умеешь|что можешь|чем можешь помочь|на что ты способен|what are you able to do|what do you know how to do|кто ты|кто ты такой|как тебя зовут|что ты умеешь|что ты можешь|что ты умеешь делать|помоги|помощь|справка|подсказка|команды|какие есть команды|список команд|что тебе можно приказать|что тебе можно сказать|о чём тебя можно спросить|что можно спросить|что у тебя можно спросить|\
        help|who are you|what is your name|what s your name|what can you do|what can i ask|what can i ask you|how can you help|commands|list of commands|what can i tell you|what can i say",
    ),
    (
        Mark::Did,
        "что ты сделал|что ты делал|что ты только что сделал|что ты только что делал|что ты уже сделал|что было сделано|что ты делал только что|какое было последнее задание|что ты сделал последним|what did you do|what have you done|what did you just do|what have you just done|what was the last thing you did|what was your last task|what were you doing|what did you do last",
    ),
    (
        Mark::Changed,
        "что изменилось|что поменялось|что теперь по другому|что не так как на карте|что не как на карте|чем мир отличается от карты|что отличается от карты|какие изменения|есть ли изменения|what has changed|what s changed|what changed|what is different|what s different|what is different from the map|what differs from the map|what is not as on the map|any changes|are there any changes",
    ),
    (
        Mark::Unseen,
        "что ты ещё не видел|чего ты ещё не видел|чего ты не видел|что ты не видел|что ещё не осмотрено|что ты ещё не осмотрел|чего ты ещё не осмотрел|what have you not seen yet|what have you not seen|what haven t you seen yet|what haven t you seen|what did you not see yet|what is still unseen",
    ),
    (
        Mark::Sureness,
        "насколько ты уверен где ты находишься|насколько ты уверен где находишься|насколько ты уверен где ты|насколько ты уверен в своём месте|насколько точно ты знаешь где ты находишься|насколько точно ты знаешь где ты|ты уверен где находишься|ты уверен где ты находишься|ты уверен где ты|уверен ли ты где находишься|точно ли ты знаешь где ты|how sure are you where you are|how sure are you of where you are|how sure are you about where you are|how certain are you where you are|are you sure where you are|are you certain where you are|how well do you know where you are|do you know exactly where you are",
    ),
    (
        Mark::Heading,
        "куда ты смотришь|куда смотришь|куда ты повёрнут|в какую сторону ты смотришь|куда ты направлен|к чему ты повёрнут|what are you facing|which way are you facing|where are you facing|where are you looking|what direction are you facing",
    ),
    (
        Mark::Detail(Detail::Region),
        "коротко|кратко|вкратце|в двух словах|покороче|briefly|in short|in brief|in a few words|in a nutshell",
    ),
    (
        Mark::Detail(Detail::Heading),
        "подробно|подробнее|поподробнее|детально|во всех подробностях|в подробностях|в деталях|шаг за шагом|по шагам|пошагово|in detail|in details|in full detail|in more detail|detailed|step by step|precisely how",
    ),
    (
        Mark::More(Extreme::LeftMost),
        "further left|farther left|further to the left|farther to the left|more to the left",
    ),
    (
        Mark::More(Extreme::RightMost),
        "further right|farther right|further to the right|farther to the right|more to the right",
    ),
    (Mark::More(Extreme::Heaviest), "тяжелее|тяжелей|heavier"),
    (Mark::More(Extreme::Lightest), "легче|полегче|lighter"),
    (
        Mark::Best(Extreme::Heaviest),
        "самый тяжёлый|самая тяжёлая|самое тяжёлое|самые тяжёлые|самую тяжёлую|тяжелее всех|тяжелее всего|по весу|heaviest|by weight",
    ),
    (
        Mark::Best(Extreme::Lightest),
        "самый лёгкий|самая лёгкая|самое лёгкое|самые лёгкие|самую лёгкую|легче всех|легче всего|lightest",
    ),
    (Mark::More(Extreme::Biggest), "больше|крупнее|просторнее|bigger|larger|greater|more spacious"),
    (Mark::More(Extreme::Smallest), "меньше|мельче|теснее|smaller|littler|less big"),
    (Mark::More(Extreme::Tallest), "выше|taller"),
    (Mark::More(Extreme::Lowest), "ниже|shorter"),
    (Mark::More(Extreme::Topmost), "higher|higher up"),
    (Mark::More(Extreme::Bottommost), "lower|lower down"),
    (Mark::More(Extreme::Shortest), "короче"),
    (Mark::More(Extreme::Widest), "шире|wider|broader"),
    (Mark::More(Extreme::Narrowest), "уже чем|narrower"),
    (Mark::More(Extreme::Longest), "длиннее|longer"),
    (
        Mark::Same,
        "такого же|такой же|такая же|такое же|такие же|того же|тот же|та же|той же|том же|тем же|ту же|те же|тех же|одного|одной|одном|одних|одинакового|одинаковые|одинаковый|same|the same|one and the same",
    ),
    (Mark::Pronoun(Pronoun::He), "он|him"),
    (Mark::Pronoun(Pronoun::HimOrIt), "его|ему|него|нему|ним|нём"),
    (Mark::Pronoun(Pronoun::She), "она|she|he"),
    (Mark::Pronoun(Pronoun::Her), "её|ей|неё|ней|нею|her"),
    (Mark::Pronoun(Pronoun::It), "оно"),
    (Mark::Pronoun(Pronoun::They), "они|их|им|них|ними|they|them|those"),
    (Mark::Pronoun(Pronoun::Any), "it|its"),
    (Mark::There, "там|оттуда|туда|there|in there"),
    (Mark::One, "one|ones"),
    (
        Mark::A,
        "какой нибудь|каком нибудь|какого нибудь|какому нибудь|каким нибудь|какую нибудь|каком либо|какого либо|одной из|одном из|одного из|одних из|one of the|one of my|one of|any of the|any of|any|at least one of the|at least one|some of the|a|an|some|какой нибудь|какая нибудь|какое нибудь|какие нибудь|какую нибудь|какой либо|хоть один|хоть одна|хоть какой нибудь|хотя бы один|один|одна|одно",
    ),
    (
        Mark::The,
        "the|this|that|these|этот|эта|это|эти|этой|этом|этого|эту|этих|этими|этому|тот|та|те|той|том|тех|тому|my|your|our|his|мой|моя|моё|мои|мою|моего|моей|моих|твой|твоя|твоё|твои|наш|наша|наше|наши|свой|свою",
    ),
    (
        Mark::Filler,
        "people use|people use to|do people use|one uses|used for|used to|use|used|using|needed|need|i need|we need|используют|использовать|используется|использую|пользуются|воспользоваться|применяют|понадобится|сам|сама|сами|roughly|approximately|about how|примерно|приблизительно|но|but|тоже|также|нужен|нужна|нужны|чтобы|for a bit|for a while|for a moment|разных|разные|различных|различные|different|various|distinct|then|so then|но тогда|хотел бы узнать|хотела бы узнать|хотел узнать|хотела узнать|хотелось узнать|хочется знать|хочется узнать|хочу узнать|любопытно|расскажи мне|объясни мне|напомни|напомни мне|напомните|дай знать|дайте знать|допустим|если выйти|если пойти|если пройти|если войти|если зайти|если я выйду|если я пройду|если я пойду|if i go|if you go|if one goes|if i leave|if i walk|if we go|i was wondering|was wondering|i am curious|i m curious|remind me|i d love to know|would love to know|would like to know|like to know|wanted to know|i wanted to ask|wanted to ask|may i ask|can i ask|any chance you know|would you know|you know|have you any idea|do you have any idea|by any chance|всё ещё|все ещё|по прежнему|до сих пор|всё так же|still|у вас тут|у нас тут|тут у вас|тут у нас|у вас|у нас|у вас дома|у нас дома|сколько то|might|ужe|случаем|in centimetres|in centimeters|in metres|in meters|in cm|в сантиметрах|в метрах|куда то|однако|кстати говоря|may|got to|currently still|at present|nowadays|just now|прямо|друг от друга|друг с другом|друг к другу|друг другу|from each other|each other|to each other|with each other|one another|from where you are|from where you stand|from your place|from your position|from here|отсюда|с твоего места|с твоей позиции|с этого места|somewhere|anywhere|где нибудь|где то|где либо|what about|how about|а что насчёт|что насчёт|а как насчёт|а как же|пожалуйста|плиз|скажи|скажите|скажи пожалуйста|подскажи|подскажите|покажи|покажите|ответь|ответьте|сообщи|уточни|будь добр|будь добра|будьте добры|не подскажешь|не подскажете|не скажешь|не скажете|не знаешь|ты не знаешь|ты не знаешь случайно|случайно|вы не знаете|\
        не могли бы вы сказать|не мог бы ты сказать|можешь сказать|можете сказать|можешь подсказать|мне нужно знать|мне надо знать|я хочу знать|хочу знать|хотелось бы знать|интересно|меня интересует|\
        же|бы|ведь|вообще|а|ну|вот|так|то|тут|здесь|сейчас|теперь|в данный момент|на данный момент|прямо сейчас|всего|в общем|в целом|ровно|привет|здравствуй|здравствуйте|эй|слушай|послушай|спасибо|хорошо|ладно|нужно|надо|ка|том числе|именно|штук|штуки|правда|правда ли|правда ли что|верно ли|верно ли что|верно|действительно|точно|\
        по отношению к|относительно|относится|знаешь|думаешь|как ты думаешь|как думаешь|наверное|разве|неужели|имеющиеся|имеющийся|\
        please|tell me|tell us|show me|show us|say|could you|could you please|would you|would you please|will you|can you tell me|could you tell me|would you tell me|can you say|do you know|do you know if|do you know whether|do you happen to know|happen to know|would you happen to know|i want to know|i would like to know|i d like to know|i wonder|i am wondering|wondering|i need to know|let me know|\
        hey|hello|hi|ok|okay|well|so|now|right now|at the moment|currently located|actually|exactly|precisely|really|just|also|too|if|whether|that is|which is|which are|that are|do|does|did|do i|do you|d|am|will|would|shall|should|must|thanks|thank you|kindly|here|in total|altogether|total|in all|all together|overall|it is true that|is it true that|is it true|true|is it the case that|\
        currently|ever|it is|most|кажется|кстати|уже|тогда|give me|want|find out|check|check if|check whether|проверь|узнай|i m looking for|i am looking for|looking for|im looking for|scene|in this scene|in the scene|in this picture|relative to|with respect to|related to|present|available|right|immediately|object that is|things that are",
    ),
];

type Phrases = Vec<(Vec<String>, Mark)>;

fn table() -> &'static HashMap<String, Phrases> {
    static TABLE: OnceLock<HashMap<String, Phrases>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table: HashMap<String, Phrases> = HashMap::new();
        for (mark, phrase) in phrases() {
            let words: Vec<String> = phrase.split_whitespace().map(name_key).collect();
            table.entry(words[0].clone()).or_default().push((words, mark));
        }
        for phrases in table.values_mut() {
            phrases.sort_by_key(|(words, _)| std::cmp::Reverse(words.len()));
        }
        table
    })
}

fn phrases() -> impl Iterator<Item = (Mark, &'static str)> {
    WORDS.iter().flat_map(|(mark, list)| {
        list.split('|')
            .map(|phrase| (*mark, phrase.trim()))
            .filter(|(_, phrase)| !phrase.is_empty())
    })
}

/// The mark of the longest phrase at the beginning of these words (in [`name_key`] form), with the number of words it
/// takes. Where a phrase is listed twice, the first list wins, and all go before a deed's.
pub(super) fn longest(words: &[String]) -> Option<(usize, Mark)> {
    let fits = |phrase: &[String]| words.get(..phrase.len()) == Some(phrase);
    let listed = table().get(words.first()?).and_then(|phrases| {
        let phrase = phrases.iter().find(|(phrase, _)| fits(phrase));
        phrase.map(|(phrase, mark)| (phrase.len(), *mark))
    });
    let deed = uses::longest(words).map(|(taken, deed)| (taken, Mark::Deed(deed)));
    match (listed, deed) {
        (Some(listed), Some(deed)) if deed.0 > listed.0 => Some(deed),
        (listed, deed) => listed.or(deed),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_phrase_wins() {
        let check = |text: &str, expected: Option<(usize, Mark)>| {
            let words: Vec<String> = text.split_whitespace().map(name_key).collect();
            assert_eq!(longest(&words), expected, "{text}");
        };
        check("на каком расстоянии", Some((3, Mark::HowFar)));
        check("to the left of the table", Some((4, Mark::Link(Rel::LeftOf))));
        check("почему нет", Some((2, Mark::WhyNot)));
        check("ёлка", None);
    }
}
