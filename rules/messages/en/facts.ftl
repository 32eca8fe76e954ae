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

# Words and phrases of which what is said is put together.

an-integer-in-quotation-marks = an integer in quotation marks
choices-of-a-rule = choices of a rule
premises-of-a-rule = premises of a rule
choices-of-a-question = choices of a question
columns-of-the-answer = columns of the answer
premises-of-a-question = premises of a question
between-values-of-the-type = { $sign } between values of the type { $kind }
records-are-compared-for-equality-only = records are compared for equality only
choices-of-an-aggregate = choices of an aggregate
the-component-within-itself = the component “{ $text }” within itself
break-the-circle-a-component-neither-inherits = break the circle: a component neither inherits from itself nor makes itself
components-within-one-another = components within one another
override-the-components-inherited-from-have-no = .override { $text }: the components inherited from have no such relation
override-the-relation-is-not-declared-overridable = .override { $text }: the relation is not declared overridable
relations-of-the-components-inherited-from-are = relations of the components inherited from are replaced, where they are declared overridable
fields-of-a-record = fields of a record
choice-domain-without-such-a-column = choice-domain “{ $text }” without such a column
name-columns-of-this-relation = name columns of this relation
a-subtype-of-the-record-or-union = a subtype “{ $text }” of the record or union “{ $text2 }”
symbol-number-unsigned-float-and-their-subtypes = symbol, number, unsigned, float and their subtypes have subtypes; “=” gives a second name
columns-of-a-relation = columns of a relation
no = no
comparison = comparison
numbers-in-order = numbers in order
aggregate = aggregate
new-rows = new rows
earlier-rows = earlier rows
all-rows = all rows
n-1-row = 1 row
rows = { $len } rows
levels-of-an-expression = levels of an expression
operations-in-a-row = operations in a row
a-function-of-functor = a function of .functor
foreign-code-is-not-run-here-compute = foreign code is not run here: compute it beforehand, and give it as a table of facts
a-value = a value
the-function = the function “{ $text }”
there-are-arithmetic-autoinc-cat-strlen-substr = there are arithmetic, autoinc, cat, strlen, substr, range, to_string, to_number, to_unsigned, to_float, ord, as, min, max, operations on bits and truth
make-a-column-that-counts-steps = make a column that counts steps
is-always-empty = “{ $name }” is always empty
the-comparison-is-always-false = the comparison is always false
the-comparisons-exclude-each-other = the comparisons exclude each other
another-premise-states-the-same = another premise states the same
the-inline-relation-that-reads-itself = the inline relation “{ $name }” that reads itself
remove-inline-and-bind-the-variables-of = remove inline, and bind the variables of its rules
the-negation-of-the-inline-relation-with = the negation of the inline relation “{ $name }” with variables that its head lacks
a-record = a record
the-comment = the comment
means-nothing-in-a-text = “\{ $letter }” means nothing in a text
a-text-in-quotation-marks = a text in quotation marks
the-closing-quotation-mark-on-the-same = the closing quotation mark on the same line
levels-of-brackets = levels of brackets
what-a-rule-derives-can-be-counted = what a rule derives can be counted
autoinc-in-a-fact = autoinc() in a fact
plan-the-order-does-not-name-every = .plan { $version }: the order does not name every premise of the rule once
list-the-numbers-of-all-relations-of = list the numbers of all relations of the body, from 1
plan-the-rule-has-recursive-premises = .plan { $version }: the rule has { $versions } recursive premises
versions-are-numbered-from-0-one-a = versions are numbered from 0, one a recursive premise
remove-inline-the-relation-will-be-derived = remove inline: the relation will be derived as all are
the-inline-relation-is-read-from-a = the inline relation “{ $text }” is read from a file, or is an output
the-inline-relation-reads-itself = the inline relation “{ $text }” reads itself
autoinc-in-an-inline-relation = autoinc() in an inline relation
an-aggregate-over-the-inline-relation = an aggregate over the inline relation “{ $name }”
autoinc-among-the-arguments-of-the-inline = autoinc() among the arguments of the inline relation “{ $name }”
in-the-negation-of-the-inline-relation = “_” in the negation of the inline relation “{ $name }”
a-search-that-goes-back = “{ $pattern }”: a search that goes back
do-without-1-and-they-cannot-be = do without \1 and (?=…): they cannot be decided in linear time
as-from-to = as from { $from } to { $to }
there-are-to-number-to-float-and = there are to_number, to_float and to_string
foreign-code-is-not-run-here-compute-2 = foreign code is not run here: compute the values beforehand, and give them as a table of facts
a-rule = a rule
override-outside-of-a-component = .override outside of a component
replace-rules-within-a-comp-that-inherits = replace rules within a .comp that inherits from another
the-rounds-of-evaluation-are-not-kept = the rounds of evaluation are not kept: remove this line
the-property-beside-what-is-said-already = the property { $text } beside what is said already
one-word-of-btree-brie-eqrel-btree = one word of btree, brie, eqrel, btree_delete, and each other once
btree-delete-of-a-relation-without-columns = btree_delete of a relation without columns
it-has-no-two-rows-of-which = it has no two rows of which one could displace the other
a-declaration-or-a-rule = a declaration or a rule
the-greatest-can-be-kept-by-subsumption = the greatest can be kept by subsumption: r(x, a) <= r(x, b) :- a < b.
remove-this-word-relations-are-all-kept = remove this word: relations are all kept alike
the-property = the property { $word }
a-premise = a premise
a-relation = a relation
cs-preprocessor = C’s preprocessor: “#{ $line }”
there-are-define-undef-ifdef-ifndef-if = there are #define, #undef, #ifdef, #ifndef, #if, #elif, #else, #endif, #line and #include
the-preprocessors-condition = the preprocessor’s condition “{ $trim }”
there-are-numbers-names-defined-and-brackets = there are numbers, names, defined, ! && || == != < <= > >= + - * / % and brackets
a-definition-in-which-not-all-is = a definition in which not all is words of the language
check-the-text-after-the-name = check the text after the name
a-name = a name
define-without-a-name = #define without a name
substitutions-of-define = substitutions of #define
a-question-of-the-inline-relation = a question of the inline relation “{ $name }”
remove-inline-such-a-relation-has-no = remove inline: such a relation has no rows of its own
choice-domain-autoinc-or-limitsize-in-a = choice-domain, autoinc or limitsize in a question
put-such-a-relation-into-the-program = put such a relation into the program: there it is derived whole
such-a-directive-in-a-question = such a directive in a question
decl-type-rules-and-facts-serve-in = .decl, .type, rules and facts serve in a question
a-rule-of-the-question-for-the = a rule of the question for the program’s relation “{ $text }”
declare-a-relation-of-its-own-in = declare a relation of its own in the question: .decl
the-end-of-the-question = the end of the question
the-end-of-the-text = the end of the text
the-number = the number { $number }
a-rule-a-fact-or-a-declaration = a rule, a fact or a declaration
attempts-to-read-one-rule = attempts to read one rule
a-number = a number
a-comparison = a comparison
an-operation = an operation
autoinc-in-a-recursive-rule = autoinc() in a recursive rule
number-the-finished-relation-in-a-rule = number the finished relation in a rule of its own
rows-of-one-relation-subsume-each-other = rows of one relation subsume each other
columns-of-a-relation-with-subsumption = columns of a relation with subsumption
include-in-a-text-that-has-no = .include "{ $path }" in a text that has no folder
give-the-rule-texts-together-as-one = give the rule texts together, as one program
order-clause = “.order”
limit-clause = “.limit”
end-of-comment = “*/”
escapes-of-a-text = there are \" \' \\ \n \t \r \a \b \f \v; a backslash itself is written twice
closing-brace = “{"}"}”
sign-of-equality = “=”
directive-if = #if
directive-endif = #endif
relation-by = { $name } by { $key }
relation-in-part = { $relation }: { $part }
or = {" or "}
not = {"not "}

facts-no-decimal = no decimal number of at most six digits after the point
and = {" and "}
see-above = see above
filtered-by-a-comparison = , filtered by a comparison
rule-took = { $milliseconds } ms  { $relation }  { $place }  { $runs } { $runs ->
        [1] run
       *[other] runs
    }, { $found } found
