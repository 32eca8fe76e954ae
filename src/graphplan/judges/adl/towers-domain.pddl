; Towers of blocks, where what is above what is derived.
(define (domain towers)
  (:requirements :adl :derived-predicates)
  (:types block)
  (:predicates (on ?x ?y - block) (table ?x - block) (clear ?x - block) (above ?x ?y - block))
  (:derived (clear ?x - block) (not (exists (?y - block) (on ?y ?x))))
  (:derived (above ?x ?y - block)
    (or (on ?x ?y) (exists (?z - block) (and (on ?x ?z) (above ?z ?y)))))
  (:action stack
    :parameters (?x ?y - block)
    :precondition (and (clear ?x) (clear ?y) (not (= ?x ?y)))
    :effect (and (on ?x ?y) (not (table ?x)) (forall (?z - block) (when (on ?x ?z) (not (on ?x ?z))))))
  (:action put-down
    :parameters (?x - block)
    :precondition (and (clear ?x) (not (table ?x)))
    :effect (and (table ?x) (forall (?z - block) (when (on ?x ?z) (not (on ?x ?z)))))))
