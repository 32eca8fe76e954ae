# What all parts of the program say alike.

here = here
and-here = and here
