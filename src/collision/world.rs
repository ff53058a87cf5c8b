//! All that can run into each other, and who is near whom.

use std::collections::BTreeSet;
use std::sync::Arc;

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::piece::{COLLISION_M, Piece, apart, bounds_of, pieces_of};
use crate::kinematics::{Block, Bounds, DPose3, DQuat, DVec3, JointKind};
use crate::scene::{NodeId, Poses, Scene};

/// Something that can be run into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Obstacle {
    /// All that is rigidly joined to this frame, which moves in its parent or stands in the world.
    Link(NodeId),
    /// The part of this number.
    Part(u64),
}

/// Two that are in one another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clash {
    pub between: [Obstacle; 2],
    /// How deep, m.
    pub depth: f64,
    /// Where the first of the two is, in the world, m.
    pub place: DVec3,
}

/// A part of the floor, for a step.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Where it is kept; a place is taken again when its part has gone.
    pub slot: usize,
    pub number: u64,
    pub block: &'a Block,
}

/// How far beyond what moves is looked at least, m.
const MARGIN_M: f64 = 1e-3;
/// How many steps like the last one are looked ahead.
const AHEAD: f64 = 100.0;

/// Something that moves.
struct Mover {
    who: Obstacle,
    /// In its own frame.
    pieces: Vec<Piece>,
    /// The box about all of them, in its own frame.
    centre: DVec3,
    half: DVec3,
    /// How far its furthest corner is from its frame's origin, m.
    radius: f64,
    pose: DPose3,
    /// A bound of the way that any of its points has gone since it came, m.
    travel: f64,
    /// Where it may be without being looked up again.
    reach: Bounds,
    /// The same of its frame's origin, as long as it is turned so.
    turned: DQuat,
    origins: Bounds,
    near: Vec<Near>,
    /// Told apart from another in the same place before it.
    generation: u32,
    is_there: bool,
}

/// Somebody near, who need not be asked until both have moved further together.
#[derive(Clone, Copy)]
struct Near {
    other: Other,
    generation: u32,
    clear_until: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Other {
    Standing(u32),
    Mover(u32),
}

/// A piece that never moves.
struct Standing {
    link: NodeId,
    piece: Piece,
    bears_parts: bool,
}

/// A pair that is in one another.
#[derive(Clone, Copy, PartialEq)]
struct Touching {
    mover: u32,
    other: Other,
    between: [Obstacle; 2],
}

/// The bodies of a scene and the parts among them.
pub struct World {
    scene: Arc<Scene>,
    standing: Vec<Standing>,
    standing_tree: Bvh,
    movers: Vec<Mover>,
    mover_tree: Bvh,
    /// The mover of each frame that moves and has something solid under it.
    of_node: Vec<Option<u32>>,
    /// The mover of each part, by its slot.
    of_slot: Vec<Option<u32>>,
    free: Vec<u32>,
    may_touch: BTreeSet<[NodeId; 2]>,
    touching: Vec<Touching>,
    /// Who moved in this step.
    moved: Vec<u32>,
    /// How many pairs were asked, and for how many of them the pieces' distance was computed.
    asked: u64,
}

impl World {
    /// The bodies of the scene of `poses`, where they are now. What is in contact now may touch for ever.
    pub fn new(poses: &Poses) -> World {
        let scene = Arc::clone(poses.scene());
        let link_of = links(&scene);
        let moves = moving(&scene);
        let mut may_touch = BTreeSet::new();
        for (index, node) in scene.nodes().iter().enumerate() {
            if let Some(parent) = node.parent {
                may_touch.insert(pair(link_of[index], link_of[parent.index()]));
            }
        }
        let shapes: Vec<std::cell::OnceCell<Vec<Piece>>> = vec![std::cell::OnceCell::new(); scene.meshes().len()];
        let mut standing = Vec::new();
        let mut of_link: Vec<Vec<Piece>> = vec![Vec::new(); scene.nodes().len()];
        for body in scene.bodies().iter().filter(|body| body.is_solid) {
            let pieces = shapes[body.mesh.index()].get_or_init(|| pieces_of(&scene.meshes()[body.mesh.index()]));
            let link = link_of[body.node.index()];
            let place = *poses.world(body.node) * body.place;
            for piece in pieces {
                if moves[link.index()] {
                    let own = poses.world(link).inv_mul(&place);
                    of_link[link.index()].push(piece.at(&own));
                } else {
                    standing.push(Standing { link, piece: piece.at(&place), bears_parts: body.bears_parts });
                }
            }
        }
        let leaves: Vec<Aabb> = standing.iter().map(|it| aabb(&it.piece.bounds())).collect();
        let mut world = World {
            standing_tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves),
            standing,
            movers: Vec::new(),
            mover_tree: Bvh::new(),
            of_node: vec![None; scene.nodes().len()],
            of_slot: Vec::new(),
            free: Vec::new(),
            may_touch,
            touching: Vec::new(),
            moved: Vec::new(),
            asked: 0,
            scene,
        };
        for (index, pieces) in of_link.into_iter().enumerate() {
            if !pieces.is_empty() {
                let node = NodeId(index as u32);
                world.of_node[index] = Some(world.enter(Obstacle::Link(node), pieces, *poses.world(node)));
            }
        }
        let mut found = Vec::new();
        world.ask(&mut found);
        for clash in found {
            if let [Obstacle::Link(a), Obstacle::Link(b)] = clash.between {
                world.may_touch.insert(pair(a, b));
            }
        }
        world.touching.clear();
        // Who may touch is near nobody any more.
        (0..world.movers.len() as u32).for_each(|mover| world.look_up(mover, DVec3::ZERO));
        world
    }

