//! What is in what that should not be: the bodies of a scene against each other, and parts against the bodies of a scene.
//!
//! Every body is cut into the pieces that it is made of, each with its box; a piece that is a box is no more than that, any
//! other keeps its triangles. A **link** is all that is rigidly joined: the pieces under a moving joint, up to the next one.
//! In a step only what moved is asked again, and of that only what is near:
//!
//! 1. The box about a moving link or part, grown by where it is going, is looked up among all others when the link or part
//!    has left it: one look in some hundred steps.
//! 2. What is in it is near. How far the two are apart is remembered, and the pair is left alone until both together have
//!    moved that far.
//! 3. The pieces' boxes are asked first (separating axes); only where they overlap, the triangles decide (parry3d).
//!
//! What may touch is left out: links that a joint joins, what is in contact when the scene is put together, parts on what
//! bears or pushes them (the engine's floor knows those contacts), and parts with each other (the floor again).
//!
//! Surfaces are what is asked: a mesh that has got wholly inside another without touching it is not seen.

mod piece;
#[cfg(test)]
mod tests;
mod world;

pub use piece::COLLISION_M;
pub use world::{Clash, Obstacle, Part, World};
