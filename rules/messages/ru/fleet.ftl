# Что не так между роботом и центром.

fleet-database = база данных: { $what }
    .help = проверьте адрес базы и что сервер работает
fleet-key = ключ не подходит
    .help = получите ключ: ortho-fleet key
fleet-forbidden = этому ключу сюда нельзя
    .help = нужен ключ другого рода: ortho-fleet key
fleet-gap = после кадра { $have } пришёл кадр { $came }
    .help = пришлите кадры, начиная со следующего
fleet-diverged = кадр { $sequence } здесь другой: хранилище робота пошло другим путём
    .help = пришлите хранилище целиком
fleet-content = { $what }
fleet-line = центр «{ $url }»: { $what }
    .help = проверьте связь и адрес
fleet-plain = без TLS сервер слушает только этот компьютер, а не { $address }
    .help = дайте --cert и --tls-key или слушайте 127.0.0.1
fleet-plain-database = к базе данных на { $host } без TLS не подключаемся
    .help = уберите sslmode=disable из адреса; чужой сертификат: --db-authority
fleet-moved = карта центра тем временем изменилась: сейчас ревизия { $revision }
    .help = посмотрите на новую ревизию и повторите
fleet-unknown = в центре нет: { $what }
fleet-held = карта центра подождёт: { $why }
    .help = повторите позже (push --pull повторяет сам) или закройте программу, которая держит хранилище
fleet-io = { $path }: { $source }

# Слова и обороты, из которых складывается сказанное.

robot-of-building = робот { $robot } здания { $building }
key-named = ключ «{ $name }»
storey-of-building = этаж здания { $building }
map-of-building = карта здания { $building }
building-numbered = здание { $building }
map-has-no-domain = на карте нет Домейна
robot-numbers-begin-at-one = номер робота больше нуля: ноль – это центр
no-random-numbers = нет случайных чисел: { $why }
packing-unknown = сжатие «{ $packing }» неизвестно
packed-unreadable = сжатое не читается: { $why }
too-much-at-once = слишком много за один раз
these-are-no-frames = это не кадры журнала
number-too-large = номер { $n } слишком велик
frame-numbered = номер кадра { $sequence }
centre-does-not-go-on = центр не идёт вперёд
centre-map-unreadable = карта центра не читается
step-was-another = шаг { $step } уже сделан, но был другим
no-certificate = сертификата нет

# Вопросы к фактам всех зданий.

question-unreadable-at = вопрос не читается у «{ $rest }»
too-many-premises = в вопросе больше { $most } условий
one-premise-must-affirm = нужно хотя бы одно условие без отрицания
too-many-answers = ответов больше { $most }
one-place-or-two = у «{ $relation }» мест { $n }, а бывает одно или два
bound-by-no-premise = «{ $name }» ни одно условие не связывает
anything-is-not-compared = «_» ни с чем не сравнивается

# Ответы на вопросы словами.

question-not-understood = вопрос не понят. Можно спросить: «В каких корпусах есть свободные стулья?», «Какой робот последним видел Чашку-1?», «Что изменилось за неделю?», «Где карты и представления расходятся больше всего?»
no-such-kind = на картах нет вещей вида «{ $noun }»; есть, например: { $some }
in-none = Ни в одном.
seen-by-none = Её не видел ни один робот, или её нет на картах.
nothing-changed = Ничего.
was-changed = { $at } { $building }: { $reason } ({ $author }) – { $robot }, записей { $records }
apart-nowhere = Нигде: всё там, где на картах.
apart-there = { $building }: вещей { $things }; дальше всего, см: { $farthest }

# Что отправлено и что принято.

frames-sent = Кадров отправлено: { $frames }{ $whole ->
        [yes] , хранилище целиком
       *[no] {""}
    }; в центре – до { $sequence }.
nothing-new = Нового в центре нет.
same-map = Карта уже такая, как в центре (ревизия { $centre }).
map-taken = Принята карта центра, ревизия { $centre }; здесь это ревизия { $revision }.
maps-apart = Карта центра (ревизия { $centre }) и своя разошлись; остались обе:
at-the-centre = в центре
at-the-robot = здесь
taken-from-centre = центр, ревизия { $centre }: { $reason }
