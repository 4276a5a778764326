//! The interiors of a world: every object has one, but few are written in the scene.

use crate::scene::interior::{Interior, PreparedMedia};
use crate::scene::texture::Finish;
use std::sync::Arc;

/// Identifies an interior; objects that share an interior share the id.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InteriorId(pub(crate) u32);

/// Ids from here on stand for interiors that the scene does not write: all alike, but each with its own identity.
const UNNAMED: u32 = 1 << 31;

impl InteriorId {
    /// The interior of objects without one.
    pub const NONE: InteriorId = InteriorId(UNNAMED);

    /// Returns true if the scene does not write it.
    pub(super) fn is_unnamed(self) -> bool {
        self.0 >= UNNAMED
    }
}

/// All interiors of a world.
#[derive(Debug, Default)]
pub struct Interiors {
    written: Vec<Interior>,
    /// True for interiors of hollow objects; first the written interiors, then the others.
    hollow: [Vec<bool>; 2],
    unnamed: u32,
    default: Interior,
    /// Interiors that the scene does not write but finishes have changed, by rising id.
    changed: Vec<(InteriorId, Interior)>,
    /// The media of the written interiors, up to the last one that has any.
    media: Vec<Arc<[PreparedMedia]>>,
}

impl Interiors {
    /// A new id for an interior that the scene writes. Each copy of an object gets its own: a ray that enters a second
    /// copy has not left the first (measured with POV-Ray).
    pub(super) fn written(&mut self, interior: Interior) -> InteriorId {
        let number =
            u32::try_from(self.written.len()).expect("the number of objects is limited below 2^31");
        self.written.push(interior);
        InteriorId(number)
    }

    /// A new id for an object without an interior.
    pub(super) fn unnamed(&mut self) -> InteriorId {
        self.unnamed += 1;
        InteriorId(UNNAMED + self.unnamed)
    }

    /// The first of `count` consecutive ids for objects without an interior.
    pub(super) fn unnamed_ones(&mut self, count: u32) -> InteriorId {
        let first = self.unnamed();
        self.unnamed += count - 1;
        first
    }

    /// The interior of an object that writes `own` and inherits `above`. The `finishes` of its texture, lowest layer
    /// first, may change it, as in old scenes: also the one that it shares with all objects of a CSG object or union.
    pub(super) fn of_object<'a>(
        &mut self,
        own: Option<&Arc<Interior>>,
        above: Option<InteriorId>,
        finishes: impl Iterator<Item = &'a Finish> + Clone,
    ) -> InteriorId {
        let is_changed = finishes.clone().any(Finish::has_interior);
        match (own, above) {
            (None, Some(above)) => {
                if is_changed {
                    self.get_mut(above).take_finish_settings(finishes);
                }
                above
            }
            (None, None) if !is_changed => self.unnamed(),
            (own, None) | (own @ Some(_), _) => {
                let mut interior = own.map_or_else(Interior::default, |own| (**own).clone());
                interior.take_finish_settings(finishes);
                self.written(interior)
            }
        }
    }

    fn get_mut(&mut self, id: InteriorId) -> &mut Interior {
        if !id.is_unnamed() {
            return &mut self.written[id.0 as usize];
        }
        let at = match self.changed.binary_search_by_key(&id.0, |(id, _)| id.0) {
            Ok(at) => at,
            Err(at) => {
                self.changed.insert(at, (id, Interior::default()));
                at
            }
        };
        &mut self.changed[at].1
    }

    /// Sets the media of a written interior.
    pub(super) fn fill(&mut self, id: InteriorId, media: Arc<[PreparedMedia]>) {
        let number = id.0 as usize;
        if self.media.len() <= number {
            self.media.resize_with(number + 1, Arc::default);
        }
        self.media[number] = media;
    }

    /// Copies the media of the interior from which another one is derived.
    pub(super) fn inherit_media(&mut self, from: Option<InteriorId>, to: InteriorId) {
        let known = from.and_then(|from| self.media.get(from.0 as usize));
        if let Some(media) = known.filter(|media| !media.is_empty() && from != Some(to)) {
            let media = Arc::clone(media);
            self.fill(to, media);
        }
    }

    /// The media of an interior.
    #[must_use]
    pub fn media(&self, id: InteriorId) -> &[PreparedMedia] {
        self.media.get(id.0 as usize).map_or(&[], |media| media)
    }

    /// The media of all interiors.
    pub(super) fn all_media(&self) -> impl Iterator<Item = &PreparedMedia> {
        self.media.iter().flat_map(|media| &**media)
    }

    /// Returns true if some interior has media.
    #[must_use]
    pub fn any_has_media(&self) -> bool {
        !self.media.is_empty()
    }

    /// Returns true if some of them attenuate light.
    #[must_use]
    pub fn any_attenuates(&self) -> bool {
        self.written.iter().any(Interior::fades)
    }

    /// Returns true if some of them have dispersion.
    #[must_use]
    pub fn any_disperses(&self) -> bool {
        let mut written = self.written.iter();
        written.any(|interior| interior.effective_dispersion() != 1.0)
    }

    /// Sets whether the object of an interior is hollow.
    pub(super) fn set_hollow(&mut self, id: InteriorId, is_hollow: bool) {
        let (kind, number) = Self::slot(id);
        let known = &mut self.hollow[kind];
        if known.len() <= number {
            if !is_hollow {
                return;
            }
            known.resize(number + 1, false);
        }
        known[number] = is_hollow;
    }

    /// Returns true if the atmosphere continues inside.
    #[must_use]
    pub fn is_hollow(&self, id: InteriorId) -> bool {
        let (kind, number) = Self::slot(id);
        self.hollow[kind].get(number).copied().unwrap_or(false)
    }

    fn slot(id: InteriorId) -> (usize, usize) {
        if id.0 < UNNAMED {
            (0, id.0 as usize)
        } else {
            (1, (id.0 - UNNAMED) as usize)
        }
    }

    /// The interior with this id.
    #[must_use]
    pub fn get(&self, id: InteriorId) -> &Interior {
        let written = self.written.get(id.0 as usize);
        written.unwrap_or_else(|| self.unwritten(id))
    }

    fn unwritten(&self, id: InteriorId) -> &Interior {
        let known = self.changed.binary_search_by_key(&id.0, |(id, _)| id.0);
        known.map_or(&self.default, |at| &self.changed[at].1)
    }
}
