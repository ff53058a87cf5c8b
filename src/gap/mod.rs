//! The sim-to-real gap: where a model parts from its machine, which unmodelled effect causes it, and how far it shrinks on
//! data that no fit saw, once that effect is added.

pub mod production;
pub mod report;
