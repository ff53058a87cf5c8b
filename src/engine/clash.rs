//! Collisions: what the bodies of the scene and the parts run into, told with the signals of who is involved.

use super::Engine;
use super::floor::{Incident, IncidentKind, Support};
use crate::collision::{Clash, Obstacle, Part, World};
use crate::kinematics::DVec3;
use crate::plant::Plant;
use crate::signal_map::RegisterId;

/// Who is watched, and what was seen.
pub(super) struct Watch {
    world: World,
    found: Vec<Clash>,
    /// How many pairs came to be in one another, those that the floor counts apart.
    count: u64,
}

/// The registers of each instance, by its name; sorted.
pub(super) fn registers_of(plant: &Plant) -> Vec<(String, Vec<RegisterId>)> {
    let mut owners: Vec<(String, Vec<RegisterId>)> =
        plant.instances.iter().map(|instance| (instance.name.clone(), Vec::new())).collect();
    owners.sort();
    for (index, signal) in plant.signal_map.signals().iter().enumerate() {
        if let Ok(owner) = owners.binary_search_by(|(name, _)| name.as_str().cmp(&signal.instance)) {
            owners[owner].1.push(RegisterId(index as u32));
        }
    }
    owners
}

impl Engine {
    /// From now on everything solid in the scene that is shown is watched for collisions at each tick; nothing else that the
    /// engine computes depends on it. Where nothing is shown, nothing is watched.
    pub fn watch(&mut self) {
        let Some(stage) = &self.stage else { return };
        self.watch = Some(Watch { world: World::new(stage.poses()), found: Vec::new(), count: 0 });
    }

    /// How often two came to be in one another so far: parts, plates, and where they are watched all bodies of the scene.
    pub fn collisions(&self) -> u64 {
        self.floor.tally.collisions + self.watch.as_ref().map_or(0, |watch| watch.count)
    }

    /// What is watched; `None` where nothing is.
    pub fn watched(&self) -> Option<&World> {
        self.watch.as_ref().map(|watch| &watch.world)
    }

    /// Asks who has run into whom in this step.
    pub(super) fn collisions_phase(&mut self) {
        let (Some(watch), Some(stage)) = (&mut self.watch, &self.stage) else { return };
        let parts = self.floor.parts.iter().map(|(slot, part)| Part {
            slot: slot.index(),
            number: part.number,
            block: &part.block,
        });
        watch.world.step(stage.poses(), parts, &mut watch.found);
        if watch.found.is_empty() {
            return;
        }
        watch.count += watch.found.len() as u64;
        let found = std::mem::take(&mut watch.found);
        for clash in &found {
            self.tell(clash);
        }
    }

    fn tell(&mut self, clash: &Clash) {
        let titles = clash.between.map(|it| self.obstacle(it));
        let instances = titles.iter().flat_map(|(_, instance)| instance.clone()).collect();
        let between = titles.map(|(title, _)| title);
        let place = DVec3::to_array(&clash.place);
        self.floor.tally.keep(IncidentKind::Collision { between, depth: clash.depth, place, instances });
    }

    /// What it is called, and the instance that it belongs to or that carries it.
    fn obstacle(&self, obstacle: Obstacle) -> (String, Option<String>) {
        match obstacle {
            Obstacle::Link(node) => {
                let Some(stage) = &self.stage else { return Default::default() };
                let name = stage.poses().scene().node(node).name.clone();
                let instance = name.split('.').next().map(str::to_owned);
                (name, instance)
            }
            Obstacle::Part(number) => {
                let part = self.floor.parts.iter().find(|(_, part)| part.number == number);
                let Some((slot, part)) = part else { return (format!("part {number}"), None) };
                let carrier = self.floor.carrier(slot);
                (format!("{} {number}", super::floor::kind_name(part.kind)), carrier)
            }
        }
    }

    /// The incidents since this was asked last, each collision with the signals, as they are now, of the instances involved.
    pub(super) fn with_signals(&self, mut incidents: Vec<Incident>) -> Vec<Incident> {
        for incident in &mut incidents {
            let IncidentKind::Collision { instances, .. } = &incident.kind else { continue };
            for name in instances {
                let Ok(owner) = self.owners.binary_search_by(|(owner, _)| owner.cmp(name)) else { continue };
                for register in &self.owners[owner].1 {
                    let known = incident.signals.iter().any(|(other, _)| other == register);
                    if !known {
                        incident.signals.push((*register, self.registers.get(*register).clone()));
                    }
                }
            }
        }
        incidents
    }
}

impl super::floor::Floor {
    /// The instance that carries or holds a part, or what it stands on.
    pub(super) fn carrier(&self, slot: super::floor::Slot) -> Option<String> {
        let root = self.parts.root_of(slot);
        match self.parts.get(root).support {
            Support::Belt(belt) => Some(self.belts[belt].name.clone()),
            Support::Cups(cups) => Some(self.cups[cups].name.clone()),
            Support::Sink { sink, .. } => Some(self.drains[sink].name.clone()),
            Support::Part(_) => None,
        }
    }
}
