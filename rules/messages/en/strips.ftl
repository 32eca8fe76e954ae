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
