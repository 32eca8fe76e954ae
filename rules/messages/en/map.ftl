# What is wrong with a map, an edit of a map, a truth about the building.

map-faults = map “{ $name }”: { map-counted }
map-nameless-faults = map: { map-counted }
map-counted = { $errors ->
        [1] { $errors } error
       *[other] { $errors } errors
    }, { $warnings ->
        [1] { $warnings } warning
       *[other] { $warnings } warnings
    }

map-unreadable = the file “{ $path }” cannot be read: { $message }
    .help = check the path of the file; a map is a text in UTF-8
map-too-large = the map file is too large: { $bytes } bytes, the limit is { $limit }
    .help = divide the map into several files
map-empty = the map file is empty
    .help = a map begins with the line `format = 1`; an example is maps/lab.toml
map-syntax = no valid { $format }: { $message }
    .help = mend this place; an example is maps/lab.toml
map-format = unknown version of the format: { $found }
    .help = this program reads maps of version 1: `format = 1`
map-unknown-field = unknown field “{ $field }”{ perhaps }
    .help = these fields may stand here: { $expected }
map-missing-field = the field “{ $field }” is missing
    .help = add the field “{ $field }”
map-wrong-kind = { $found } stands here, and { $expected } is needed
    .help = replace the value; needed is { $expected }
map-unknown-word = unknown word “{ $word }”{ perhaps }
    .help = one of these words may stand here: { $expected }
map-bad-value = bad value: { $message }
    .help = mend the value
map-out-of-range = { $what } = { $value }, and must be { $range }
    .help = make { $what } { $range }
map-unknown-reference = { $what } “{ $name }” does not exist{ perhaps }
    .help = correct the name, or describe { $what } “{ $name }”
map-ambiguous-name = the name “{ $name }” can mean several: { $candidates }
    .help = name one of them in full
map-bad-reference = the reference “{ $text }” makes no sense
    .help = write the reference as { $wanted }
map-duplicate-id = { $what }: the number { $id } is given twice
    .help = remove the field id, or give another number
map-dangling-id = { $owner }: there is no { $what } of the number { $id }
    .help = add what is missing, or remove the reference
map-duplicate-name = two bear the name “{ $name }”: { $first } and { $second }
    .help = give each a name of its own, such as “{ $other }”
map-no-name = { $what } without a name
    .help = give it a name in the field name
map-bad-id = { $owner }: bad id “{ $id }”
    .help = an id is not empty, holds no dot, and is none of base, roof, база, потолок
map-duplicate-part = { $owner }: the id “{ $id }” is given twice
    .help = ids of parts and sides do not repeat
map-bad-zone = { $owner }: { $message }
    .help = mend the zone; how one is written: docs/map.md
map-base-form = Orthoframe “{ $name }”: the Base is given in { $count } ways instead of one
    .help = keep one of the fields rect, regular, points, sides
map-base-too-short = Orthoframe “{ $name }”: the Base has { $count } vectors and needs at least three
    .help = describe a closed polygon of three sides or more
map-base-zero-length = Orthoframe “{ $name }”: the vector { $side } has no length, at { $at }
    .help = remove the vector { $side }, or move its ends apart
map-base-not-connected = Orthoframe “{ $name }”: the Base is not connected: the vector { $side } ends at { $end }, and the next, { $next }, begins at { $start }
    .help = begin the vector { $next } at { $end }
map-base-not-closed = Orthoframe “{ $name }”: the Base is not closed: the last vector { $side } ends at { $end }, and the first, { $next }, begins at { $start }
    .help = end the vector { $side } at { $start }
map-base-crosses-itself = Orthoframe “{ $name }”: the Base crosses itself: the vectors { $side } and { $other } meet at { $at }
    .help = place the corners so that the sides do not meet
map-base-clockwise = Orthoframe “{ $name }”: the vectors of the Base run clockwise
    .help = write the corners counter-clockwise, or add `reverse = true`
