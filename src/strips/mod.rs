//! (stands empty until its chapter is written)
