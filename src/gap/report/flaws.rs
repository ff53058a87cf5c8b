//! What a schema cannot say of a report: how its numbers hang together.

use super::{Report, Verdict};

/// Rounding of sums of weights and shares.
const SLACK: f64 = 1e-6;

impl Report {
    /// What contradicts itself in a report, one line each; none in a report that a diagnosis wrote.
    ///
    /// Causes stand where the verdict adds something and nowhere else, each is the first member of its own class, an
    /// `effect` stands alone in it, intervals hold their values, shares and weights sum to 1 at most, and the largest share
    /// stands first.
    pub fn flaws(&self) -> Vec<String> {
        let mut flaws = Vec::new();
        let mut expect = |is_so: bool, flaw: &str| {
            if !is_so {
                flaws.push(flaw.to_owned());
            }
        };
        let adds = matches!(self.verdict, Verdict::Effect | Verdict::Ambiguous | Verdict::Partial);
        expect(adds != self.cause.is_empty(), "causes stand in effect, ambiguous and partial, and in no other verdict");
        let measures = self.gap.before.is_some() && self.shrink.ratio.is_some();
        expect(measures || self.verdict == Verdict::NotTestable, "only not-testable measures nothing");
        let explains = !matches!(self.verdict, Verdict::Partial | Verdict::Unknown);
        expect(explains || self.remainder.is_some(), "partial and unknown say what the remainder depends on");

        let shares: Vec<f64> = self.devices.iter().map(|device| device.share).collect();
        expect(shares.iter().sum::<f64>() <= 1.0 + SLACK, "the devices' shares sum to more than 1");
        expect(shares.is_sorted_by(|a, b| a >= b), "the largest share does not stand first");
        expect(self.all_weights().all(|weight| (0.0..=1.0 + SLACK).contains(&weight)), "a weight is not from 0 to 1");
        for cause in &self.cause {
            let first = cause.class.first();
            expect(first == Some(&cause.member()), "a cause is not the first of its class");
            expect(cause.class.len() == 1 || self.verdict != Verdict::Effect, "an effect stands in a class of several");
            let held = cause.parameters.iter().all(|p| p.ci95[0] <= p.value && p.value <= p.ci95[1]);
            expect(held, "an interval does not hold its value");
        }
        flaws
    }

    fn all_weights(&self) -> impl Iterator<Item = f64> {
        let causes = self.cause.iter().map(|cause| cause.weight);
        causes.chain(self.rivals.iter().map(|rival| rival.weight)).chain(self.outside)
    }
}