map-base-no-area = Orthoframe “{ $name }”: the Base has no area
    .help = the corners of the Base lie on one line: move them apart
map-negative-height = Orthoframe “{ $name }”: the height { $height } is negative
    .help = the height is the distance from Base to Roof, 0 or more
map-no-items = { $owner }: it has no parts
    .help = list the parts in the field items
map-base-item-count = { $owner }: { $count } base parts, and exactly one is needed
    .help = mark exactly one part with `base = true`
map-base-item-off-origin = { $owner }: no corner of the base part “{ $item }” stands at the origin; the nearest is { $nearest }
    .help = move the part so that a corner of it falls on [0, 0]; a map with coordinates of another names them in its field frame
map-unknown-item = { $owner }: there is no part “{ $item }”
    .help = there are the parts: { $known }
map-unknown-side = { $owner }: the part “{ $item }” has no side “{ $side }”
    .help = there are the sides: { $known }
map-link-faces = { $owner }: the link { $link } joins a horizontal face with an upright one
    .help = a Roof is linked with a Base, or a side with a side
map-link-contradicts = { $owner }: the link { $link } and the positions contradict: by the link { $claimed }, by the positions { $found }
    .help = correct the position (at, angle) of one of the parts, or the offset (rel, angle) of the link
map-link-length = { $owner }: the link { $link } joins openings of different widths: { $length } and { $other }
    .help = permeable and conditional sides are of equal length
map-link-permeability = { $owner }: the link { $link } joins faces of different permeability
    .help = make both sides permeable, or both impermeable
map-link-apart = { $owner }: the openings of the link { $link } do not meet: they are { $distance } apart
    .help = bring the sides together: their ends lie in the same points
map-items-overlap = { $owner }: the parts “{ $item }” and “{ $other }” overlap, for one at { $at }
    .help = move the parts apart: they may only touch
map-items-apart = { $owner }: the part “{ $item }” is not connected with the others
    .help = add a link in links, or move the part close
map-areas-overlap = { $map }: the areas “{ $area }” and “{ $other }” overlap, for one at { $at }
    .help = move one of the areas
map-areas-apart = { $map }: the area “{ $area }” is not connected with the others
    .help = link one of its sides with a neighbour's in the field links of the map
map-area-twice = the area “{ $area }” stands on maps twice
    .help = each area stands on one map, once
map-area-nowhere = the area “{ $area }” stands on no map
    .help = add it to the items of a map
map-domain-maps = the map “{ $map }” stands in the domain { $count } times, and must once
    .help = list each map once in the field maps of the domain
map-lift-stops = the lift “{ $lift }” joins no areas of different maps
    .help = list areas of two maps or more in stops
map-door-on-wrong-side = { $owner }: the door “{ $door }” hangs on the side { $side }, which does not fit it: { $why }
    .help = a door hangs on a conditional side (permeability = "conditional"), a passage on a permeable one
map-side-without-door = { $owner }: the conditional side { $side } has no door
    .help = hang a door in the field doors, or change the permeability
map-side-two-doors = { $owner }: the side { $side } has two doors
    .help = leave one door on the side
map-door-too-wide = { $owner }: the door “{ $door }”, { $width } wide, does not go into the side { $side }, { $length } long
    .help = make the door no wider than the side
map-door-too-high = { $owner }: the door “{ $door }”, { $height } high, is higher than the side { $side } with its { $wall }
    .help = make the door no higher than the area
map-door-unused = the door “{ $door }” hangs nowhere
    .help = name it in the field doors of an area or an object
map-door-mounts = the door “{ $door }” hangs { $count } times; a door joins at most two areas
    .help = make a door of its own for each opening
map-door-apart = door “{ $door }”: the sides { $side } and { $other } on which it hangs do not meet on the map
    .help = a door joins sides that are linked in the links of the map
map-door-direction = door “{ $door }”: both areas say that it opens { $way }
    .help = opens = "inside" for one of the areas, "outside" for the other
