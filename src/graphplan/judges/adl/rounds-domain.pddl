; A robot that tidies rooms: a room is done when nothing in it lies about, or when it is out of bounds.
(define (domain rounds)
  (:requirements :adl)
  (:types room thing)
  (:constants bin - room)
  (:predicates (robot ?r - room) (way ?a ?b - room) (lies ?t - thing ?r - room) (held ?t - thing) (closed ?r - room) (fragile ?t - thing) (careful))
  (:action go
    :parameters (?a ?b - room)
    :precondition (and (robot ?a) (or (way ?a ?b) (way ?b ?a)) (not (closed ?b)))
    :effect (and (not (robot ?a)) (robot ?b)))
  (:action pick
    :parameters (?t - thing ?r - room)
    :precondition (and (robot ?r) (lies ?t ?r) (not (exists (?o - thing) (held ?o))) (imply (fragile ?t) (careful)))
    :effect (and (held ?t) (not (lies ?t ?r))))
  (:action drop
    :parameters (?t - thing)
    :precondition (and (held ?t) (robot bin))
    :effect (not (held ?t)))
  (:action slow-down
    :parameters ()
    :precondition (forall (?t - thing) (not (held ?t)))
    :effect (careful)))
