# What all parts of the program say alike.

here = here
and-here = and here

# After a word that is not known.
perhaps = { GIVEN($nearest) ->
        [yes] ; perhaps “{ $nearest }”?
       *[no] {""}
    }

# Between names.
between-names = { ", " }
