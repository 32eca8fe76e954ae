# What is wrong with a log of scans, a sensor, a picture.

vectors-log = not all of the log is read, faults: { $count }
vectors-log-help = the other lines are read

vectors-log-unknown = the log is of no known format
    .help = a CARMEN log (FLASER, ROBOTLASER1), a table of ranges with a heading, or BreezySLAM’s rows of numbers are read
    .at = the first line
vectors-log-empty = the log has no scan
    .help = scans are lines FLASER, ROBOTLASER1 or RAWLASER1
    .at = the log begins here
vectors-log-not-number = “{ $found }” is no number
    .help = a number stands here, its fraction after a point
    .at = this word
vectors-log-no-place = “{ $found }” is no place
    .help = a coordinate of a pose is a finite number, less than 10⁷ m or rad
    .at = this number
vectors-log-beams = “{ $found }” beams cannot be
    .help = an integer from 0 to 65536
    .at = the number of beams
vectors-log-field = { $count } beams: the log does not say how wide they look
    .help = give the step in degrees by a line “PARAM laser_front_laser_resolution 0.25”
    .at = this line
vectors-log-cut = the line breaks off: it has { $found } words, { $needed } are needed
    .help = complete the line, or remove it
    .at = here the line ends
vectors-log-too-long = the line has { $found } words, { $needed } are due
    .help = remove what is too much; part two lines that ran together
    .at = too much from here on
vectors-log-no-message = “{ $found }” is no message of a log
    .help = a line of a CARMEN log begins with the name of its message; remove a torn piece
    .at = the line begins so
vectors-log-column-twice = the column “{ $column }” is named twice
    .help = keep one of the two
    .at = the second time
vectors-log-unit = the unit of the column “{ $found }” is unknown
    .help = lengths in m, cm or mm, angles in rad or deg, time in s, ms, us or ns
    .at = this column
vectors-log-heading = the heading has no column “{ $column }”
    .help = a heading: angle_min, angle_increment, range_min, range_max, then ranges0, ranges1, …; angles in rad, lengths in m
    .at = the heading
vectors-log-sensor = the sensor cannot be: { $fault }
    .help = correct the angles and ranges of this line
    .at = this line

vectors-sensor-field = { $count } beams, each { $step } rad on from { $first } rad, are no field of view
    .help = a step above zero, 0 to 65536 beams, no more than a full turn together
vectors-sensor-reach = a range from { LENGTH($nearest, places: 2) } to { LENGTH($farthest, places: 2) } cannot be
    .help = 0 ≤ nearest < farthest ≤ 100 000 cm
vectors-sensor-noise = an error of { $it0 } cannot be
    .help = range: above 0 cm; share and angle: from 0

vectors-picture-size = a picture of { $width }×{ $height } is not made of { $pixels } points
    .help = the points are width × height, and no side is longer than 16384
vectors-picture-file = the picture cannot be read: { $reason }
    .help = a whole PNG file is needed