map-door-leaves = door “{ $door }”: { $why }
    .help = a door needs at least one leaf in leaves, a passage has none
map-leaf-shares = door “{ $door }”: the shares of its leaves sum up to { $sum }, not to 1
    .help = the shares (share) of all leaves sum up to 1
map-door-state = door “{ $door }”: an opening of { $opening } % does not go with the state “{ $status }”
    .help = a closed or locked door has an opening of 0, a passage without leaves of 100
map-replica-outside = “{ $replica }” stands outside its area “{ $area }”: its middle is at { $at }
    .help = correct at, or move the replica to another area
map-replica-through-wall = “{ $replica }” sticks through the walls of the area “{ $area }” by { $by }, as far as { $at }
    .help = move the replica away from the wall
map-replica-height = “{ $replica }” takes the heights from { $bottom } to { $top }, and the area “{ $area }” has { $floor } to { $ceiling }
    .help = correct the third number of at
map-place-outside = the place “{ $place }” lies outside its area “{ $area }”
    .help = correct at, or move the place to another area
map-bad-footprint = the robot's footprint: { $reason }
    .help = list the corners of a convex outline counter-clockwise, [ahead, left] of the centre, in cm
map-things-overlap = “{ $thing }” and “{ $other }” are in one another, for instance at { $at }
    .help = move them apart: correct the `at` of one of them
map-thing-hovers = “{ $thing }” hovers: { $height } above { $over }, and neither a wall nor the ceiling holds it
    .help = correct the third coordinate of `at`, or put beneath the thing what it stands on
map-doorway-barred = in the doorway “{ $door }”, { $width } wide, there stands { $things }: { $free } is free
    .help = move away from the doorway what is named, or correct the place of the door
map-place-under = the place “{ $place }” lies under “{ $thing }”: the robot cannot stand there
    .help = move the place to where the floor is free
map-names-nothing = { $property } names “{ $name }”, and there is no such { $what } on the map{ perhaps }
    .help = correct the name, or describe on the map what is named
map-unknown-state = { $property } = “{ $value }”: the program knows no such state
    .help = write { $wanted }; what else is to be said of the state stands in a property of its own
map-unknown-trait = the type “{ $owner }”: neither the program nor a rule knows the trait “{ $word }”{ perhaps }
    .help = the traits are known: { $known }; one of your own must stand in a rule file
map-metres = { $what }: the size is { $size }; are these metres?
    .help = lengths on a map are centimetres; if these are metres, write { $wanted }
map-more-alike = and { $count } more of this sort ({ $kind })
    .help = mend what is shown, and check the map again
map-no-edits = the edit file says nothing
    .help = describe what is new as in a map file, or a step: [[edit]] move = "Chair 1", to = [120, 80]
map-unknown-verb = unknown step “{ $found }”{ perhaps }
    .help = a step of an edit begins with one of these words: { $expected }
map-already-there = { $what } “{ $name }” is on the map already
    .help = give the new one another name; what is there is changed by steps [[edit]]: move, turn, set, rename, remove
map-still-used = { $what } “{ $name }” is still needed: { $by }
    .help = first remove what is named
map-not-bound = the door “{ $door }” does not hang there
    .help = remove this step, or correct from
map-not-linked = there is no link { $link }
    .help = remove this step, or correct the ends of the link
map-area-nowhere-yet = the area “{ $area }” stands on no map yet
    .help = first make it stand: [[edit]] stand = "{ $area }", map = …, at = [x, y]
map-other-building = { $what }: { $how }
    .help = a truth is the same building: doors open or locked, things moved, gone or new; where the building has changed, edit the map: ortho edit
map-carried = the robot, or whom it was handed to, has “{ $name }”, which stands nowhere on the map now
    .help = leave out the edit of this thing, or begin anew: ortho do … --reset
map-more = and { $count } more
    .help = mend what is shown, and check the map again
