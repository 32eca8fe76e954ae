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

# Why a file was not read.

file-too-large = too large: at least { $bytes } bytes, and the limit is { $limit }
file-silent = nothing has come for { $seconds } s
file-not-text = no text in UTF-8: byte { $at }

# Why a number is no length and no angle, and words are no time.

number-not-finite = a number must be finite, not { $value }
length-too-large = a length of { $length } is beyond the limit of ±{ $limit }
not-a-time = a time is written like 2026-11-21T09:30:00.000Z

# What texts are called that are no files.

own-order = order
own-edit = edit
own-assumption = assumption
own-measurements = measurements (built in)
own-relations = rules/relations.dl (built in)

# Units.

cm = cm
m = m
a-second = { $length }/s
