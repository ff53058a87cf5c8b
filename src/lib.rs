//! **kinetwin** is the machine until the machine stands, and its honest mirror after: a kinematic 3D engine for the
//! virtual commissioning of IEC 61499 automations, fed over the CPS-Protocol.
#![deny(unsafe_code)]

pub mod adapter;
pub mod automation;
pub mod bank;
pub mod bench;
pub mod cli;
pub mod collision;
pub mod device;
pub mod effect;
pub mod engine;
pub mod exam;
pub mod gap;
pub mod kinematics;
pub mod mesh;
pub mod pace;
pub mod plant;
pub mod prototype;
pub mod replay;
pub mod run;
pub mod scene;
pub mod script;
pub mod security;
pub mod session;
pub mod signal_map;
pub mod time;
pub mod trace;
pub mod value;
#[cfg(feature = "view")]
pub mod view;
pub mod wire;
pub mod xml;
