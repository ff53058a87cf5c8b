//! What ties a device with effects to others: who shares its supply, whose parts it carries. A device without effects has
//! none, and nothing is counted for it.

use super::{BuildError, Mount, Unit, UnitBody};
use crate::effect;
use crate::plant::{Instance, Plant};

/// The ties of a device, by the indices of units and cups.
#[derive(Clone, Debug, Default)]
pub(super) struct Ties {
    /// The other devices on its supply; `None` where nothing about it asks.
    pub supply: Option<Vec<usize>>,
    /// Whether it has to know of the parts that it carries, pushes or holds.
    pub counts_parts: bool,
    /// The cups whose parts it carries.
    pub cups: Vec<usize>,
}

/// Ties the devices of `plant`, whose units stand in the order of its tasks.
pub(super) fn tie(plant: &Plant, mounts: &[Mount], units: &mut [Unit]) -> Result<(), BuildError> {
    let owners: Vec<&Instance> =
        plant.instances.iter().flat_map(|instance| instance.tasks.iter().map(move |_| instance)).collect();
    for unit in 0..units.len() {
        let instance = owners[unit];
        if instance.effects.is_empty() {
            continue;
        }
        let mut ties = Ties { counts_parts: true, ..Ties::default() };
        let mounted = mounts.iter().filter(|mount| mount.robot == unit).map(|mount| mount.gripper);
        ties.cups.extend(mounted.filter_map(|gripper| cups_of(&units[gripper])));
        for (index, spec) in instance.effects.iter().enumerate() {
            let names = effect::neighbours(spec);
            let is_known = |name: &&str| owners.iter().any(|owner| owner.name == *name);
            if let Some(stranger) = names.iter().flatten().find(|name| !is_known(name)) {
                let error = Box::new(effect::stranger(spec, &instance.name, stranger));
                return Err(BuildError::Effect { instance: instance.name.clone(), index, error });
            }
            let is_named = |other: &usize| match &names {
                Some(names) => names.contains(&owners[*other].name.as_str()),
                None => true,
            };
            let others = (0..owners.len()).filter(|&other| other != unit).filter(is_named);
            match spec.kind.as_str() {
                effect::SHARES_A_SUPPLY => {
                    let supply = ties.supply.get_or_insert_default();
                    supply.extend(others);
                    supply.sort_unstable();
                    supply.dedup();
                }
                effect::CARRIES_PARTS if names.is_some() => {
                    ties.cups.extend(others.filter_map(|other| cups_of(&units[other])));
                }
                _ => {}
            }
        }
        units[unit].ties = ties;
    }
    Ok(())
}

fn cups_of(unit: &Unit) -> Option<usize> {
    match unit.body {
        UnitBody::Cups(index, _) => Some(index),
        _ => None,
    }
}
