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
