//! The state of lowering: what it has gathered of the world so far.

use super::csg::PendingGate;
use super::parts::inherited::Inherited;
use super::parts::model::ModelBuilder;
use super::parts::slots::{SharedModel, SlotTable};
use super::parts::targets::Targets;
use crate::base::math::Bounds;
use crate::scene::Object;
use crate::scene::pattern::Settings;
use crate::scene::texture::{PreparedTexture, Texture};
use crate::world::csg::coincidence::Widening;
use crate::world::csg::memo::CsgMemo;
use crate::world::interiors::Interiors;
use crate::world::lights::Lights;
use crate::world::surface::Surface;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

/// State and results of lowering.
#[derive(Debug, Default)]
pub(crate) struct Lowering {
    /// The parts of the current model: the world, or a shared union.
    pub(crate) parts: ModelBuilder,
    /// The material slots of the current model, unless it is the world.
    pub(crate) slots: Option<SlotTable>,
    /// The shared models, by the address of their list of children, and by whether they may need texture coordinates.
    pub(crate) shared: FxHashMap<(usize, bool), Box<SharedModel>>,
    /// For each list of children, by its address, the number of copies when the first was lowered.
    pub(crate) copies: FxHashMap<usize, usize>,
    /// True if the current model is one for copies that may need texture coordinates.
    pub(crate) keeps_uv: bool,
    /// True if the insides of objects are needed, which may be larger than their surfaces.
    pub(crate) needs_insides: bool,
    /// True if hits are wanted with POV-Ray's rounding.
    pub(crate) rounds: bool,
    /// The rule by which surfaces coincide in CSG.
    pub(crate) widening: Widening,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) interiors: Interiors,
    /// Scene-wide settings for patterns.
    pub(crate) settings: Settings,
    pub(crate) lights: Lights,
    /// Photon targets, if photons are on.
    pub(crate) targets: Option<Targets>,
    /// Prepared textures by address; the entry owns the texture, so that the address stays taken.
    pub(crate) prepared: FxHashMap<usize, (Arc<Texture>, Arc<PreparedTexture>)>,
    /// The entries added by the current top-level object.
    pub(crate) lately_prepared: Vec<usize>,
    pub(crate) first_surface: usize,
    /// The default texture of objects.
    pub(crate) plain: Option<Arc<PreparedTexture>>,
    pub(crate) last_surface: Option<u32>,
    /// A surface index and the attributes it was made from.
    pub(crate) last_attributes: Option<(u32, Inherited)>,
    /// Memo of the last CSG preparation.
    pub(crate) memo: Option<Box<CsgMemo>>,
    /// Bounding objects of the current CSG program.
    pub(crate) gates: Vec<PendingGate>,
    /// Parts of it with boxes of their own: their operands, and boxes around their insides and visible surfaces.
    pub(crate) boxed: Vec<(Range<u32>, Bounds)>,
    /// Bounds of the operands of the current CSG program.
    pub(crate) operand_bounds: Vec<Bounds>,
    /// The operands of the CSG programs being built, in the order of POV-Ray's lists of hits: those of a child are
    /// reversed in the list of its parent, unless that is a union that is not clipped. Of programs within one another the
    /// inner one is last.
    pub(crate) hit_order: Vec<u32>,
    /// The index of the first item of each top-level object, if they are noted.
    pub(crate) first_items: Option<Vec<u32>>,
    /// Objects that the lights of the current object refer to.
    pub(crate) held: Vec<(Holds, Arc<Object>, Inherited)>,
}

/// Use of an object by a light.
#[derive(Debug)]
pub(crate) enum Holds {
    /// `looks_like`.
    Look,
    /// `projected_through`, with the index of the light.
    Projector(u32),
}
