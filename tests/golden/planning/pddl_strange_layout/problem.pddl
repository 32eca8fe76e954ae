(define (problem odd) (:domain odd-1) (:objects A b	C)
 (:init)
 (:goal (and (q) (p a) (p B) (not (p c)))))
