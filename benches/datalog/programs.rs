//! The same programs as rule text.

pub(crate) const CLOSURE: &str = "
.decl edge(a: number, b: number) .input edge
.decl path(a: number, b: number) .output path
path(A, B) :- edge(A, B).
path(A, C) :- path(A, B), edge(B, C).
";

pub(crate) const SAME_GENERATION: &str = "
.decl parent(a: number, b: number) .input parent
.decl same(a: number, b: number) .output same
same(X, Y) :- parent(P, X), parent(P, Y), X != Y.
same(X, Y) :- parent(A, X), same(A, B), parent(B, Y).
";

pub(crate) const THREE_WAY: &str = "
.decl r(a: number, b: number) .input r
.decl s(a: number, b: number) .input s
.decl t(a: number, b: number) .input t
.decl out(a: number, d: number) .output out
out(A, D) :- r(A, B), s(B, C), t(C, D), A < 100, D > A.
";

pub(crate) const COUNTS: &str = "
.decl edge(a: number, b: number) .input edge
.decl node(a: number) .output node
.decl target(a: number)
.decl source(a: number) .output source
.decl degree(a: number, n: number) .output degree
.decl busy(a: number) .output busy
.decl quiet(a: number) .output quiet
node(X), node(Y) :- edge(X, Y).
target(Y) :- edge(_, Y).
source(X) :- node(X), !target(X).
degree(X, N) :- edge(X, _), N = count : { edge(X, _) }.
busy(X) :- degree(X, N), N >= 3.
quiet(X) :- node(X), !busy(X), !source(X).
";

pub(crate) const SPATIAL: &str = "
.decl box(i:number,r:number,x1:number,y1:number,x2:number,y2:number,z:number,h:number) .input box
.decl door(a:number,b:number) .input door
.decl on_top_of(a:number,b:number) .printsize on_top_of
.decl inside(a:number,b:number) .printsize inside
.decl touching(a:number,b:number) .printsize touching
.decl near(a:number,b:number) .printsize near
.decl left_of(a:number,b:number) .printsize left_of
.decl supported_by(a:number,b:number) .printsize supported_by
.decl has_top(b:number)
.decl clear(b:number) .printsize clear
.decl has_near(b:number)
.decl isolated(b:number) .printsize isolated
.decl reach(a:number,b:number) .printsize reach
on_top_of(A,B) :- box(A,R,AX1,AY1,AX2,AY2,AZ,_), box(B,R,BX1,BY1,BX2,BY2,BZ,BH), A != B, AZ = BZ+BH,
    AX1 < BX2, BX1 < AX2, AY1 < BY2, BY1 < AY2.
inside(A,B) :- box(A,R,AX1,AY1,AX2,AY2,AZ,AH), box(B,R,BX1,BY1,BX2,BY2,BZ,BH), A != B,
    BX1 <= AX1, AX2 <= BX2, BY1 <= AY1, AY2 <= BY2, BZ <= AZ, AZ+AH <= BZ+BH.
touching(A,B) :- box(A,R,AX1,AY1,AX2,AY2,AZ,AH), box(B,R,BX1,BY1,BX2,BY2,BZ,BH), A != B,
    AX1 <= BX2, BX1 <= AX2, AY1 <= BY2, BY1 <= AY2, AZ <= BZ+BH, BZ <= AZ+AH.
near(A,B) :- box(A,R,AX1,AY1,AX2,AY2,AZ,AH), box(B,R,BX1,BY1,BX2,BY2,BZ,BH), A != B,
    AX1 <= BX2+50, BX1 <= AX2+50, AY1 <= BY2+50, BY1 <= AY2+50, AZ <= BZ+BH+50, BZ <= AZ+AH+50.
left_of(A,B) :- box(A,R,AX1,AY1,AX2,AY2,AZ,AH), box(B,R,BX1,BY1,BX2,BY2,BZ,BH), A != B,
    AX2 <= BX1, BX1 <= AX2+100, AY1 < BY2, BY1 < AY2, AZ < BZ+BH, BZ < AZ+AH.
supported_by(A,B) :- on_top_of(A,B).
supported_by(A,C) :- supported_by(A,B), on_top_of(B,C).
has_top(B) :- on_top_of(_,B).
clear(B) :- box(B,_,_,_,_,_,_,_), !has_top(B).
has_near(A) :- near(A,_).
isolated(A) :- box(A,_,_,_,_,_,_,_), !has_near(A).
reach(A,B) :- door(A,B).
reach(A,C) :- reach(A,B), door(B,C).
";
