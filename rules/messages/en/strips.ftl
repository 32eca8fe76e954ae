# What is wrong with a rule file, a scenario, a PDDL file or a plan.

strips-faults = { $count } faults are found
strips-denied = NOT { $fact }
strips-no-such-file = there is no such file
strips-no-permission = there is no permission to read it

strips-unreadable = the file “{ $path }” cannot be read: { $reason }
    .help = check the path and the permissions
strips-not-text = the file “{ $path }” is no UTF-8 text: byte { $offset } cannot be read
    .help = save the file as text in UTF-8
strips-too-large = the file “{ $path }” is too large: { $bytes } bytes, the limit is { $limit }
    .help = divide the file and include its parts: “Include: part.strips”
strips-empty = the file “{ $path }” is empty
    .help = a rule file consists of sections “Action: …”, a scenario of “Initial: …” and “Goal: …”
strips-unexpected-character = unexpected sign “{ $sign }”
    .help = names with such signs stand in quotation marks: "name"
strips-syntax = { $expected } is expected, and { $found } stands here
strips-unknown-heading = unknown section “{ $heading }”
strips-missing-parenthesis = a bracket is not closed
    .help = put “)” before the next section
    .at = opened here
strips-surplus-parenthesis = one closing bracket too many
    .help = it can be removed
strips-too-deep = brackets within brackets deeper than { $limit } levels
    .help = simplify the expression
strips-unsupported = “{ $what }” is not read
strips-requirement = the requirement “{ $name }” is wider than what is read
    .help = :strips :typing :negative-preconditions :equality :action-costs are read; what goes beyond is told where it stands
strips-early-end = “(define …)” is closed here, and { $next } follows
    .help = remove the “)” too many here or before
    .at = closed here
strips-not-assumed = there is no such assumption: { $fact }{ $is_fact ->
        [yes] {" "}(it is a fact)
       *[no] {""}
    }
strips-not-believed = neither the map nor the robot knows this: { $fact }
strips-not-driven = the robot cannot bring this about: { $fact }
strips-unknown-type = unknown type “{ $name }”
strips-type-cycle = the type “{ $name }” inherits from itself
    .help = break the circle of inheritance under “Types:”
strips-unknown-predicate = unknown predicate “{ $name }”
strips-lonely-predicate = the predicate “{ $name }” occurs in the action “{ $action }” alone – a slip of the pen?
strips-lonely-type = the type “{ $name }” is not declared – a slip of the pen?
strips-unknown-function = unknown function “{ $name }”
strips-other-domain = the problem is of the domain “{ $wanted }”, and “{ $found }” was read
    .help = check that --domain and --problem name the files that belong together
strips-metric = the metric “{ $metric }” is not heeded
    .help = (:metric minimize (total-cost)) is heeded, so is (+ (* 3 (is-violated name)) …); without it the plan is one of the fewest steps
strips-unknown-preference = unknown preference “{ $name }”
strips-arity = “{ $name }” takes { $expected } argument{ $expected ->
        [1] {""}
       *[other] s
    }, not { $found }
strips-undeclared-variable = action “{ $action }”: the variable “{ $variable }” is not declared
strips-variable-in-fact = the variable “{ $variable }” stands outside an action
    .help = in facts and goals stand names of objects
strips-duplicate = { $what } “{ $name }” is declared a second time
    .at = the second time here
    .first = the first time here
strips-second-name-of-action = “{ $name }” is an action: predicates and types may have a second name
    .help = remove it; the words in quotation marks stay
    .at = the second name
strips-object-twice = the object “{ $name }” is declared twice: here as “{ $found }”, and before as “{ $earlier }”
    .at = the second time here
    .first = the first time here
strips-phrase-variable = “{ $variable }” stands in the words, and not among the arguments
strips-contradictory-effect = action “{ $action }” contradicts itself: it both adds and deletes “{ $atom }”
    .help = leave the fact in one of “Effect+”, “Effect-”
    .at = deleted here
strips-contradictory-precondition = action “{ $action }” contradicts itself: it both needs and forbids “{ $atom }”
    .help = remove one of the two
    .at = forbidden here
strips-argument-type = “{ $name }”: argument { $number } is to be of type “{ $expected }”, and “{ $term }” is of type “{ $found }”
strips-variable-type = the variable “{ $variable }” is declared as “{ $declared }”, and called “{ $found }” here
    .help = call the type as the parameters do
