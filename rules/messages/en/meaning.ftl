# What is wrong with grammar files.

language-faults = faults in the language files: { $count }

language-syntax = { $expected } is expected here
    .help = rules/language has examples of lines
language-unknown = unknown: { $what } “{ $name }”
    .help = { GIVEN($nearest) ->
        [yes] perhaps “{ $nearest }”?
       *[no] correct the name, or describe it in a line
    }
language-type-mismatch = “{ $name }”: { $found }, and { $wanted } is needed
    .help = compare with what this category gives in other lines
language-one-side = “{ $name }” stands on one side of “<-” only
    .help = what is named on the right must go into the meaning on the left, else the word would be lost
language-reserved = “{ $word }” has a meaning of its own, and cannot be a mere word of a phrase
    .help = name its category, so that negation, number or degree enter the meaning
language-forms = nobody knows the forms of the word “{ $word }”
    .help = write them out: один[nom m] | одна[nom f] | одного[gen m n]
language-nothing-required = nothing in the phrase is required
    .help = remove “?” or “*” from one part at least
language-twice = the same phrase is described already, with another meaning
    .help = keep one of the two lines
