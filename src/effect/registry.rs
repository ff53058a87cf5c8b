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
    supply_drop,
    switch_on_delay,
    switch_off_delay,
    load_dependent_speed,
    coasting,
    end_cushioning,
    settling_time,
    // Mechanics.
    coulomb_friction,
    viscous_friction,
    stribeck_friction,
    breakaway_friction,
    load_dependent_friction,
    position_dependent_friction,
    // Transmission.
    backlash,
    compliance,
    belt_slip,
    belt_slip_above_acceleration,
    scale_error,
    once_per_revolution_error,
    // Load.
    added_mass,
    constant_force,
    gravity,
    carried_mass,
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
    // Process.
    part_slip,
    transfer_slip,
    back_pressure,
    part_length_error,
    part_spacing_error,
    vacuum_build_up,
    leak,
    // Any.
    parameter_error,
];
