//! Model XML becomes typed prototypes in SI units; errors name file, line and column.

pub mod kind;
