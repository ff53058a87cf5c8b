//! What one device says about the ways of the messages that told it something.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::super::Task;
use super::super::voter::Voter;
use super::MOST_S;
use crate::effect::EffectError;
use crate::gap::recording::Stamped;
use crate::gap::stamps;

/// Every so many of a device's messages are moved together to see what each does: what it does is over, or stays, when the next of
/// them comes.
const TOGETHER: usize = 8;
/// By how much a message is moved, s: about as much as ways scatter.
const NUDGE_S: f64 = 5e-5;
/// In floors, what the greatest way must do to a device for it to say anything about a message.
const SHOWS: f64 = 1.0;
/// How many messages of a device are looked at, those that show the most.
const MOST_MESSAGES: usize = 300;
/// Of what stays for ever after a message, in floors for the greatest way, what is not worth remembering.
const STAYS: f64 = 0.02;
/// How many messages there must be for each thing that a device's own could go with.
const MESSAGES_EACH: usize = 3;
/// How far the age of reports is known once it was found, standard deviation, s: as far as instants are at most taken to be off.
const AGE_S: f64 = stamps::MOST_S;
/// A prior so weak that it is none, as a share of what is known without.
const NO_PRIOR: f64 = 1e-9;

/// A device that has a say.
pub(super) struct Says {
    pub voter: Voter,
    /// The stamps of its messages, s, ascending.
    pub told: Vec<f64>,
    /// How far a second later of each moves the samples, in floors: places among [`Voter::kept`], and by how much.
    moves: Vec<Vec<(usize, f64)>>,
    /// What the ways of a device would go with that are its own: by message.
    own: DMatrix<f64>,
    /// The commands as they were stamped.
    stamped: Vec<(usize, Stamped)>,
    /// By how much later each message acts than its stamp says, as the device is told now, s.
    acting: DVector<f64>,
}

impl Says {
    /// `None` where nothing that the device is told shows.
    pub fn new(voter: Voter) -> Result<Option<Says>, EffectError> {
        let stamped = voter.subject.runs[0].commands.clone();
        let mut told: Vec<f64> = stamped.iter().map(|(_, command)| command.at).collect();
        told.dedup();
        let count = told.len();
        let own = DMatrix::zeros(0, 0);
        let mut says = Says { voter, told, moves: Vec::new(), own, stamped, acting: DVector::zeros(count) };
        says.moves = says.moves()?;
        let strength = |moves: &[(usize, f64)]| moves.iter().map(|(_, by)| by * by).sum::<f64>().sqrt();
        let task = says.task();
        let shows = |place: &usize| strength(&says.moves[*place]) * MOST_S > SHOWS && is_free(task, says.told[*place]);
        let mut kept: Vec<usize> = (0..count).filter(shows).collect();
        kept.sort_by(|a, b| strength(&says.moves[*b]).total_cmp(&strength(&says.moves[*a])));
        kept.truncate(MOST_MESSAGES);
        kept.sort_unstable();
        says.told = kept.iter().map(|place| says.told[*place]).collect();
        says.moves = kept.iter().map(|place| std::mem::take(&mut says.moves[*place])).collect();
        says.acting = DVector::zeros(says.told.len());
        says.own = own_of(&says.stamped, &says.told);
        Ok((says.told.len() >= MESSAGES_EACH * says.own.ncols().max(1)).then_some(says))
    }

    /// What takes its commands up.
    pub fn task(&self) -> Task {
        self.voter.subject.runs[0].task
    }

    /// How many things of its own ways could go with.
    pub fn things(&self) -> usize {
        self.own.ncols()
    }

    /// Has each command act so much later than its stamp says, and takes the nominal parameters to be what they are best then.
    pub fn tell(&mut self, later: &dyn Fn(f64) -> f64) -> Result<(), EffectError> {
        self.voter.subject.runs[0].commands = self.commands(later);
        let task = self.task();
        let by = |at: &f64| if later(*at) == 0.0 { 0.0 } else { task.taken_up(at + later(*at)) - task.taken_up(*at) };
        self.acting = DVector::from_iterator(self.told.len(), self.told.iter().map(by));
        let (stayed, before) = (self.voter.clone(), self.voter.moments(None)?.cost(0.0));
        self.voter.centre(task)?;
        if self.voter.moments(None)?.cost(0.0) > before {
            self.voter = stayed;
        }
        Ok(())
    }

    fn commands(&self, later: &dyn Fn(f64) -> f64) -> Vec<(usize, Stamped)> {
        let act = |&(port, told): &(usize, Stamped)| (port, Stamped { at: told.at + later(told.at), ..told });
        let mut commands: Vec<(usize, Stamped)> = self.stamped.iter().map(act).collect();
        commands.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
        commands
    }

