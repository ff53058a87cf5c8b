//! A run that goes on, as the server sees it: orders to it, pictures of it, and another run in its place after a reset.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::sync::{Semaphore, watch};

use super::VIEWERS;
use super::answer::{Answer, Refusal, settled};
use super::frame::Frame;
use crate::engine::Act;
use crate::run::control::{Order, Picture};
use crate::run::live::ExchangeFrame;
use crate::run::{Facts, Handle, Quantiles, Recorded, Speed, Steering, Stop};
use crate::time::Instant;
use crate::trace::operator::Deed;

/// How often pictures are taken while somebody looks, and while nobody does.
const LIVELY: Duration = Duration::from_nanos(16_666_667);
const IDLE: Duration = Duration::from_millis(250);
/// How long an order may take; and how often a picture is looked for.
const PATIENCE: Duration = Duration::from_secs(5);
const LOOK: Duration = Duration::from_millis(1);

/// A run, and those that came after it by a reset.
#[derive(Clone)]
pub struct Live {
    facts: Facts,
    state: Arc<Mutex<State>>,
    frames: Arc<watch::Sender<Arc<Frame>>>,
}

struct State {
    steering: Steering,
    stop: Stop,
    /// Counted from 1.
    run: u32,
    reset: bool,
    has_ended: bool,
    exchange: ExchangeFrame,
    /// The trace that is being written.
    recording: Option<PathBuf>,
    paused: bool,
    speed: Speed,
}

impl Live {
    /// The run of `handle`, which can be steered; `recording` is what it records from its start.
    ///
    /// # Panics
    /// The run's options asked for no control: a bug.
    pub fn new(handle: &Handle, recording: Option<PathBuf>) -> Live {
        let facts = handle.facts().clone();
        let state = State {
            steering: steering_of(handle),
            stop: handle.stopper(),
            run: 1,
            reset: false,
            has_ended: false,
            exchange: ExchangeFrame::default(),
            recording,
            paused: false,
            speed: facts.speed,
        };
        let frames = Arc::new(watch::Sender::new(Arc::new(Frame { run: 1, ..Frame::default() })));
        Live { facts, state: Arc::new(Mutex::new(state)), frames }
    }

    /// What does not change.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// The newest frame.
    pub(super) fn frames(&self) -> watch::Receiver<Arc<Frame>> {
        self.frames.subscribe()
    }

