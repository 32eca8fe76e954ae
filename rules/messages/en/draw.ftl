# Why there is no drawing.

draw-svg = the drawing cannot be read as SVG: { $message }
    .help = give an SVG that this program made
draw-size = a picture of { $width }×{ $height } points does not fit into memory
    .help = take a smaller width: --width 2000

# What is written on drawings.

facade = Façade
profile = Profile
plan = Plan
dimensions-in-centimetres = Dimensions in centimetres
metres = { $number } m
square-metres = { $number } m²
view = View. { $room }: ({ $x }, { $y }) { UNIT() }, heading { $heading }°, eye { $height } above zero, angle of view { $field }°

# The legend.

wall = wall
window = window
passage = opening
stairs = stairs
lift = lift: a cross
place = place
vertex = vertex of the Passframe network
edge = crossing between Passframes
doorway-edge = crossing through a doorway
doorway = doorway
robot = robot
route = route
start = start
goal = goal
badge = number of a directive
fixed = furniture
movable = movable
portable = portable
overhead = overhead
passframe = Passframes
dead-zone = dead zones
sight = floor in view
seen = faces in view
door = door
swing = way of a leaf
locked = locked
keep-out = keep-out zone
closed = closed zone
slow = slow zone
one-way = one-way zone
