//! Boxes within which objects are seen. POV-Ray asks an object only about rays that meet its box, and that box is not always
//! one around all that shows: the inside of a height field goes on below its box without end, that of a disc behind it,
//! and what they clip or are cut with has their box.
//!
//! Measured with POV-Ray 3.7: a ray that meets the box somewhere sees all on it, what lies outside of the box too. Parts of
//! a combination have no boxes of their own. Those of a union that is taken apart have, unless the union as a whole was
//! moved: then shapes have their own boxes again, whatever clips them, and combinations keep theirs.

use super::extent::is_limited;
use super::{Kind, Object};

impl Object {
    /// Notes the box within which it is seen, as it is now that all is said of it.
    pub(crate) fn find_boxes(&mut self) {
        if !self.size().reaches_out {
            return;
        }
        let is_union = self.plain_union().is_some();
        let is_bare = self.around().next().is_none() && matches!(self.kind, Kind::Shape(_));
        let seen_in = (!is_union && !is_bare).then(|| self.extent());
        let moves_parts = is_union && !self.steps.is_empty();
        self.note_boxes(seen_in.filter(is_limited), moves_parts);
    }
}
