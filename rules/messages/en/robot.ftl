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
