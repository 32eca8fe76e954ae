# What is wrong with a corridor file, or with a question about the way.

corridor-file = the corridors are not accepted, faults: { $count }
corridor-file-help = correct the places that are marked

corridor-unknown-room = unknown room “{ $room }”: no entrance of this name is on the corridors
    .help = { $hint }
corridor-unknown-vertex = the corridors have no vertex { $vertex }
    .help = the vertices are numbered: { $known }
corridor-several-entrances = the room “{ $room }” has several entrances: the vertices { $vertices }
    .help = name a vertex (such as #{ $example }), or the last arc that was driven
corridor-unknown-arc = the graph has no arc ({ $from }, { $to })
    .help = the last arc leads to the vertex { $to } from one beside it: { $neighbours }
corridor-last-arc-elsewhere = the robot cannot stand at the vertex { $vertex } if the last arc was ({ $from }, { $to })
    .help = the last arc must lead to the vertex { $vertex }; if the heading is not known, leave it out
corridor-unreachable = the corridors do not lead from “{ $from }” to “{ $to }”
    .help = { $hint }
corridor-at-junction = the vertex { $vertex } is a junction: the second kind of graph has no such vertex
    .help = begin at an entrance, or take the first kind of graph
corridor-heading-needed = the vertex { $vertex } is a junction: without a heading it cannot be said where to turn
    .help = name the last arc that was driven
corridor-goal-is-junction = the goal is the vertex { $vertex }, a junction and no entrance
    .help = name a room, or the vertex of an entrance
corridor-no-length = the length of the stretch ({ $from }, { $to }) is not known, and the way is to be measured in metres
    .help = give metres for all stretches, or measure = "arcs"
corridor-unknown-map = the world has no map of the number { $map }
corridor-no-corridors = the map “{ $name }” has no corridors
    .help = give corridors a type of rooms with the trait corridor

corridor-syntax = the text is no TOML: { $message }
    .help = an example: maps/corridor-paper4.toml
corridor-notation = this is no corridor file: the text begins as JSON, and a corridor file is TOML
    .help = an example: maps/corridor-paper4.toml; on a map: ortho corridor --map FILE
corridor-unknown-field = unknown field “{ $field }”
    .help = { $hint }
    .at = this field
corridor-missing-field = the field “{ $field }” is missing
    .help = { $hint }
corridor-wrong-value = field “{ $field }”: { $expected } is needed
    .help = correct the value
    .at = this value
corridor-unknown-format = unknown format { $found }
    .help = this version of the program reads format = 1
    .at = this number
corridor-empty = the description has no corridor
    .help = add [[corridor]] with a list along
corridor-room-and-junction = the vertex { $vertex } is both an entrance and a junction
    .help = keep room with side, or junction; different places have different numbers
corridor-repeated-entrance = the entrance { $vertex } stands elsewhere already
    .help = each entrance is described once; only a junction is common to two corridors
    .at = the second time here
    .first = the first time here
corridor-undeclared-vertex = nowhere is said whether the vertex { $vertex } is an entrance, or what junction it is
    .help = give room and side (an entrance) or junction (its kind) in one corridor at least
corridor-vertex-meets-itself = the vertex { $vertex } stands twice running in the list
    .help = remove the repetition; closed = true closes a ring
    .at = the second time here
corridor-ahead-not-at-end = the door of the vertex { $vertex } is ahead, but the corridor goes on behind it
    .help = only the door at the end of a blind alley is ahead: the first or the last of the list
    .at = this side
corridor-junction-without-approach = no stretch of this corridor leads to the junction { $vertex }
    .help = a junction is described as it looks from this corridor: add the vertex beside it
corridor-no-such-way = junction { $vertex }: the kind “{ $kind }” has no way { $way }
    .help = the ways of this kind: { $ways }
    .at = this way
corridor-no-such-neighbour = junction { $vertex }: it has no neighbour { $neighbour }, or several corridors lead to that
    .help = the neighbours as described: { $neighbours }
    .at = this neighbour
corridor-arms-disagree = junction { $vertex }: the kind “{ $kind }” takes { $wanted } corridors, and { $found } are described (neighbours { $neighbours })
    .help = correct the kind, add a corridor, or mark the empty way: blind = ["right"]
    .at = this kind
corridor-ambiguous-arms = junction { $vertex }: it is not clear which corridor leads where (neighbours { $neighbours })
    .help = name the neighbours as seen from this corridor: straight = …, right = …, left = …
    .at = this junction
corridor-junction-disagrees = junction { $vertex }: here it is “{ $said }”, and by another corridor’s description it looks “{ $seen }” from here
    .help = one junction looks different from different sides; correct one of the descriptions
    .at = this description
    .first = the other description
corridor-way-disagrees = junction { $vertex }: the way { $way } leads from here to “{ $said }”, and by another corridor’s description to “{ $seen }”
    .help = correct one of the descriptions
    .at = this way

# Words and phrases of which what is said is put together.

a-dead-end = a dead end
perhaps-2 = perhaps “{ $near }”?
the-description-has-no-entrance = the description has no entrance
there-are-entrances = there are entrances: { $known }
is-on-on-a-lift-is-needed = “{ $from }” is on “{ $floor }”, “{ $to }” on “{ $other }”: a lift is needed
their-corridors-are-not-joined = their corridors are not joined
in-the-first-line-format-1 = in the first line: format = 1
a-number-from-0-to-1000000 = a number from 0 to 1000000
tables-corridor = tables [[corridor]]
true-or-false = true or false
an-entry-like-vertex-0 = an entry like {"{"} vertex = 0, … {"}"}
a-positive-number-of-metres = a positive number of metres
the-vertexs-number-such-as-vertex-7 = the vertex’s number, such as vertex = 7
an-integer-from-0-to-4294967295 = an integer from 0 to 4294967295
on-which-side-the-door-is-side = on which side the door is: side = "right" or "left"
which-room-is-behind-the-door-room = which room is behind the door: room = "201"
the-kind-of-the-junction-junction-branch = the kind of the junction: junction = "branch-right"
here-there-may-be = here there may be: { $known }
a-list = a list [ … ]
a-text-in-quotation-marks-not-empty = a text in quotation marks, not empty
an-integer = an integer
one-of-the-words = one of the words: { $words }
at-the-goal = The robot is at its goal already.
no-numbers = none

# What one does along a corridor: as an entry of a table and as a sentence.

face-right = stand along the corridor with the door on the right
face-left = stand along the corridor with the door on the left
face-ahead = stand with your back to the door
to-junction = drive to the corridor junction
take-straight = go straight on
take-right = turn right
take-left = turn left
take-nth = take the { $nth } corridor from the right
to-door-right = drive to the door on the right
to-door-left = drive to the door on the left
to-door-ahead = drive to the door straight ahead
u-turn = make a U-turn
stand-right = Stand along the corridor with the door on the right.
stand-left = Stand along the corridor with the door on the left.
stand-ahead = Stand with your back to the door.
drive-to-junction = Drive to the corridor junction.
drive-past-entrances = Drive past { $passed } { $passed ->
        [one] entrance
       *[other] entrances
    } to the corridor junction.
drive-to-entrance = Drive to the { $nth } entrance, the door { $side ->
        [right] on the right
        [left] on the left
       *[ahead] straight ahead
    }.
go-straight = Go straight on.
turn-right = Turn right.
turn-left = Turn left.
turn-nth = Take the { $nth } corridor from the right.
make-u-turn = Make a U-turn.

# What an entrance is called that has neither a door nor a name.

exit = Exit
