//! The program as its users have it: as a process, over real sockets.

mod exchange;
mod security;
mod servers;
mod support;