    /// How far a second later of each message moves the samples.
    fn moves(&self) -> Result<Vec<Vec<(usize, f64)>>, EffectError> {
        let every_s = self.task().every_s;
        let nudge = if every_s > 0.0 { (NUDGE_S / every_s).ceil() * every_s } else { NUDGE_S };
        let base = self.voter.left()?;
        let mut moves = vec![Vec::new(); self.told.len()];
        for first in 0..TOGETHER.min(self.told.len()) {
            let mine: Vec<usize> = (first..self.told.len()).step_by(TOGETHER).collect();
            let is_mine = |at: f64| {
                let place = self.told.partition_point(|told| *told < at);
                place % TOGETHER == first
            };
            let mut beside = self.voter.clone();
            beside.subject.runs[0].commands = self.commands(&|at| if is_mine(at) { nudge } else { 0.0 });
            let moved = (&base - beside.left()?) / nudge;
            self.share_out(&mine, &moved, &mut moves);
        }
        Ok(moves)
    }

    /// What moved belongs to the last of `mine` that was told before; what stays when the next comes is its for ever after.
    fn share_out(&self, mine: &[usize], moved: &DVector<f64>, moves: &mut [Vec<(usize, f64)>]) {
        let run = &self.voter.subject.runs[0];
        let kept = &self.voter.kept;
        let mut begin = 0;
        while begin < kept.len() {
            let signal = kept[begin].0;
            let end = begin + kept[begin..].partition_point(|(place, _)| *place == signal);
            let Some(track) = &run.tracks[signal] else {
                begin = end;
                continue;
            };
            let at = |place: usize| track.grid.instants[track.first + kept[place].1];
            let (mut from, mut before) = (begin, 0.0);
            for (turn, message) in mine.iter().enumerate() {
                let next = mine.get(turn + 1).map_or(f64::INFINITY, |next| self.told[*next]);
                let is_before = |place: &usize| at(*place) < self.told[*message];
                from += (from..end).take_while(is_before).count();
                let own = (from..end).take_while(|place| at(*place) < next).count();
                moves[*message].extend((from..from + own).map(|place| (place, moved[place] - before)));
                from += own;
                let stays = if own > 0 { moved[from - 1] - before } else { 0.0 };
                if stays.abs() * MOST_S > STAYS {
                    moves[*message].extend((from..end).map(|place| (place, stays)));
                }
                before += stays;
            }
            begin = end;
        }
    }

    /// What it says, without and with what is its own left free.
    pub fn forms(&self) -> Result<(Form, Form), EffectError> {
        let mut rest = self.voter.left()?;
        // As if nothing were later than its stamp.
        for (moves, acting) in self.moves.iter().zip(&self.acting) {
            moves.iter().for_each(|(place, by)| rest[*place] += by * acting);
        }
        let count = self.told.len();
        let mut dense = DMatrix::zeros(rest.len(), count);
        for (column, moves) in self.moves.iter().enumerate() {
            moves.iter().for_each(|(place, by)| dense[(*place, column)] += by);
        }
        let transposed = dense.transpose();
        let squares = &transposed * &dense;
        let products = &transposed * &rest;
        let voter = &self.voter;
        let nuisances = voter.columns.ncols();
        let mut beside = DMatrix::zeros(rest.len(), nuisances + 1);
        beside.columns_mut(0, nuisances).copy_from(&voter.columns);
        beside.set_column(nuisances, &(&voter.slopes * AGE_S));
        let mut strain = DVector::zeros(nuisances + 1);
        strain.rows_mut(0, nuisances).copy_from(&voter.strain);
        let all = Form::new(squares, products, rest.norm_squared(), voter.count);
        let prior = DVector::from_element(nuisances + 1, 1.0);
        let by_messages = &transposed * &beside;
        let by_rest = beside.transpose() * &rest - &strain;
        let plain = all.without(&(beside.transpose() * &beside), &by_messages, &by_rest, &prior, strain.norm_squared());
        // What is its own is a multiple of what messages do, so that all about it follows from what is known of those.
        let own = self.own.transpose();
        let known = &own * &plain.squares * &self.own;
        let weak = known.diagonal().map(|square| NO_PRIOR * square + f64::MIN_POSITIVE);
        let free = plain.without(&known, &(&plain.squares * &self.own), &(&own * &plain.products), &weak, 0.0);
        Ok((plain.spread(), free.spread()))
    }
}

/// Whether another way within reach makes a difference under a task.
fn is_free(task: Task, at: f64) -> bool {
    let wait = task.taken_up(at) - at;
    task.every_s <= 0.0 || wait < MOST_S || task.every_s - wait < MOST_S
}