strips-unknown-object = unknown object “{ $name }”
strips-object-type = the object “{ $name }” is of type “{ $found }” here, and of type “{ $earlier }” elsewhere
    .help = declare the object’s type under “Objects:”, or correct the fact
strips-contradictory-fact = “{ $atom }” is both stated and denied
    .help = keep one of the two
    .at = denied here
strips-include-cycle = the file includes itself
    .help = remove this inclusion
strips-include = the file “{ $path }” cannot be included: { $reason }
    .help = the path is seen from the folder of the file in which “Include” stands
strips-cost = “{ $text }” is no cost
    .help = a cost is a number from 0 to 1000000 with no more than three decimals
strips-no-goal = the scenario has no goal
    .help = add a section “Goal: …”, in PDDL “(:goal …)”
strips-no-actions = there is not one action
    .help = include a rule file: “Include: ../service-robot.strips”
strips-unknown-action = unknown action “{ $name }”
strips-wrong-object = “{ $name }” does not fit: an object of type “{ $expected }” is due here
strips-plan-precondition = the action cannot be carried out: it takes { $fact }
    .at = here the plan breaks off
strips-plan-interference = two actions of one step disturb each other: because of { $fact } it does not go with “{ $other }”
    .help = put them into different steps
    .at = here the plan breaks off
strips-plan-misses-goal = in the end the goal { $fact } does not hold
strips-too-many-operators = the actions of the rules over these objects do not fit into { $megabytes } MiB of memory
    .help = give the rules preconditions that tie their parameters together, or use fewer objects
strips-too-many-cases = the conditions of “{ $of }” fall into more than { $limit } cases
    .help = divide the action into several, or use fewer objects under “forall” and “when”
strips-durations = actions that last are planned whole, one after another; steps are counted in these actions, and a duration is a cost
    .help = a plan that needs one action to go on within another is not found this way
    .at = the first such action
strips-lasting-condition = while an action lasts plain facts can be asked: its start touches what the condition asks
    .help = divide the condition into facts, or ask it at the start
strips-derived-stated = “{ $name }” is derived by a rule: it can neither be stated nor changed by an action
    .help = remove this, or the rule that derives it
strips-derived-by-absence = “{ $name }” is derived from “{ $name }” not being derived
    .help = break the circle: a negation under a derived predicate must not lead back to it
    .at = this rule
strips-no-price = the problem does not say what { $action }{ $more ->
        [0] {""}
       *[other] {" "}(and { $more } more)
    } costs: it is taken to be free
    .help = give its value in :init: (= (function object …) number)

# Words and phrases of which what is said is put together.

