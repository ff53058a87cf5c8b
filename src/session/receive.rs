//! From the entries of a `SendValue` to registers and values, fault by fault.