    /// The pairs of links, by the names of their frames, that are in contact at the start and not joined: what may touch without
    /// anybody having said so.
    pub fn pairs_left_out(&self) -> impl Iterator<Item = [&str; 2]> {
        let joined = |a: NodeId, b: NodeId| {
            let link_of = |node: NodeId| std::iter::successors(Some(node), |at| self.scene.node(*at).parent).nth(1);
            link_of(a).is_some_and(|parent| parent == b) || link_of(b).is_some_and(|parent| parent == a)
        };
        let pairs = self.may_touch.iter().filter(move |[a, b]| a != b && !joined(*a, *b));
        pairs.map(|pair| pair.map(|node| self.scene.node(node).name.as_str()))
    }

    /// How many pairs of pieces were asked since the start: what a step costs.
    pub fn asked(&self) -> u64 {
        self.asked
    }

    /// Goes on by a step: the frames are where `poses` has them, the parts are `parts`. Who has come to be in whom is added to
    /// `found`; a pair that stays in one another is told once.
    pub fn step<'a>(&mut self, poses: &Poses, parts: impl Iterator<Item = Part<'a>>, found: &mut Vec<Clash>) {
        for node in poses.moved() {
            if let Some(mover) = self.of_node[node.index()] {
                self.shift(mover, *poses.world(*node));
            }
        }
        self.follow(parts);
        self.ask(found);
    }

    /// Follows the parts: those that moved, came and went.
    fn follow<'a>(&mut self, parts: impl Iterator<Item = Part<'a>>) {
        let mut next = 0;
        for Part { slot, number, block } in parts {
            if self.of_slot.len() <= slot {
                self.of_slot.resize(slot + 1, None);
            }
            (next..slot).for_each(|empty| self.leave(empty));
            next = slot + 1;
            match self.of_slot[slot] {
                Some(mover) if self.movers[mover as usize].who == Obstacle::Part(number) => {
                    let pose = block.pose();
                    if pose != self.movers[mover as usize].pose {
                        self.shift(mover, pose);
                    }
                }
                _ => {
                    self.leave(slot);
                    let piece = Piece::cuboid(DPose3::IDENTITY, block.size() / 2.0);
                    self.of_slot[slot] = Some(self.enter(Obstacle::Part(number), vec![piece], block.pose()));
                }
            }
        }
        (next..self.of_slot.len()).for_each(|empty| self.leave(empty));
    }

    fn leave(&mut self, slot: usize) {
        let Some(mover) = self.of_slot[slot].take() else { return };
        self.mover_tree.remove(mover);
        let gone = &mut self.movers[mover as usize];
        gone.is_there = false;
        gone.near.clear();
        gone.generation += 1;
        self.free.push(mover);
        self.touching.retain(|pair| pair.mover != mover && pair.other != Other::Mover(mover));
    }

    fn enter(&mut self, who: Obstacle, pieces: Vec<Piece>, pose: DPose3) -> u32 {
        let all = pieces.iter().fold(Bounds::EMPTY, |all, piece| all.merged(piece.bounds()));
        let (centre, half) = ((all.low + all.high) / 2.0, (all.high - all.low) / 2.0);
        let radius = all.low.abs().max(all.high.abs()).length();
        let mut mover = Mover {
            who,
            pieces,
            centre,
            half,
            radius,
            pose,
            travel: 0.0,
            reach: Bounds::EMPTY,
            turned: pose.rotation,
            origins: Bounds::EMPTY,
            near: Vec::new(),
            generation: 0,
            is_there: true,
        };
        let place = match self.free.pop() {
            Some(place) => {
                mover.generation = self.movers[place as usize].generation;
                self.movers[place as usize] = mover;
                place
            }
            None => {
                self.movers.push(mover);
                self.movers.len() as u32 - 1
            }
        };
        self.look_up(place, DVec3::ZERO);
        self.moved.push(place);
        place
    }

    /// Puts a mover elsewhere.
    fn shift(&mut self, place: u32, pose: DPose3) {
        let mover = &mut self.movers[place as usize];
        let way = pose.translation - mover.pose.translation;
        // A turn by an angle moves a point at a radius by the chord 2 r sin(angle / 2).
        let half = pose.rotation.dot(mover.pose.rotation).abs().min(1.0);
        mover.travel += way.length() + 2.0 * mover.radius * (1.0 - half * half).sqrt();
        mover.pose = pose;
        let within = if pose.rotation == mover.turned {
            mover.origins.holds(&Bounds { low: pose.translation, high: pose.translation })
        } else {
            mover.reach.holds(&mover.bounds())
        };
        if !within {
            self.look_up(place, way);
        }
        self.moved.push(place);
    }

    /// Finds out who is near a mover that goes on by `way` a step.
    fn look_up(&mut self, place: u32, way: DVec3) {
        let ahead = way.abs() * AHEAD + MARGIN_M;
        let mover = &mut self.movers[place as usize];
        let now = mover.bounds();
        let reach = Bounds { low: now.low - ahead, high: now.high + ahead };
        mover.reach = reach;
        mover.turned = mover.pose.rotation;
        let origin = mover.pose.translation;
        mover.origins = Bounds { low: origin - ahead, high: origin + ahead };
        let (who, generation) = (mover.who, mover.generation);
        let mut near = std::mem::take(&mut mover.near);
        near.clear();
        let around = aabb(&reach);
        for index in self.standing_tree.intersect_aabb(&around) {
            let standing = &self.standing[index as usize];
            let may_touch = match who {
                Obstacle::Link(link) => self.may_touch.contains(&pair(link, standing.link)),
                Obstacle::Part(_) => standing.bears_parts,
            };
            if !may_touch {
                near.push(Near { other: Other::Standing(index), generation: 0, clear_until: 0.0 });
            }
        }
        self.mover_tree.insert(around, place);
        let others: Vec<u32> = self.mover_tree.intersect_aabb(&around).filter(|other| *other != place).collect();
        for other in others {
            let them = &mut self.movers[other as usize];
            let may_touch = match (who, them.who) {
                (Obstacle::Link(a), Obstacle::Link(b)) => self.may_touch.contains(&pair(a, b)),
                (Obstacle::Part(_), Obstacle::Part(_)) => true,
                _ => false,
            };
            if may_touch || !them.is_there {
                continue;
            }
            near.push(Near { other: Other::Mover(other), generation: them.generation, clear_until: 0.0 });
            // They need not be looked up again to know of this one.
            let back = Near { other: Other::Mover(place), generation, clear_until: 0.0 };
            match them.near.iter_mut().find(|known| known.other == back.other) {
                Some(known) => *known = back,
                None => them.near.push(back),
            }
        }
        self.movers[place as usize].near = near;
    }

    /// Asks everybody who moved about everybody near.
    fn ask(&mut self, found: &mut Vec<Clash>) {
        let mut moved = std::mem::take(&mut self.moved);
        for &place in &moved {
            let mut near = std::mem::take(&mut self.movers[place as usize].near);
            near.retain_mut(|near| self.ask_one(place, near, found));
            self.movers[place as usize].near = near;
        }
        moved.clear();
        self.moved = moved;
    }

    /// False where there is nobody any more.
    fn ask_one(&mut self, place: u32, near: &mut Near, found: &mut Vec<Clash>) -> bool {
        let mover = &self.movers[place as usize];
        let (gap, travel, who) = match near.other {
            Other::Standing(index) => {
                if mover.travel < near.clear_until {
                    return true;
                }
                let standing = &self.standing[index as usize];
                let gap = mover.apart_from(std::slice::from_ref(&standing.piece), &mut self.asked);
                (gap, mover.travel, Obstacle::Link(standing.link))
            }
            Other::Mover(other) => {
                let other = &self.movers[other as usize];
                if !other.is_there || other.generation != near.generation {
                    return false;
                }
                let travel = mover.travel + other.travel;
                if travel < near.clear_until {
                    return true;
                }
                let pieces: Vec<Piece> = other.pieces.iter().map(|piece| piece.at(&other.pose)).collect();
                (mover.apart_from(&pieces, &mut self.asked), travel, other.who)
            }
        };
        near.clear_until = travel + (gap + COLLISION_M).max(0.0);
        let between = if mover.who <= who { [mover.who, who] } else { [who, mover.who] };
        let known = |it: &Touching| {
            it.between == between && ((it.mover == place && it.other == near.other) || it.other == Other::Mover(place))
        };
        if gap >= -COLLISION_M {
            self.touching.retain(|it| !known(it));
        } else if !self.touching.iter().any(known) {
            if !self.touching.iter().any(|it| it.between == between) {
                found.push(Clash { between, depth: -gap, place: mover.pose.transform_point(mover.centre) });
            }
            self.touching.push(Touching { mover: place, other: near.other, between });
        }
        true
    }
}