    fn state<T>(&self, look: impl FnOnce(&mut State) -> T) -> T {
        look(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Takes what the exchange with the automation is like.
    pub fn note_exchange(&self, exchange: ExchangeFrame) {
        self.state(|state| state.exchange = exchange);
    }

    /// The exchange, as it was noted last.
    pub(super) fn exchange(&self) -> ExchangeFrame {
        self.state(|state| state.exchange)
    }

    /// The round trip so far.
    pub(super) fn round_trip(&self) -> Quantiles {
        let ask = self.state(|state| Arc::clone(&state.steering.round_trip));
        ask()
    }

    /// Whether the run has ended for good.
    pub(super) fn has_ended(&self) -> bool {
        self.state(|state| state.has_ended)
    }

    /// The run has ended. Whether another is to take its place, because somebody asked for a reset.
    pub fn ended(&self) -> bool {
        self.state(|state| {
            state.has_ended = !state.reset;
            state.recording = None;
            std::mem::take(&mut state.reset)
        })
    }

    /// Another run takes the place of the one that ended.
    pub fn install(&self, handle: &Handle) {
        self.state(|state| {
            state.steering = steering_of(handle);
            state.stop = handle.stopper();
            state.run += 1;
            (state.paused, state.speed) = (false, self.facts.speed);
        });
    }

    /// Ends the run and has another begin.
    pub(super) async fn reset(&self) -> Answer<()> {
        let run = self.state(|state| {
            state.reset = true;
            state.stop.stop();
            state.run
        });
        let begun = async {
            while self.state(|state| state.run == run && !state.has_ended) {
                tokio::time::sleep(LOOK).await;
            }
        };
        let refuse = |error: &str| {
            Refusal::new(axum::http::StatusCode::GATEWAY_TIMEOUT, error, "the program's own output says how it ended")
        };
        tokio::time::timeout(PATIENCE * 2, begun).await.map_err(|_| refuse("the run did not end within 10 s"))?;
        if self.has_ended() { Err(refuse("the run has ended, and none took its place")) } else { Ok(()) }
    }

    /// Has the simulation do what an operator wants done to the plant.
    pub(super) async fn operate(&self, deed: &Deed, act: Act) -> Answer<Instant> {
        self.give(Order::Operate { act, deed: deed.text() }, PATIENCE).await
    }

    async fn give(&self, order: Order, patience: Duration) -> Answer<Instant> {
        if self.has_ended() {
            return Err(Refusal::conflict("the run has ended", "start the program anew"));
        }
        let controls = self.state(|state| state.steering.controls.clone());
        settled(controls.order(order)?, patience).await
    }

    /// Lets the automation's clock go by as the simulation's does.
    fn follow(&self) {
        let (tempo, rate) = self.state(|state| {
            let rate = match (state.paused, state.speed) {
                (false, Speed::Wall(speed)) => speed,
                _ => 0.0,
            };
            (Arc::clone(&state.steering.tempo), rate)
        });
        tempo(rate);
    }

    /// Halts simulated time, or lets it go on.
    pub(super) async fn pause(&self, paused: bool) -> Answer<Instant> {
        let order = if paused { Order::Pause } else { Order::Resume };
        let at = self.give(order, PATIENCE).await?;
        self.state(|state| state.paused = paused);
        self.follow();
        Ok(at)
    }

    /// Makes so many steps, and pauses.
    pub(super) async fn step(&self, steps: u64) -> Answer<Instant> {
        let speed = self.state(|state| state.speed);
        let factor = if let Speed::Wall(factor) = speed { factor } else { 1.0 };
        let lasts = Duration::from_secs_f64(self.facts.step.as_secs_f64() * steps as f64 / factor);
        self.state(|state| state.paused = false);
        self.follow();
        let at = self.give(Order::Steps(steps), PATIENCE + lasts * 2).await;
        self.state(|state| state.paused = true);
        self.follow();
        at
    }

    /// Lets simulated time go by like this.
    pub(super) async fn set_speed(&self, speed: Speed) -> Answer<Instant> {
        let at = self.give(Order::Speed(speed), PATIENCE).await?;
        self.state(|state| state.speed = speed);
        self.follow();
        Ok(at)
    }

    /// The trace that is being written.
    pub(super) fn recording(&self) -> Option<PathBuf> {
        self.state(|state| state.recording.clone())
    }

    /// Begins a trace.
    pub(super) async fn record(&self, path: PathBuf) -> Answer<()> {
        let recorded = self.state(|state| state.steering.record.begin(path));
        let path = written(recorded).await?;
        self.state(|state| state.recording = path);
        Ok(())
    }

    /// Ends the trace that is being written. The file.
    pub(super) async fn stop_recording(&self) -> Answer<Option<PathBuf>> {
        let recorded = self.state(|state| state.steering.record.end());
        let path = written(recorded).await?;
        self.state(|state| state.recording = None);
        Ok(path)
    }

    /// Takes pictures for ever: often while somebody looks (`viewers` has fewer places left than there are).
    pub(super) async fn take_pictures(&self, viewers: &Semaphore) {
        let mut room = Picture::default();
        let mut next = tokio::time::Instant::now();
        loop {
            let (controls, run) = self.state(|state| (state.steering.controls.clone(), state.run));
            controls.ask(std::mem::take(&mut room));
            let taken = loop {
                tokio::time::sleep(LOOK).await;
                match controls.picture() {
                    Some(picture) => break Some(picture),
                    None if self.state(|state| state.run) != run => break None,
                    None => {}
                }
            };
            if let Some(picture) = taken {
                let speed = if let Speed::Wall(factor) = picture.speed { factor } else { 0.0 };
                let old = self.frames.send_replace(Arc::new(Frame { run, picture, ghost: None, speed }));
                // Its buffers serve again, unless somebody is still reading it.
                room = Arc::try_unwrap(old).map(|frame| frame.picture).unwrap_or_default();
            }
            let interval = if viewers.available_permits() < VIEWERS { LIVELY } else { IDLE };
            next = (next + interval).max(tokio::time::Instant::now());
            // Somebody who comes while nobody looked does not wait long.
            while tokio::time::Instant::now() < next {
                tokio::time::sleep(LIVELY.min(next - tokio::time::Instant::now())).await;
                if interval == IDLE && viewers.available_permits() < VIEWERS {
                    break;
                }
            }
        }
    }
}

fn steering_of(handle: &Handle) -> Steering {
    match handle.steering() {
        Some(steering) => steering,
        None => unreachable!("a run that is viewed is started with control"),
    }
}

async fn written(recorded: Recorded) -> Answer<Option<PathBuf>> {
    let looked = async {
        loop {
            if let Some(done) = recorded.get() {
                return done.clone();
            }
            tokio::time::sleep(LOOK).await;
        }
    };
    let refuse = |error: String| Refusal::conflict(error, "choose another file, or look whether the disk has room");
    match tokio::time::timeout(PATIENCE, looked).await {
        Ok(done) => done.map_err(|error| refuse(format!("failed to record: {error}"))),
        Err(_) => Err(refuse("the recorder did not answer within 5 s".to_owned())),
    }
}
