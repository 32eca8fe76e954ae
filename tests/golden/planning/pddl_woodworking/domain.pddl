(define (domain woodworking)
  (:requirements :typing :action-costs)
  (:types acolour awood woodobj machine surface treatmentstatus aboardsize apartsize - object
      highspeed-saw glazer grinder planer immersion-varnisher saw - machine
      board part - woodobj)
  (:constants verysmooth smooth rough - surface varnished glazed untreated colourfragments - treatmentstatus natural - acolour
              small medium large - apartsize)
  (:predicates (unused ?obj - part) (available ?obj - woodobj) (surface-condition ?obj - woodobj ?surface - surface)
     (treatment ?obj - part ?treatment - treatmentstatus) (colour ?obj - part ?colour - acolour) (wood ?obj - woodobj ?wood - awood)
     (boardsize ?board - board ?size - aboardsize) (goalsize ?part - part ?size - apartsize) (boardsize-successor ?size1 ?size2 - aboardsize)
     (in-highspeed-saw ?b - board ?m - highspeed-saw) (empty ?m - highspeed-saw) (has-colour ?machine - machine ?colour - acolour)
     (grind-treatment-change ?old ?new - treatmentstatus) (is-smooth ?surface - surface))
  (:functions (total-cost) - number
     (glaze-cost ?obj - part) - number
     (grind-cost ?obj - part) - number
     (plane-cost ?obj - part) - number)

  (:action do-plane
    :parameters (?x - part ?m - planer ?oldsurface - surface ?oldcolour - acolour ?oldtreatment - treatmentstatus)
    :precondition (and (available ?x) (surface-condition ?x ?oldsurface) (treatment ?x ?oldtreatment) (colour ?x ?oldcolour))
    :effect (and (increase (total-cost) (plane-cost ?x)) (not (surface-condition ?x ?oldsurface)) (surface-condition ?x smooth)
             (not (treatment ?x ?oldtreatment)) (treatment ?x untreated) (not (colour ?x ?oldcolour)) (colour ?x natural)))

  (:action do-grind
    :parameters (?x - part ?m - grinder ?oldsurface - surface ?oldcolour - acolour ?oldtreatment ?newtreatment - treatmentstatus)
    :precondition (and (available ?x) (surface-condition ?x ?oldsurface) (is-smooth ?oldsurface) (colour ?x ?oldcolour)
            (treatment ?x ?oldtreatment) (grind-treatment-change ?oldtreatment ?newtreatment))
    :effect (and (increase (total-cost) (grind-cost ?x)) (not (surface-condition ?x ?oldsurface)) (surface-condition ?x verysmooth)
            (not (treatment ?x ?oldtreatment)) (treatment ?x ?newtreatment) (not (colour ?x ?oldcolour)) (colour ?x natural)))

  (:action do-glaze
    :parameters (?x - part ?m - glazer ?newcolour - acolour)
    :precondition (and (available ?x) (has-colour ?m ?newcolour) (treatment ?x untreated))
    :effect (and (increase (total-cost) (glaze-cost ?x)) (not (treatment ?x untreated)) (treatment ?x glazed)
            (not (colour ?x natural)) (colour ?x ?newcolour)))

  (:action load-highspeed-saw
    :parameters (?b - board ?m - highspeed-saw)
    :precondition (and (empty ?m) (available ?b))
    :effect (and (increase (total-cost) 30) (not (available ?b)) (not (empty ?m)) (in-highspeed-saw ?b ?m)))

  (:action cut-board-small
    :parameters (?b - board ?p - part ?m - highspeed-saw ?w - awood ?surface - surface ?size_before ?size_after - aboardsize)
    :precondition (and (unused ?p) (goalsize ?p small) (in-highspeed-saw ?b ?m) (wood ?b ?w) (surface-condition ?b ?surface)
            (boardsize ?b ?size_before) (boardsize-successor ?size_after ?size_before))
    :effect (and (increase (total-cost) 10) (not (unused ?p)) (available ?p) (wood ?p ?w) (surface-condition ?p ?surface)
            (colour ?p natural) (treatment ?p untreated) (not (boardsize ?b ?size_before)) (boardsize ?b ?size_after))))
