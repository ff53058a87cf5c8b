//! Every effect there is, in the order of the signal path.

use super::EffectDescriptor;

/// The effects: a module each, and its line.
macro_rules! effects {
    ($($module:ident),* $(,)?) => {
        /// Every effect there is.
        pub static EFFECTS: &[&EffectDescriptor] = &[$(&super::$module::EFFECT),*];
    };
}

effects![
    // Links.
    inverted,
    swapped,
    stuck,
    intermittent,
    wrong_unit,
    input_filter,
    dead_time,
    sampling_jitter,
    lost_messages,
    clock_drift,
    stale_hold,
    // Actuator.
    first_order_lag,
    second_order_lag,
    gain_error,
    velocity_limit,
    acceleration_limit,
    jerk_limit,
    force_limit,
    dead_band,
    direction_asymmetry,
    switch_on_delay,
    switch_off_delay,
    // Mechanics.
    coulomb_friction,
    viscous_friction,
    stribeck_friction,
    breakaway_friction,
    load_dependent_friction,
    position_dependent_friction,
    // Transmission.
    backlash,
    belt_slip,
    scale_error,
    once_per_revolution_error,
    // Load.
    added_mass,
    constant_force,
    gravity,
    // Sensor.
    offset,
    gain,
    noise,
    quantisation,
    on_delay,
    off_delay,
    hysteresis,
    bounce,
    drift,
    blind_range,
    // Any.
    parameter_error,
];
