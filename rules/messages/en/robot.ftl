# What is wrong with the vehicle that is driven.

vehicle-no-connection = there is no connection to the robot "{ $address }": { $why }
    .help = see that the robot's program is there and starts, or that it waits at this address
vehicle-lost = the connection to the robot was lost at "{ $asked }"
    .help = see what the robot's program wrote
vehicle-timed-out = the robot did not answer "{ $asked }" within { $seconds } s
    .help = each order wants an answer, and messages of the way while it is under way; see docs/vehicle.md
vehicle-rubbish = the robot answered "{ $asked }" with what the protocol does not know: { $why }: "{ $said }"
    .help = docs/vehicle.md describes the messages
vehicle-version = the robot speaks version { $theirs } of the protocol, version { $ours } is wanted
    .help = docs/vehicle.md describes the versions of the protocol
vehicle-off-the-way = the robot says that it is at { $pose }: { LENGTH($off) } off the way on which it was sent
    .help = a pose is in the frame of the map, in centimetres
vehicle-wrong-heading = the robot says that it is at { $pose }: it faces { ROUND($off) }° away from where it was told to
    .help = a heading is in degrees counter-clockwise from the x axis of the map
vehicle-wrong-map = the robot says that it is on another map than that on which it was sent
    .help = only a ride in a lift changes the map
vehicle-off-the-map = the robot says that it is at { $pose }: the map has no room there
    .help = a pose is in the frame of the map, in centimetres
vehicle-no-number = the robot told a pose or a time that cannot be
    .help = numbers are finite, and time does not go back
vehicle-own-fault = the robot failed: { $text }
    .help = see what the robot's program wrote
vehicle-nowhere = the robot does not know where it is: { $why }
    .help = say where it stands (--from), or bring it to where there is more to see
vehicle-restless = the robot saw the same thing otherwise each time, { $times } times
    .help = see what the robot says that it saw

# Words and phrases of which what is said is put together.

a-line-that-is-too-long = a line that is too long
it-answers-order-and-order-was-given = it answers order { $of }, and order { $id } was given
the-map-has-no = the map has no “{ $name }”
it-is-no-answer-to-such-an = it is no answer to such an order
a-quotation-mark-is-not-closed = a quotation mark is not closed
a-command-is-wanted-behind-cmd = a command is wanted behind cmd:
tcp-host-port-is-wanted = tcp:HOST:PORT is wanted
rest-by-search = {" "} the rest is proven by search: all plans shorter than { $steps } are ruled out
wishes-met = All wishes are met: { $all }.
wishes-least = no plan fails less, proven
wishes-maybe-less = whether less will do is unknown
wishes-unmet = Wishes not met: { $unmet }; { $weight } in all, { $least }.
and-that = and that
goals-exclude = {"the goals exclude each other: that "}
goals-out-of-reach = {"the goals are out of reach all together: that "}
floor-has-no-way = {"by the rules there is a plan, but the floor has no way for the actions: "}
no-plan-in-time = the time was up before a plan was found
no-plan-in-memory = the memory was used up before a plan was found
no-plan-within-steps = there is no plan within the greatest number of steps
no-plan-before-stop = the search was stopped before a plan was found
no-plan-in-effort = the effort allowed was spent before a plan was found
proven-steps = { $ended }; proven: at least { $least } steps are needed
tried = tried
ended-by-time = the time was up
ended-by-memory = the memory was used up
ended-by-steps = the greatest number of steps
ended-by-stop = the search was stopped
ended-by-effort = the effort allowed was spent
shorter-plan-open = { $ended } before a shorter plan was found or ruled out; it takes { $at_least } to { $most } steps
way-grounding = making ground actions of the rules
way-graph = the planning graph
way-proof = the proof of the fewest steps
way-forward = search forward
levels = levels: { $levels }
nodes = nodes: { $nodes }
effort = effort: { $effort }
times = times: { $times }
its-range-finder-tells-of = its range finder tells of nothing
the-map-has-no-such = the map has no such storey
sees-several = what it sees fits several places
sees-too-many = what it sees fits too many places
sees-too-little = it sees too little to know a place by
sees-unsurely = what it sees fits one place, but not so well as to be sure of it
sees-nowhere = what it sees fits nowhere on the map: the map is wrong, or it is off the map
why-so-many-steps = Why there are no fewer than { $steps ->
        [one] 1 step
       *[other] { $steps } steps
    }:
milestones = {"  "}in every plan it comes to be, one after the other, that { $row }: that is { $steps ->
        [one] 1 step
       *[other] { $steps } steps
    } at least
then = {", then that "}
goal-alone = {"  "}the goal that { $goal } takes { $steps ->
        [one] 1 step
       *[other] { $steps } steps
    } alone

cmd-or-tcp-is-wanted = cmd:COMMAND or tcp:HOST:PORT is wanted

# What is seen and is not on the map is called so.

obstacle = Obstacle
obstacle-numbered = Obstacle { $number }
