; Transport city-sequential, one truck of capacity two, one of one
(define (problem transport-city-sequential-4nodes)
 (:domain transport)
 (:objects city-loc-1 city-loc-2 city-loc-3 city-loc-4 - location truck-1 truck-2 - vehicle
  package-1 package-2 package-3 - package capacity-0 capacity-1 capacity-2 - capacity-number)
 (:init
  (= (total-cost) 0)
  (capacity-predecessor capacity-0 capacity-1) (capacity-predecessor capacity-1 capacity-2)
  ; 748,385 -> 890,543
  (road city-loc-1 city-loc-2) (= (road-length city-loc-1 city-loc-2) 22)
  (road city-loc-2 city-loc-1) (= (road-length city-loc-2 city-loc-1) 22)
  (road city-loc-2 city-loc-3) (= (road-length city-loc-2 city-loc-3) 50)
  (road city-loc-3 city-loc-2) (= (road-length city-loc-3 city-loc-2) 50)
  (road city-loc-3 city-loc-4) (= (road-length city-loc-3 city-loc-4) 9)
  (road city-loc-4 city-loc-3) (= (road-length city-loc-4 city-loc-3) 9)
  (road city-loc-1 city-loc-4) (= (road-length city-loc-1 city-loc-4) 13)
  (road city-loc-4 city-loc-1) (= (road-length city-loc-4 city-loc-1) 13)
  (at package-1 city-loc-3) (at package-2 city-loc-3) (at package-3 city-loc-4)
  (at truck-1 city-loc-1) (capacity truck-1 capacity-2) (at truck-2 city-loc-2) (capacity truck-2 capacity-1))
 (:goal (and (at package-1 city-loc-1) (at package-2 city-loc-4) (at package-3 city-loc-2)))
 (:metric minimize (total-cost)))
