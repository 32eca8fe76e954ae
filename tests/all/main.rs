mod facts;
mod facts_naive;