/// What of a device's own could look like ways of its commands, by message: of each port whether it is told, which way it is to
/// go, how far that is, either way and in all, and when; and, of what goes on until it is told otherwise, a share of the way since the
/// command before, either way, in all and the longer the more: a drive that is too slow by next to nothing falls back by that.
fn own_of(stamped: &[(usize, Stamped)], told: &[f64]) -> DMatrix<f64> {
    const EACH: usize = 8;
    let ports = stamped.iter().map(|(port, _)| *port).collect::<std::collections::BTreeSet<_>>();
    let ends = told.last().copied().unwrap_or(1.0).max(1.0);
    let mut own = DMatrix::zeros(told.len(), EACH * ports.len());
    for (place, port) in ports.iter().enumerate() {
        let (mut before, mut since) = (0.0, 0.0);
        for (_, command) in stamped.iter().filter(|(to, _)| to == port) {
            let by = command.value - before;
            let way = before * (command.at - since);
            (before, since) = (command.value, command.at);
            let row = told.partition_point(|at| *at < command.at);
            if told.get(row) == Some(&command.at) && by != 0.0 {
                let (time, share) = (command.at / ends, way / by);
                let each = [1.0, by.signum(), by, by.abs(), time, share, share * way.signum(), share * time];
                each.iter().enumerate().for_each(|(k, value)| own[(row, EACH * place + k)] = *value);
            }
        }
    }
    // Each as long as the others; what says nothing, such as how far of what goes one way only, is left out.
    let columns = own.column_iter().filter(|column| column.norm() > 0.0);
    let columns: Vec<DVector<f64>> = columns.map(|column| column.normalize() * (told.len() as f64).sqrt()).collect();
    if columns.is_empty() { DMatrix::zeros(told.len(), 0) } else { DMatrix::from_columns(&columns) }
}

/// What is left of a device's samples as a square of its messages' ways τ: squares·τ² − 2·products·τ + rest, in floors.
pub(super) struct Form {
    pub squares: DMatrix<f64>,
    pub products: DVector<f64>,
    rest: f64,
    count: f64,
    /// How much of it lies in each direction, and its squares there.
    spread: Vec<(f64, f64)>,
}

impl Form {
    fn new(squares: DMatrix<f64>, products: DVector<f64>, rest: f64, count: f64) -> Form {
        Form { squares, products, rest, count, spread: Vec::new() }
    }

    /// The same with what else could take of it taken off: things whose squares, products with messages and with the rest are known.
    fn without(
        &self,
        squares: &DMatrix<f64>,
        by_messages: &DMatrix<f64>,
        by_rest: &DVector<f64>,
        prior: &DVector<f64>,
        strain: f64,
    ) -> Form {
        let known = (squares + DMatrix::from_diagonal(prior)).cholesky();
        let Some(known) = known else {
            return Form::new(self.squares.clone(), self.products.clone(), self.rest, self.count);
        };
        let taken = known.solve(by_rest);
        let taken_messages = known.solve(&by_messages.transpose());
        Form::new(
            &self.squares - by_messages * taken_messages,
            &self.products - by_messages * &taken,
            self.rest + strain - by_rest.dot(&taken),
            self.count,
        )
    }

    /// The same, its directions found.
    fn spread(self) -> Form {
        let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(self.squares.clone());
        let along = eigenvectors.transpose() * &self.products;
        let spread = eigenvalues.iter().zip(&along).map(|(square, along)| (square.max(0.0), along * along));
        Form { spread: spread.collect(), ..self }
    }

    /// What is left of the samples where ways scatter by `scatter_s` and the error's variance is `square` floors squared.
    fn left(&self, scatter_s: f64, square: f64) -> f64 {
        let prior = square / (scatter_s * scatter_s);
        let taken = if scatter_s > 0.0 {
            self.spread.iter().map(|(squares, along)| along / (squares + prior)).sum()
        } else {
            0.0
        };
        (self.rest - taken).max(0.0)
    }

    /// −2 ln of how likely so great a scatter is, s, but for a constant, the error's variance being the likeliest; and that, in floors
    /// squared.
    pub fn deviance(&self, scatter_s: f64) -> (f64, f64) {
        // A floor that is thought too high is so by less than half.
        let squares = (-4..80).map(|step| 2.0_f64.powf(0.5 * f64::from(step)));
        let of = |square: f64| {
            let ratio = scatter_s * scatter_s / square;
            let volume = self.spread.iter().map(|(squares, _)| (squares * ratio).ln_1p()).sum::<f64>();
            (self.count * square.ln() + self.left(scatter_s, square) / square + volume, square)
        };
        squares.map(of).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 1.0))
    }

    /// Whether what `free` takes off beyond this, with so many things that ways could go with, is no more than ways that scatter make of
    /// it by chance: within three standard deviations of a χ² of as many degrees of freedom.
    pub fn is_by_chance(&self, free: &Form, things: usize, (scatter_s, square): (f64, f64)) -> bool {
        let further = things as f64;
        let taken = (self.left(scatter_s, square) - free.left(scatter_s, square)) / square;
        taken <= further + 3.0 * (2.0 * further).sqrt()
    }
}
