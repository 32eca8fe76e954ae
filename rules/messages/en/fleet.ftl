# What is wrong between a robot and the centre.

fleet-database = database: { $what }
    .help = see that the server runs and the address is right
fleet-key = no such key
    .help = get a key: ortho-fleet key
fleet-forbidden = this key may not do that
    .help = another kind of key is needed: ortho-fleet key
fleet-gap = frame { $came } came after frame { $have }
    .help = send the frames from the next one on
fleet-diverged = frame { $sequence } is another here: the robot's store went another way
    .help = send the whole store
fleet-content = { $what }
fleet-line = centre “{ $url }”: { $what }
    .help = check the line and the address
fleet-plain = without TLS the server listens to this machine only, not to { $address }
    .help = give --cert and --tls-key, or listen to 127.0.0.1
fleet-plain-database = there is no connection without TLS to the database at { $host }
    .help = take sslmode=disable out of the address; a certificate of one's own: --db-authority
fleet-moved = the centre's map has changed meanwhile: it is at revision { $revision }
    .help = look at the new revision and try again
fleet-unknown = the centre does not have: { $what }
fleet-held = the centre's map will wait: { $why }
    .help = try again later (push --pull does by itself), or close the program that holds the store
fleet-io = { $path }: { $source }

# Words and phrases of which what is said is put together.

robot-of-building = robot { $robot } of building { $building }
key-named = the key “{ $name }”
storey-of-building = a storey of building { $building }
map-of-building = a map of building { $building }
building-numbered = building { $building }
map-has-no-domain = the map has no Domain
robot-numbers-begin-at-one = a robot's number is more than zero: zero is the centre
no-random-numbers = there are no random numbers: { $why }
packing-unknown = the encoding “{ $packing }” is unknown
packed-unreadable = what is packed cannot be read: { $why }
too-much-at-once = too much at once
these-are-no-frames = these are no frames of a journal
number-too-large = the number { $n } is too large
frame-numbered = the frame's number is { $sequence }
centre-does-not-go-on = the centre does not go on
centre-map-unreadable = the centre's map cannot be read
step-was-another = step { $step } is done already, but was another
no-certificate = there is no certificate

# Questions to the facts of all buildings.

question-unreadable-at = the question cannot be read at “{ $rest }”
too-many-premises = the question has more than { $most } premises
one-premise-must-affirm = at least one premise without a negation is needed
too-many-answers = there are more than { $most } answers
one-place-or-two = “{ $relation }” has { $n } places, and there may be one or two
bound-by-no-premise = no premise binds “{ $name }”
anything-is-not-compared = “_” is compared with nothing

# Answers to questions in words.

question-not-understood = the question is not understood. Ask: “In which buildings are there free chairs?”, “Which robot last saw Cup 1?”, “What changed this week?”, “Where do maps and beliefs disagree most?”
no-such-kind = no map has things of the kind “{ $noun }”; there are, for example: { $some }
in-none = In none.
seen-by-none = No robot has seen it, or no map has it.
nothing-changed = Nothing.
was-changed = { $at } { $building }: { $reason } ({ $author }) – { $robot }, records { $records }
apart-nowhere = Nowhere: all is where the maps have it.
apart-there = { $building }: things { $things }; farthest, cm: { $farthest }

# What was sent and what was taken.

frames-sent = Frames sent: { $frames }{ $whole ->
        [yes] , the whole store
       *[no] {""}
    }; the centre has them up to { $sequence }.
nothing-new = The centre has nothing new.
same-map = The map is the same as the centre's already (revision { $centre }).
map-taken = The centre's map was taken, revision { $centre }; here it is revision { $revision }.
maps-apart = The centre's map (revision { $centre }) and this one went apart; both stay:
at-the-centre = at the centre
at-the-robot = here
taken-from-centre = the centre, revision { $centre }: { $reason }
