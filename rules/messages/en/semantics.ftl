# Why there are no relations.

semantics-unreadable = the rule file “{ $path }” cannot be read: { $message }
    .help = check the path and the permissions; the file must be UTF-8
semantics-too-large = the rule file “{ $path }” is too large: { $bytes } bytes, and the limit is { $limit }
    .help = rules are a text that a person wrote; see whether this is the right file
semantics-empty = the rule file “{ $path }” is empty
    .help = remove it, and the rules of the program itself hold
semantics-schema = { $fault }
    .help = what is measured is declared in rules/relations.dl; its columns cannot be changed
semantics-thresholds = { $first }
semantics-unknown-relation = there is no relation “{ $name }”
    .help = { GIVEN($nearest) ->
        [yes] perhaps “{ $nearest }”?
       *[no] the names of relations stand in rules/relations.dl
    }

# Words and phrases of which what is said is put together.

a-length-in-tenths-of-a-millimetre = a length in tenths of a millimetre, from 0 to 1000000 (100 m)
an-angle-in-hundredths-of-a-degree = an angle in hundredths of a degree, from 0 to 18000
a-share-in-thousandths-from-0-to = a share in thousandths, from 0 to 1000
a-number-of-times-from-1-to = a number of times, from 1 to 1000
a-solid-angle-in-millionths-of-a = a solid angle in millionths of a steradian, from 0 to 12566370
there-is-no-profile = there is no profile “{ $profile }”
there-are-common-surveyed-and-detected = there are common, surveyed and detected
the-threshold-cannot-be = the threshold “{ $name }” cannot be { $value }
the-threshold-is-given-twice-and = the threshold “{ $name }” is given twice: { $first } and { $value }
keep-one-here-or = keep one: here or { $place }
the-limit-of-measuring-cannot-be = the limit of measuring “{ $name }” cannot be { $value }
it-is = it is { $what }
semantics-threshold = { $message }
