# What is wrong with rules, facts and questions to them.

facts-in-file = “{ $name }”: { $errors ->
        [0] warnings { $warnings }
       *[other] errors { $errors }{ $warnings ->
            [0] {""}
           *[other] , warnings { $warnings }
        }
    }
facts-faults = faults in the rules: { $count }; the first: { $first }

facts-syntax = { $expected } is expected here, and { $found } stands there
facts-character = the sign “{ $character }” means nothing here
    .help = texts are written in double quotation marks
facts-unclosed = { $what } is not closed
    .help = put { $closing }
    .at = opened here
facts-number = the number “{ $text }” does not fit into 64 bits
facts-unsupported = not supported: { $what }
facts-misuse = { $what }
facts-too-large = { $what }: more than { $limit }
    .help = divide it into several rules or relations
facts-duplicate = “{ $name }” is declared twice
    .help = keep one declaration
    .at = the second declaration
facts-unknown-relation = unknown relation “{ $name }”
    .help = { GIVEN($nearest) ->
        [yes] perhaps “{ $nearest }”?
       *[no] declare it: .decl
    }
facts-unknown-type = unknown type “{ $name }”
    .help = { GIVEN($nearest) ->
        [yes] perhaps “{ $nearest }”?
       *[no] there are symbol, number, unsigned and what .type declares
    }
facts-unknown-component = unknown component “{ $name }”
    .help = { GIVEN($nearest) ->
        [yes] perhaps “{ $nearest }”?
       *[no] describe it: .comp
    }
facts-record = the record here has no known type: { $what }
    .help = a relation’s column gives the type, or a branch’s name ($Name), or as([…], Type)
facts-hint = { $what }: this hint has no effect here
    .help = what comes of the program does not depend on it
facts-wide = the number { $number } does not fit into 32 bits: Soufflé will compute otherwise with it
    .help = numbers have 64 bits here, and do not overflow silently
facts-rounded = the number { $number } is rounded to six digits: Soufflé’s binary fraction is slightly different
    .help = a float is an exact decimal fraction in millionths here
facts-long-text = a text longer than { $limit } bytes is not kept: rows with it are left out
    .help = a recursive rule with cat makes a text grow without end; bound it: strlen(x) < 1000
facts-pattern = “{ $pattern }” is no regular expression: nothing matches it
    .help = { $why }
facts-unsigned = the number “{ $text }” does not fit into 32 bits without a sign
    .help = unsigned is from 0 to 4294967295
facts-arity = “{ $name }” takes { $expected } arguments, and { $found } are given
    .help = compare with the declaration of “{ $name }”
    .at = { $found } are given
facts-types = “{ $what }”: the type { $expected } is needed, and { $found } stands here
    .help = numbers are written without quotation marks, texts within them; to_number and to_string convert
    .at = the type { $found }
facts-ungrounded = nothing binds the variable “{ $variable }”
    .help = name it in a positive premise of the rule, or equate it with what is known
    .at = no value
facts-wildcard = “_” stands where a value is needed
    .help = “_” serves in premises only, in the place of an argument
facts-cycle = the relation depends on its own negation or aggregate: { $cycle }
    .help = break the circle: only what was derived before can be negated and counted
    .at = this premise closes the circle
facts-never-used = the relation “{ $name }” is used nowhere
    .help = show it outside: .output { $name }
    .at = declared here
facts-never-derived = the relation “{ $name }” is always empty: nothing derives it
    .help = add a rule, or .input { $name }
    .at = declared here
facts-never-fires = the rule never fires: { $why }
    .help = check this premise
    .at = this premise does not hold
facts-product = nothing ties the premises “{ $one }” and “{ $other }”: all pairs are tried
    .help = give them a common variable or a comparison; if all pairs are wanted, leave it so
facts-single-variable = the variable “{ $variable }” occurs once
    .help = if it is meant so, write “_”

facts-fact-unknown-relation = unknown relation “{ $name }”
    .help = { GIVEN($nearest) ->
        [yes] perhaps “{ $nearest }”?
       *[no] declare it in the rule file: .decl
    }
facts-fact-arity = “{ $relation }” has { $expected } columns, and { $found } values are given
    .help = compare with the declaration of “{ $relation }”
facts-fact-types = “{ $relation }”, column “{ $column }”: the type { $expected } is needed, and “{ $found }” is given
    .help = compare with the declaration of “{ $relation }”

facts-too-many = { $rule }: the relation “{ $relation }” has more than { $limit } rows
    .help = the rule seems to make new rows without end; bound its numbers by a comparison, give .limitsize, or allow more rows (--row-limit)
facts-time = { $rule }: within { $seconds } s the relation “{ $relation }” is not derived, with { $rows } rows so far
    .help = the rule seems to make new rows without end: bound its numbers by a comparison; or give more time (--time-limit)
facts-memory = { $rule }: the relation “{ $relation }” does not fit into { $megabytes } MiB of memory, with { $rows } rows so far
    .help = bind the rule’s premises by common variables, or bound it by a comparison; or give more memory (--memory-limit)
facts-stopped = { $rule }: the relation “{ $relation }” is not derived: stopped

facts-not-known = { $place }the relation “{ $relation }” is computed when { $needs } are known
    .help = bind these columns by other premises, or name their values
facts-too-deep = “{ $relation }” depends on too long a chain of relations
    .help = derive a part of the chain beforehand

facts-file = { $path }: { $cause }
    .help = check the name and the permissions: facts of a relation r are read from r.facts, the output folder must be there
facts-line = { $path }:{ $line }: { $cause }
    .help = values are divided by tabs, one a column
facts-parameter = “{ $relation }”: { $name }={ $value } is not supported
    .help = there are IO=file, for .input IO=stdin, for .output IO=stdout, filename, delimiter, headers, rfc4180, for .input columns="1:0"
