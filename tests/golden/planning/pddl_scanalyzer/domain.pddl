(define (domain scanalyzer3d)
 (:requirements :typing :action-costs)
 (:types segment car)
 (:predicates (on ?c - car ?s - segment) (analyzed ?c - car) (CYCLE-2 ?s1 ?s2 - segment) (CYCLE-2-WITH-ANALYSIS ?s1 ?s2 - segment))
 (:functions (total-cost) - number)
 (:action analyze-2
   :parameters (?s1 ?s2 - segment ?c1 ?c2 - car)
   :precondition (and (CYCLE-2-WITH-ANALYSIS ?s1 ?s2) (on ?c1 ?s1) (on ?c2 ?s2))
   :effect (and (not (on ?c1 ?s1)) (not (on ?c2 ?s2)) (on ?c1 ?s2) (on ?c2 ?s1) (analyzed ?c1) (increase (total-cost) 3)))
 (:action rotate-2
   :parameters (?s1 ?s2 - segment ?c1 ?c2 - car)
   :precondition (and (CYCLE-2 ?s1 ?s2) (on ?c1 ?s1) (on ?c2 ?s2))
   :effect (and (not (on ?c1 ?s1)) (not (on ?c2 ?s2)) (on ?c1 ?s2) (on ?c2 ?s1) (increase (total-cost) 1))))
