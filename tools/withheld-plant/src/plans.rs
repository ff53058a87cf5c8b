//! Which cases an exam has: how many of each sort, which effect at which spot, on which plant.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::catalogue::{self, ENTRIES, Entry, Spot};
use crate::chance::Dice;
use crate::magnitude::Magnitude;
use crate::site::{Site, Sites};

/// What sort of case one is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sort {
    /// One effect of the library.
    Single,
    /// Nothing is wrong.
    None,
    /// Two effects on one device.
    TwoOnOneDevice,
    /// One effect on each of two devices.
    OneOnEachOfTwo,
    /// An effect that no file of the library describes.
    Outside,
}

/// A case to be made.
#[derive(Clone, Debug)]
pub struct Plan {
    pub sort: Sort,
    pub site: Site,
    pub magnitude: Magnitude,
    /// The effects that are to be tried first; what does not show enough in the recording is replaced.
    pub first: Vec<(usize, Spot)>,
    pub seed: u64,
}

/// How many cases of each sort.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    pub single: usize,
    pub faint: usize,
    pub below: usize,
    pub none: usize,
    pub two_on_one: usize,
    pub one_on_each: usize,
    pub outside: usize,
}

impl Sizes {
    /// A fixed sample of 24, by the shares of the whole but for the rarest.
    pub const SHORT: Sizes =
        Sizes { single: 8, faint: 2, below: 2, none: 6, two_on_one: 1, one_on_each: 1, outside: 4 };
    /// The whole exam.
    pub const WHOLE: Sizes =
        Sizes { single: 400, faint: 150, below: 150, none: 400, two_on_one: 60, one_on_each: 60, outside: 200 };

    /// All of them together.
    pub fn sum(self) -> usize {
        self.single + self.faint + self.below + self.none + self.two_on_one + self.one_on_each + self.outside
    }

    /// So many cases in the shares of these; the rest is single effects.
    pub fn scaled(self, cases: usize) -> Sizes {
        let part = |of: usize| (of * cases) / self.sum().max(1);
        let mut scaled = Sizes {
            single: 0,
            faint: part(self.faint),
            below: part(self.below),
            none: part(self.none),
            two_on_one: part(self.two_on_one),
            one_on_each: part(self.one_on_each),
            outside: part(self.outside),
        };
        scaled.single = cases - scaled.sum();
        scaled
    }
}

/// The cases of `seed` at `sites`, in an order that says nothing.
pub fn plans(sizes: Sizes, sites: Sites, seed: u64) -> Vec<Plan> {
    let mut dice = Dice::new(seed, 1);
    let mut library = Deck::new(false);
    let mut outside = Deck::new(true);
    let mut plans = Vec::new();
    let clear = |k: usize| if k.is_multiple_of(2) { Magnitude::Clear } else { Magnitude::Gross };
    for (count, sort, magnitude) in [
        (sizes.single, Sort::Single, None),
        (sizes.faint, Sort::Single, Some(Magnitude::Faint)),
        (sizes.below, Sort::Single, Some(Magnitude::BelowNoise)),
        (sizes.none, Sort::None, Some(Magnitude::None)),
        (sizes.two_on_one, Sort::TwoOnOneDevice, None),
        (sizes.one_on_each, Sort::OneOnEachOfTwo, None),
        (sizes.outside, Sort::Outside, None),
    ] {
        for k in 0..count {
            let magnitude = magnitude.unwrap_or(clear(k));
            let graded = magnitude == Magnitude::Faint || magnitude == Magnitude::BelowNoise;
            let site = sites.site(plans.len());
            let first = match sort {
                Sort::None => Vec::new(),
                Sort::Single => vec![
                    library.next(&mut dice, |entry, spot| site.fits(entry, spot) && (entry.has_strength() || !graded)),
                ],
                Sort::Outside => vec![outside.next(&mut dice, |entry, spot| site.fits(entry, spot))],
                Sort::TwoOnOneDevice | Sort::OneOnEachOfTwo => {
                    let one = library.next(&mut dice, |entry, spot| site.fits(entry, spot) && entry.has_strength());
                    let same = sort == Sort::TwoOnOneDevice;
                    let two = library.next(&mut dice, |entry, spot| {
                        let other = entry.effect != ENTRIES[one.0].effect && entry.place != ENTRIES[one.0].place;
                        let is_where = (spot.0 == one.1.0) == same && site.fits(entry, spot);
                        entry.has_strength() && is_where && (other || !same)
                    });
                    vec![one, two]
                }
            };
            plans.push(Plan { sort, site, magnitude, first, seed: dice.seed() });
        }
    }
    dice.shuffle(&mut plans);
    plans
}

/// So many cases of one effect, clear and gross in turn, at one spot after the other; `None` where the catalogue has no such effect.
pub fn of_effect(effect: &str, cases: usize, sites: Sites, seed: u64) -> Option<Vec<Plan>> {
    let (mut dice, is_outside) = (Dice::new(seed, 1), catalogue::is_outside(effect));
    let mut deck = Deck::new(is_outside);
    ENTRIES.iter().find(|entry| entry.effect == effect)?;
    let plan = |k: usize| {
        let site = sites.site(k);
        let first = vec![deck.next(&mut dice, |entry, spot| entry.effect == effect && site.fits(entry, spot))];
        let sort = if is_outside { Sort::Outside } else { Sort::Single };
        let magnitude = if k.is_multiple_of(2) { Magnitude::Clear } else { Magnitude::Gross };
        Plan { sort, site, magnitude, first, seed: dice.seed() }
    };
    Some((0..cases).map(plan).collect())
}

/// Every effect at every spot, dealt out again when all have had their turn.
pub struct Deck {
    outside: bool,
    left: Vec<(usize, Spot)>,
}

impl Deck {
    /// With the effects that the library lacks, or those that it has.
    pub fn new(outside: bool) -> Deck {
        Deck { outside, left: Vec::new() }
    }

    /// The next of those that fit.
    pub fn next(&mut self, dice: &mut Dice, fits: impl Fn(&Entry, Spot) -> bool) -> (usize, Spot) {
        let is_fit = |(entry, spot): &(usize, Spot)| fits(&ENTRIES[*entry], *spot);
        if !self.left.iter().any(is_fit) {
            let all =
                ENTRIES.iter().enumerate().filter(|(_, entry)| catalogue::is_outside(entry.effect) == self.outside);
            let mut all: Vec<_> = all.flat_map(|(at, entry)| entry.spots.iter().map(move |spot| (at, *spot))).collect();
            dice.shuffle(&mut all);
            // Each effect once before any comes at its second spot.
            let mut turns = BTreeMap::new();
            let turn = |(at, _): &(usize, Spot)| {
                let turn = turns.entry(*at).or_insert(0);
                *turn += 1;
                *turn
            };
            let order: Vec<i32> = all.iter().map(turn).collect();
            let mut both: Vec<_> = order.into_iter().zip(all).collect();
            both.sort_by_key(|(turn, _)| std::cmp::Reverse(*turn));
            self.left.extend(both.into_iter().map(|(_, one)| one));
        }
        let at = self.left.iter().rposition(is_fit).unwrap_or(0);
        self.left.remove(at)
    }
}