impl Mover {
    fn bounds(&self) -> Bounds {
        bounds_of(&(self.pose * DPose3::from_translation(self.centre)), self.half)
    }

    /// How far its pieces are from `others`, which are in the world.
    fn apart_from(&self, others: &[Piece], asked: &mut u64) -> f64 {
        let mut least = f64::INFINITY;
        for own in &self.pieces {
            let own = own.at(&self.pose);
            for other in others {
                *asked += 1;
                least = least.min(apart(&own, other, least));
            }
        }
        least
    }
}

fn pair(a: NodeId, b: NodeId) -> [NodeId; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// Of each frame, the frame of the link that it belongs to.
fn links(scene: &Scene) -> Vec<NodeId> {
    let mut links: Vec<NodeId> = Vec::with_capacity(scene.nodes().len());
    for (index, node) in scene.nodes().iter().enumerate() {
        let own = NodeId(index as u32);
        let link = match node.parent {
            Some(parent) if node.joint.kind == JointKind::Fixed => links[parent.index()],
            _ => own,
        };
        links.push(link);
    }
    links
}

/// Of each frame, whether a joint moves it or something it stands in.
fn moving(scene: &Scene) -> Vec<bool> {
    let mut moving: Vec<bool> = Vec::with_capacity(scene.nodes().len());
    for node in scene.nodes() {
        let carried = node.parent.is_some_and(|parent| moving[parent.index()]);
        moving.push(carried || node.joint.kind != JointKind::Fixed);
    }
    moving
}

fn aabb(bounds: &Bounds) -> Aabb {
    Aabb::new(bounds.low, bounds.high)
}
