(define(domain   Odd-1)(:requirements :strips :equality :negative-preconditions)(:predicates(P ?x)(q))
	(:ACTION  Toggle :Parameters(?X) :Precondition() :Effect(and(p ?x)))

   (:action finish ; no parameters, no precondition at all
     :effect (q))
   (:action both :parameters (?a ?b) :precondition (and (p ?a) (and (p ?b) (not (= ?a ?b)))) :effect (and (q) (not (p ?A)) (not (p ?b)))))
