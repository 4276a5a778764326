//! The interiors of a world: few are written, every object has one.

use crate::scene::interior::{Interior, PreparedMedia};
use crate::scene::texture::Finish;
use std::sync::Arc;

/// Which interior: objects that share one, share the number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InteriorId(pub(crate) u32);

/// From here on, numbers stand for interiors that no scene has written: all alike, yet each its own.
const UNNAMED: u32 = 1 << 31;

impl InteriorId {
    /// The interior of what has none.
    pub const AIR: InteriorId = InteriorId(UNNAMED);

    /// Whether no scene has written it.
    pub(super) fn is_unnamed(self) -> bool {
        self.0 >= UNNAMED
    }
}

/// All interiors of a world.
#[derive(Debug, Default)]
pub struct Interiors {
    written: Vec<Interior>,
    /// Whether they are those of hollow objects; first the written ones, then the others.
    hollow: [Vec<bool>; 2],
    unnamed: u32,
    default: Interior,
    /// The media of the written ones; those behind the last that has any are left out.
    media: Vec<Arc<[PreparedMedia]>>,
}

impl Interiors {
    /// A new number for an interior that the scene writes. Every copy of an object has its own: whoever goes from one
    /// copy into another has not left the first (measured with POV-Ray).
    pub(super) fn written(&mut self, interior: Interior) -> InteriorId {
        let number =
            u32::try_from(self.written.len()).expect("the number of objects is limited below 2^31");
        self.written.push(interior);
        InteriorId(number)
    }

    /// A number for an object without one.
    pub(super) fn unnamed(&mut self) -> InteriorId {
        self.unnamed += 1;
        InteriorId(UNNAMED + self.unnamed)
    }

    /// The first of so many numbers for objects without one; the others follow it.
    pub(super) fn unnamed_ones(&mut self, count: u32) -> InteriorId {
        let first = self.unnamed();
        self.unnamed += count - 1;
        first
    }

    /// The interior of an object that says `own` itself and would else have `above`; `finishes`, lowest layer first,
    /// may change it as old scenes do.
    pub(super) fn of_object<'a>(
        &mut self,
        own: Option<&Arc<Interior>>,
        above: Option<InteriorId>,
        finishes: impl Iterator<Item = &'a Finish> + Clone,
    ) -> InteriorId {
        let is_changed = finishes.clone().any(Finish::has_interior);
        match (own, above) {
            (None, Some(above)) if !is_changed => above,
            (None, None) if !is_changed => self.unnamed(),
            (own, above) => {
                let inherited = || above.map_or_else(Interior::default, |id| self.get(id).clone());
                let mut interior = own.map_or_else(inherited, |own| (**own).clone());
                interior.take_from_finishes(finishes);
                self.written(interior)
            }
        }
    }

    /// Says what fills an interior that the scene writes.
    pub(super) fn fill(&mut self, id: InteriorId, media: Arc<[PreparedMedia]>) {
        let number = id.0 as usize;
        if self.media.len() <= number {
            self.media.resize_with(number + 1, Arc::default);
        }
        self.media[number] = media;
    }

    /// Fills an interior as the one that it is made of.
    pub(super) fn hand_down(&mut self, from: Option<InteriorId>, to: InteriorId) {
        let known = from.and_then(|from| self.media.get(from.0 as usize));
        if let Some(media) = known.filter(|media| !media.is_empty() && from != Some(to)) {
            let media = Arc::clone(media);
            self.fill(to, media);
        }
    }

    /// What fills an interior.
    #[must_use]
    pub fn media(&self, id: InteriorId) -> &[PreparedMedia] {
        self.media.get(id.0 as usize).map_or(&[], |media| media)
    }

    /// What fills any of them.
    pub(super) fn all_media(&self) -> impl Iterator<Item = &PreparedMedia> {
        self.media.iter().flat_map(|media| &**media)
    }

    /// Whether something fills some interior.
    #[must_use]
    pub fn have_media(&self) -> bool {
        !self.media.is_empty()
    }

    /// Whether light from a source fades in some of them.
    #[must_use]
    pub fn fade_light(&self) -> bool {
        self.written.iter().any(Interior::fades)
    }

    /// Whether some of them split white light.
    #[must_use]
    pub fn split_light(&self) -> bool {
        let mut written = self.written.iter();
        written.any(|interior| interior.effective_dispersion() != 1.0)
    }

    /// Says whether the object of an interior is hollow.
    pub(super) fn set_hollow(&mut self, id: InteriorId, is_hollow: bool) {
        let (kind, number) = Self::place(id);
        let known = &mut self.hollow[kind];
        if known.len() <= number {
            if !is_hollow {
                return;
            }
            known.resize(number + 1, false);
        }
        known[number] = is_hollow;
    }

    /// Whether the atmosphere goes on in an interior.
    #[must_use]
    pub fn is_hollow(&self, id: InteriorId) -> bool {
        let (kind, number) = Self::place(id);
        self.hollow[kind].get(number).copied().unwrap_or(false)
    }

    fn place(id: InteriorId) -> (usize, usize) {
        if id.0 < UNNAMED {
            (0, id.0 as usize)
        } else {
            (1, (id.0 - UNNAMED) as usize)
        }
    }

    /// The interior of a number.
    #[must_use]
    pub fn get(&self, id: InteriorId) -> &Interior {
        self.written.get(id.0 as usize).unwrap_or(&self.default)
    }
}
