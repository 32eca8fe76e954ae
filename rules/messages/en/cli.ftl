# Why settings cannot be used.

config-unreadable = “{ $path }” cannot be read: { $reason }
    .help = check the path and the permissions
config-syntax = settings: { $what }
    .help = there are: language, store, rules, vehicle, user, color, units (docs/cli.md)
truth-left-behind = --truth: stays behind, though what bears it goes: { $names }; carry = true takes it along.
the-map-is-sound = The map is sound.
genitive = genitive
and-more = and more:
guessed-forms = Russian forms of names guessed by their endings (the map may give them in the field forms; all forms: ortho words NAME)
no-such-facts = There are no such facts.
to-open-a-way = To open a way:
variant = { $name }{ $floor }: variant { $number }
there-already = You are there already.
stored = Stored as revision { $revision }.{"\u000A"}
bring-the-medicine = Bring the medicine
map = Map
derived-from-the-geometry = Derived from the geometry:
drawing = Drawing:
one-of-poses = { $is_one_of } poses fit; the best is shown.
in-view = { $name } – { $share }% in view, { $away }
scan-unplaced = Where it was taken is not known.
metres = m
written = Written
no-mask = There is no mask: no zone that is shut or slow is in force now.
output-broke-off = output broke off
nothing-changed = nothing changed
revision = Revision
one-of-places = one of { $several } places
scan = Scan
what-would-tell = What would tell
place-unknown = place unknown
outside-of-rooms = That is outside of all rooms.
recording-cut = The recording breaks off after { $lasted } s: { $cut }.
torn-record = { $store }: the last record was cut off and not confirmed; { $bytes } bytes are dropped.
the-store = The store
tables-rebuilt = the tables are built anew from the journal
journal-rewritten = the journal is written anew from the tables
read-from-tables = read from the tables, since the journal is incomplete (opening to write mends it)
tables-off = the tables are not kept, everything stays in journal and snapshots
past-rewritten = a file of the past was lost or broken, and is written anew from its twin
read-only = it cannot be written
mark-renewed = was lost or broken
believed-at = { $name }: { $here }, since { $since }, { $sure } % sure – { $map }{ $missed }.
map-corrected = The map is corrected, revision
proposal-rejected = Rejected: the thing is held to stand where the map has it.
no-proposals = There are no proposals.
as-on-the-map = as on the map
on-the-map = on the map:
not-on-the-map = not on the map
not-there = not there
remedy-any = --any (a plan soon, not proven to be the shortest)
remedy-effort = more effort (--effort)
remedy-time = more time (--time-limit)
remedy-memory = more memory (--memory-limit)
it-would-help = {"It would help: "}
or = {" or "}
no-fact-holds-this = no fact holds this
yes = Yes.
no = No.
no-answers = There are no answers.
pose-lies-in-region = The pose lies in it.
pose-lies-elsewhere = The pose does not lie in it.
such-as = {", such as "}
region = Region
square-metres = m²
anywhere = anywhere
in-the-doorway = in the doorway
at-the-door-or-passage = at the door or passage
on-a-thing = on a thing
next-to-a-thing = next to a thing
in-a-corner = in a corner
by-a-wall = by a wall
in-the-middle = in the middle
recording-of = Recording of “{ $domain }”, { $at }.
thin-at = {" "} thin at { $point }
scans-without-pose = Without a pose, left out: { $without_pose }
px = px
open-in-a-browser = Open in a browser:
revision-written = Revision { $revision }: { $created } records created, { $changed } changed, { $deleted } deleted.
store-checked = { $verdict }: transactions { $lsn }, revisions { $revision }, records { $records } (with history), snapshots { $snapshots }.
store-restored = The store { $dir } is restored, revision { $revision }.
written-and-read-back = Written and read back:
room-not-freed = Their room on the disk is freed by the next snapshot, this one is not written
versions-forgotten = Versions forgotten:
import = import
edit = edit
undo = undo
redo = redo
calls-unread = lines of calls do not read
no-changes-yet = There are no changes yet.
no-differences = There are no differences.
no-records-changed = Nothing changed.
note = note
mendable = mendable
broken = BROKEN
store-sound = The store is sound
store-broken = The store is broken
store-mendable = The next opening mends the store
talk-begins = Ask or command; Tab completes names, an empty line ends.
ctrl-c-again = Ctrl-C again or Ctrl-D ends.
line-is-no-text = This line is no UTF-8 and cannot be read.
is-the-way-clear = {"     Is the way clear? (yes/no)"}
end-is-taken = {"\u000A"}{ $what } is taken: the robot does not fit there; the nearest place is { $to }.
plan-rested-on-it = the plan before rested on this
plan-did-not-rest = the plan before did not rest on this
no-plan-before = there was no plan before either
withdrawn = Withdrawn
passframes = Passframes:
points = Points
the-start = The start
the-goal = The goal
the-robot-waits-at = The robot waits at
order-not-understood = An order was not understood
first-storey-drawn = The first storey is drawn.
it-does-hold = It does hold:
does-not-hold = does not hold; the nearest rule
not-measured = was not measured, and no rule derives this relation
animate = , animate
arguments = arguments
nothing-changes = Nothing changes.
whole-from-3-to-360 = whole, from 3 to 360