declare-the-type-under-types-pddl-types = declare the type under “Types:” (PDDL: :types)
the-action = the action
the-parameter = the parameter
declare-it-under-predicates-pddl-predicates = declare it under “Predicates:” (PDDL: :predicates)
add-it-to-the-parameters = add it to the parameters
declare-it-in-constants = declare it in :constants
the-first-time-at = ; the first time at { $at }
in-functions-has-so-many = in :functions “{ $text }” has so many: { $expected }
declare-it-in-functions = declare it in :functions
the-predicate = the predicate
the-name-of-an-action = the name of an action
condition-or-effect = :condition or :effect
duration-number-or-duration-function = (= ?duration number) or (= ?duration (function …))
at-start-over-all-or-at-end = (at start …), (over all …) or (at end …)
at-start-or-at-end = (at start …) or (at end …)
perhaps-the-letters-look-the-same-but = perhaps “{ $near }”? the letters look the same, but are of different alphabets
perhaps-2 = perhaps “{ $near }”?
a-section = a section “(:…)”
parameters-precondition-or-effect = :parameters, :precondition or :effect
an-expression-in-brackets = an expression in brackets
imply-condition-condition = (imply condition condition)
forall-variables-condition = (forall (variables) condition)
exists-variables-condition = (exists (variables) condition)
a-condition-in-brackets = a condition in brackets
a-variable-such-as-x = a variable such as “?x”
derived-name-x-condition = (:derived (name ?x) condition)
forall-variables-effect-or-when-condition-effect = (forall (variables) effect) or (when condition effect)
an-effect-in-brackets = an effect in brackets
name-arguments = “(name arguments…)”
a-variable-or-an-object = a variable or an object
a-type-after = a type after “-”
a-type-or-either = a type or “(either …)”
a-name = a name
numbers-are-read-as-costs-alone-increase = numbers are read as costs alone: (increase (total-cost) …)
preferences-are-read-in-goal-one-by = preferences are read in :goal, one by one: (preference name condition); not under forall or in conditions of actions
there-are-no-constraints-on-the-course = there are no constraints on the course of a plan: write into :goal what is needed in the end
adl-derived-predicates-action-costs-and-what = :adl, :derived-predicates, :action-costs and what they hold are read
written = written: { $written }
step-action-object = “step: (action object …)”
action-object = “(action object …)”
the-map-knows-no-such-name-name = the map knows no such name; name a new one under “Objects:”
a-negation-a-comparison-or-a-condition = a negation, a comparison or a condition
the-rules-have-no-such-predicate = the rules have no such predicate
neither-the-facts-nor-objects-pddl-objects = neither the facts, nor “Objects:” (PDDL: :objects), nor the map know such an object
a-name-of-several-words-stands-in = a name of several words stands in quotes: «{ $word } { $name }»
no-more-than-fifty-brackets-within-each = no more than fifty brackets within each other
a-variable-such-as-x-or = a variable such as “?x” or “)”
then = “THEN”
if-and-a-condition = “IF” and a condition
a-fact-without-not-what-ceases-to = a fact without “NOT”; what ceases to hold is written under “Effect-:”
the-end-of-the-file = the end of the file
sections-action-facts-assumptions-initial-goal-preferably = sections: Action, Facts, Assumptions, Initial, Goal, Preferably, Types, Predicates, Objects, Include, Map, In English
parameters-precondition-effect-or-effect = “Parameters:”, “Precondition:”, “Effect+:” or “Effect-:”
action-name-before-its-parts = “Action: name” before its parts
or-the-next-fact = “)” or the next fact
the-name-of-a-preference = the name of a preference
a-type = a type
a-variable-such-as-x-after-the = a variable such as “?x” after the type
or = “=” or “≠”
after-the-name-of-the-predicate = “(” after the name of the predicate
the-name-of-a-predicate = the name of a predicate
or-2 = “,” or “)”
an-objects-name-or-a-variable = an object’s name or a variable
the-name-of-a-type = the name of a type
the-type-of-an-argument-or = the type of an argument or “)”
the-name-of-a-predicate-an-action = the name of a predicate, an action or a type
and-words-in-quotation-marks = “=” and words in quotation marks
a-second-name = a second name
words-in-quotation-marks = words in quotation marks
a-number = a number
the-name-of-a-file = the name of a file
a-section-action-facts-and-so-on = a section: “Action:”, “Facts:” and so on
a-fact-such-as-name-object = a fact such as “NAME_(object, …)”
is-called-so-already = “{ $known }” is called so already
the-second-name = the second name
perhaps-if-not-declare-the-predicates-under = perhaps “{ $near }”? if not, declare the predicates under “Predicates:”
preference-name-condition = (preference name condition)
define-form = “(define …)”
opening-bracket = “(”
keep-one = keep one of the two{ $elsewhere }
rename-one = rename or remove one of the two{ $elsewhere }

# Why a goal is out of reach.

goal-out-of-reach = the goal that { $goal } is out of reach
goal-by-none-of-its-ways = the goal is out of reach by any of its ways
no-case-of-the-goal = the goal is out of reach: no case of it can come about, in whatever order actions are taken
in-whatever-order = , in whatever order actions are taken; conditions with “or”, “forall” and “when” are not told apart
one-by-one-not-together = : all that it takes can be had one by one, but not together
needs-exclude-each-other = for this ({ $action }) it must be that { $a } and that { $b }, which exclude each other
no-action-brings-it-about = : no action brings it about
another-way-is-no-help = another way ({ $action }) is no help: that { $fact } takes the same itself
it-would-help = It would help if { $sets }
help-and = {" and "}
help-or = {", or if "}
for-this = for this it must be that { $fact }
for-this-by-an-action = for this ({ $action }) it must be that { $fact }
now-it-is = ; now { $now }
that-takes-what-was-named = ; and that takes what was named before: it turns in a circle
nothing-leads-to-it = ; it is not so, and nothing here leads to it
it-is-not-so-and-no-action = ; it is not so, and no action brings it about
this-would-bring-it-about = ; this ({ $action }) would bring it about
and-takes = , and takes that { $fact }
and-takes-what-was-named = , and takes what was named before: it turns in a circle

# Facts, kinds and predicates.

it-is-not-so-that = it is not so that { $fact }
something = something
one-or-another = {" or "}
any-object = object
as-here = , as here: { $at }
signature = written: { $written }{ $place }
