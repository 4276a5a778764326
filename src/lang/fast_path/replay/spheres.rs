//! Replay of recorded spheres.

use super::cache::{Known, Level};
use crate::base::args::Parse;
use crate::base::color::Color;
use crate::lang::reader::Reader;
use crate::scene::shape::Sphere;
use std::rc::Rc;

impl Reader<'_> {
    /// The recorded sphere with this index; `None`, without effect, if it has to be read.
    pub(super) fn replay_recorded_sphere(
        &mut self,
        index: u32,
    ) -> Parse<Option<(Sphere, Option<Color>)>> {
        let sphere = Rc::clone(&self.replays.spheres[index as usize]);
        self.replays.begin();
        let (scopes, streams) = (&self.scopes, &mut self.streams);
        let read = sphere.read(
            &mut self.replays,
            &self.draft.default_layer,
            scopes,
            streams,
        );
        if read.is_none() {
            self.replays.give_up(&mut self.streams);
            return Ok(None);
        }
        self.count_replayed()?;
        self.here.at = sphere.after - 1;
        self.pass();
        Ok(read)
    }

    /// The next object, if it is a recorded sphere.
    #[inline]
    pub(in crate::lang) fn replay_sphere(&mut self) -> Parse<Option<(Sphere, Option<Color>)>> {
        if !self.is_repeated() || !self.may_replay() {
            return Ok(None);
        }
        let (file, start) = (self.here.tokens.file, self.here.at);
        match self.replays.known(file, start, Level::Object) {
            Known::RecordedSphere(index) => self.replay_recorded_sphere(index),
            _ => Ok(None),
        }
    }
}