# Tables, and the words in them.

relation = Relation
relation-in-english = English name
count = Count
code-crossing = crossing
code-t-junction = T-junction
code-branch-right = branch right
code-branch-left = branch left
code-turn-right = turn right
code-turn-left = turn left
code-star = star, ways are counted from the right
code-door-right = door on the right
code-door-left = door on the left
code-door-ahead = door ahead
sign-entrance = entrance of a room
sign-junction = junction of corridors
sign-arc = arc with the code of what it leads to
sign-plain-arc = drive from entrance to entrance
sign-way = the way
sign-u-turn = U-turn
end-corner = corner
end-free = free
end-given = given
end-occluded = occluded
end-range = range
end-field = field
end-unclear = unclear
from-the-map = from the map
from-the-word-list = from the word list
from-the-dictionary = from the dictionary
by-its-ending-surely = by its ending, surely
by-its-ending-a-guess = by its ending, a guess
plural = { $number }
gender = { $gender }
forms-uncertain = The forms are uncertain; the map can give them: forms = { $example }
name-wanted = a name or a word is needed: ortho words "Desk"

# What was counted.

records = { $created } records created, { $changed } changed, { $deleted } deleted
rooms-of-log = { $path }: { $rooms } rooms, { $doors } doorways, { $things } things.
picture = Picture: { $segments ->
        [one] 1 segment
       *[other] { $segments } segments
    }
scan-of = Scan { $scan } of { $scans }, line { $line }: { $beams ->
        [one] 1 beam
       *[other] { $beams } beams
    }, { $returns } returned, { $segments ->
        [one] 1 segment
       *[other] { $segments } segments
    }
things-joined = { $things ->
        [one] 1 thing
       *[other] { $things } things
    }, { $scans ->
        [one] 1 scan
       *[other] { $scans } scans
    } joined
thing-seen = { $id }. at { $at }: { $segments ->
        [one] 1 segment
       *[other] { $segments } segments
    }, { $whole } whole
known-again = { $segments ->
        [one] 1 segment
       *[other] { $segments } segments
    } known again, { $gone } not found, { $new } new
part-moved = {"  "}{ $segments ->
        [one] 1 segment
       *[other] { $segments } segments
    }: shift { $shift } { $unit }, turn { $turn }°
described = “{ $name }”: { $maps ->
        [one] 1 map
       *[other] { $maps } maps
    }, { $rooms ->
        [one] 1 room
       *[other] { $rooms } rooms
    }, { $doors ->
        [one] 1 door
       *[other] { $doors } doors
    } (passages among them), { $things ->
        [one] 1 thing
       *[other] { $things } things
    } ({ $objects ->
        [one] 1 object
       *[other] { $objects } objects
    }, { $orthoframes ->
        [one] 1 Orthoframe
       *[other] { $orthoframes } Orthoframes
    }), { $places ->
        [one] 1 place
       *[other] { $places } places
    }.
plan-works = The plan works: { $steps ->
        [one] 1 step
       *[other] { $steps } steps
    }, { $actions ->
        [one] 1 action
       *[other] { $actions } actions
    }, cost { $cost }.
plan-breaks = The plan breaks at step { $step }:{ $reasons }
plan-misses = The plan can be carried out, but misses its goal:{ $reasons }
plan-found = A plan is found: { $steps ->
        [one] 1 step
       *[other] { $steps } steps
    }, { $actions ->
        [one] 1 action
       *[other] { $actions } actions
    }; a shorter one is sought.
plan-bound = Proven: at least { $least } steps are needed.
no-way = { $why }
way-length = { $from } → { $to }: { $length } m
task-quoted = Task: "{ $order }"
in-the-robots-hand = { $name }: in the robot's hand.
handed-to = { $name }: handed to { $who }.
missed = ; a look at { $at } did not find it there
source-map = map, revision { $revision } ({ $user })
source-seen = seen by { $observer }, { $sure } % sure
working = { $spinner } working, { $elapsed }
left-behind = Stays behind, though what bears it goes: { $names }; --carry takes it along.
edit-written = Revision { $revision } is written.
edit-right = All is right; nothing was written.
