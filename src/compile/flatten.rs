//! From the objects of a scene to leaves, combinations and lights: transforms folded, unions taken apart, texture and
//! interior handed down to the children that have none of their own.

use super::csg::{Combine, Gate, NONE, Node, Operand, Program};
use super::interiors::{InteriorId, Interiors};
use super::leaf::{Extent, Leaf};
use super::lights::{LightList, Lights};
use super::surface::{Flags, Surface};
use crate::light::Light;
use crate::math::{Bounds, Step, Transform};
use crate::pattern::Settings;
use crate::scene::{Attached, Kind, Object, Operation};
use crate::shape::{Geometry, Skin};
use crate::texture::{Layer, PreparedTexture, Texture};
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

/// What the tree of the world holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Item {
    /// A shape by itself.
    Leaf(u32),
    /// A combination.
    Program(u32),
}

/// Everything the objects of a scene come to.
#[derive(Debug, Default)]
pub(super) struct Flat {
    pub(super) leaves: Vec<Leaf>,
    pub(super) programs: Vec<Program>,
    pub(super) items: Vec<Item>,
    /// The bounds of the items.
    pub(super) bounds: Vec<Bounds>,
    pub(super) surfaces: Vec<Surface>,
    pub(super) interiors: Interiors,
    /// What patterns take from the whole scene.
    settings: Settings,
    pub(super) lights: Lights,
    /// By address, which stays taken as long as the texture is kept.
    prepared: FxHashMap<usize, (Arc<Texture>, Arc<PreparedTexture>)>,
    /// What objects without a texture look like.
    plain: Option<Arc<PreparedTexture>>,
    last_surface: Option<u32>,
    /// Bounding objects of the combination being built, with the operands they bound and where they stand.
    gates: Vec<(Range<u32>, Arc<Object>, Heritage)>,
    /// Bounds of the operands of the combination being built.
    operand_bounds: Vec<Bounds>,
    /// What the lights of the object being taken in hold.
    held: Vec<(Holds, Arc<Object>, Heritage)>,
}

/// Why a light holds an object.
#[derive(Debug)]
enum Holds {
    /// To look like it.
    Look,
    /// To be projected through it: the light of this number.
    Projector(u32),
}

/// What an object hands down to its children.
#[derive(Clone, Debug)]
struct Heritage {
    texture: Option<Placed>,
    inside_texture: Option<Placed>,
    interior: Option<InteriorId>,
    flags: Flags,
    /// The lights that shine on it.
    lights: LightList,
    /// Whether lights outside of the light group around it do so; `None` outside of all groups.
    global_lights: Option<bool>,
    /// The list of the light group that it is, which takes in its own lights.
    group: Option<LightList>,
    /// The transforms of everything above, innermost first.
    steps: Arc<[Step]>,
}

/// A texture with the transforms that came after it.
#[derive(Clone, Debug)]
struct Placed {
    texture: Arc<Texture>,
    steps: Arc<[Step]>,
}

impl Flat {
    /// Nothing yet; `settings` are what patterns take from the whole scene.
    pub(super) fn new(settings: Settings) -> Self {
        Flat {
            settings,
            ..Flat::default()
        }
    }

    /// Takes in one object of the scene's top level.
    pub(super) fn add(&mut self, object: &Object) {
        let nothing = Heritage {
            texture: None,
            inside_texture: None,
            interior: None,
            flags: Flags::default(),
            lights: LightList::default(),
            global_lights: None,
            group: None,
            steps: Arc::from([]),
        };
        self.add_below(object, &nothing);
        while let Some((holds, object, around)) = self.held.pop() {
            match holds {
                Holds::Look => self.add_below(&object, &around),
                Holds::Projector(light) => {
                    let (program, _) = self.program(&object, &around);
                    self.lights.project(light, program);
                }
            }
        }
    }

    fn add_below(&mut self, object: &Object, above: &Heritage) {
        let below = self.heritage(object, above);
        let is_plain = object.clipped_by.is_empty() && !is_gated(object);
        match &object.kind {
            Kind::Light { .. } => self.add_light(&object.kind, above, below),
            Kind::Csg {
                operation: Operation::Union,
                children,
            } if is_plain && !object.is_inverse => {
                for child in children {
                    self.add_below(child, &below);
                }
            }
            Kind::Shape(shape) if is_plain && !object.is_inverse => {
                let surface = self.surface(&below, shape.skins());
                let (leaf, bounds) =
                    Leaf::new((**shape).clone(), &below.steps, surface, Extent::Surface);
                if !bounds.is_empty() {
                    self.push_item(Item::Leaf(index(self.leaves.len())), bounds);
                    self.leaves.push(leaf);
                }
            }
            _ => self.add_program(object, above),
        }
    }

    /// Takes in a light; what it holds waits until the object around it is complete.
    fn add_light(&mut self, light: &Kind, above: &Heritage, below: Heritage) {
        let Kind::Light {
            light,
            looks_like,
            projected_through,
        } = light
        else {
            return;
        };
        let light = self.lights.add(placed(light, &below.steps), above.group);
        if let Some(object) = projected_through {
            let holds = Holds::Projector(light);
            self.held.push((holds, Arc::clone(object), below.clone()));
        }
        if let Some(object) = looks_like {
            self.held.push((Holds::Look, Arc::clone(object), below));
        }
    }

    fn push_item(&mut self, item: Item, bounds: Bounds) {
        self.items.push(item);
        self.bounds.push(bounds);
    }

    fn add_program(&mut self, object: &Object, above: &Heritage) {
        let (program, bounds) = self.program(object, above);
        if bounds.is_empty() {
            self.leaves.truncate(program.first as usize);
            return;
        }
        self.push_item(Item::Program(index(self.programs.len())), bounds);
        self.programs.push(program);
    }

    fn program(&mut self, object: &Object, above: &Heritage) -> (Program, Bounds) {
        let root = Node {
            combine: Combine::Union,
            is_inverse: false,
            children: 0,
            parent: NONE,
        };
        let mut program = Program {
            nodes: vec![root],
            first: index(self.leaves.len()),
            ..Program::default()
        };
        let outer_bounds = std::mem::take(&mut self.operand_bounds);
        let outer_gates = std::mem::take(&mut self.gates);
        let bounds = self.add_node(object, above, &mut program, 0, false);
        let of_operands = std::mem::replace(&mut self.operand_bounds, outer_bounds);
        program.prepare(&self.leaves, &of_operands);
        for (operands, object, around) in std::mem::replace(&mut self.gates, outer_gates) {
            let (bound, _) = self.program(&object, &around);
            program.gates.push(Gate { operands, bound });
        }
        (program, bounds)
    }

    /// Adds an object under a node and gives the bounds of what it shows.
    fn add_node(
        &mut self,
        object: &Object,
        above: &Heritage,
        program: &mut Program,
        parent: u32,
        is_hidden: bool,
    ) -> Bounds {
        let below = self.heritage(object, above);
        let first = index(program.operands.len());
        let bounds = self.add_clipped(object, above, &below, program, (parent, is_hidden));
        if is_gated(object) {
            let operands = first..index(program.operands.len());
            for bound in &object.bounded_by {
                let around = Heritage {
                    steps: joined(&object.steps[bound.after..], &above.steps),
                    ..below.clone()
                };
                self.gates
                    .push((operands.clone(), Arc::clone(&bound.what), around));
            }
        }
        bounds
    }

    /// The same without what bounds the object. `place` is the node above and whether the object only clips.
    fn add_clipped(
        &mut self,
        object: &Object,
        above: &Heritage,
        below: &Heritage,
        program: &mut Program,
        (parent, is_hidden): (u32, bool),
    ) -> Bounds {
        if object.clipped_by.is_empty() {
            return self.add_bare(
                object,
                below,
                program,
                (parent, object.is_inverse),
                is_hidden,
            );
        }
        let node = push_node(program, Combine::Intersection, false, parent);
        let mut bounds =
            self.add_bare(object, below, program, (node, object.is_inverse), is_hidden);
        for clip in &object.clipped_by {
            let around = Heritage {
                steps: joined(&object.steps[clip.after..], &above.steps),
                ..below.clone()
            };
            let held = self.add_node(&clip.what, &around, program, node, true);
            bounds = bounds.intersection(&held);
        }
        bounds
    }

    /// The same without what clips the object. `place` is the node above and whether the object is inverted.
    fn add_bare(
        &mut self,
        object: &Object,
        below: &Heritage,
        program: &mut Program,
        place: (u32, bool),
        is_hidden: bool,
    ) -> Bounds {
        let (parent, is_inverse) = place;
        match &object.kind {
            Kind::Light { .. } => {
                let outside = Heritage {
                    group: None,
                    ..below.clone()
                };
                self.add_light(&object.kind, &outside, below.clone());
                Bounds::EMPTY
            }
            Kind::Shape(shape) => {
                let surface = self.surface(below, shape.skins());
                let (leaf, bounds) =
                    Leaf::new((**shape).clone(), &below.steps, surface, Extent::Solid);
                self.leaves.push(leaf);
                self.operand_bounds.push(bounds);
                program.nodes[parent as usize].children += 1;
                program.operands.push(Operand {
                    parent,
                    is_inverse,
                    is_hidden,
                });
                if is_inverse {
                    Bounds::EVERYTHING
                } else {
                    bounds
                }
            }
            Kind::Csg {
                operation,
                children,
            } => {
                let combine = match operation {
                    // The inverse of a union is the intersection of inverses: inner surfaces do not show.
                    Operation::Union if is_inverse => Combine::Merge,
                    Operation::Union => Combine::Union,
                    Operation::Merge => Combine::Merge,
                    Operation::Intersection | Operation::Difference => Combine::Intersection,
                };
                let node = push_node(program, combine, is_inverse, parent);
                let bounds =
                    self.add_children(*operation, children, below, program, (node, is_hidden));
                if is_inverse {
                    Bounds::EVERYTHING
                } else {
                    bounds
                }
            }
        }
    }

    fn add_children(
        &mut self,
        operation: Operation,
        children: &[Arc<Object>],
        below: &Heritage,
        program: &mut Program,
        (node, is_hidden): (u32, bool),
    ) -> Bounds {
        let is_sum = matches!(operation, Operation::Union | Operation::Merge);
        let mut sum = if is_sum {
            Bounds::EMPTY
        } else {
            Bounds::EVERYTHING
        };
        for (at, child) in children.iter().enumerate() {
            let child = if operation == Operation::Difference && at > 0 {
                let mut cut = (**child).clone();
                cut.is_inverse = !cut.is_inverse;
                self.add_cut(&cut, below, program, node, is_hidden)
            } else {
                self.add_node(child, below, program, node, is_hidden)
            };
            sum = if is_sum {
                sum.union(&child)
            } else {
                sum.intersection(&child)
            };
        }
        sum
    }

    /// What a difference takes away: its inverse as a whole, clips included.
    fn add_cut(
        &mut self,
        cut: &Object,
        above: &Heritage,
        program: &mut Program,
        node: u32,
        is_hidden: bool,
    ) -> Bounds {
        if cut.clipped_by.is_empty() {
            return self.add_node(cut, above, program, node, is_hidden);
        }
        let mut inner = cut.clone();
        inner.is_inverse = !inner.is_inverse;
        let outer = push_node(program, Combine::Union, true, node);
        self.add_node(&inner, above, program, outer, is_hidden);
        Bounds::EVERYTHING
    }

    /// What an object's children, or the object itself if it is a shape, look like and where they stand.
    fn heritage(&mut self, object: &Object, above: &Heritage) -> Heritage {
        let place = |own: &Option<Attached<Arc<Texture>>>, inherited: &Option<Placed>| match own {
            Some(own) => Some(Placed {
                texture: Arc::clone(&own.what),
                steps: joined(&object.steps[own.after..], &above.steps),
            }),
            None => inherited.clone(),
        };
        let layers = object
            .texture
            .as_ref()
            .map_or(&[][..], |own| own.what.layers());
        let finishes = layers.iter().map(|layer| &*layer.finish);
        let interior = self
            .interiors
            .of_object(object.interior.as_ref(), above.interior, finishes);
        let own = &object.flags;
        let is_hollow = own.hollow.unwrap_or(above.flags.hollow);
        self.interiors.set_hollow(interior, is_hollow);
        let global_lights = object.light_group.map_or(above.global_lights, |group| {
            Some(above.global_lights.unwrap_or(group.global_lights))
        });
        let group = object
            .light_group
            .map(|_| self.lights.group(global_lights.unwrap_or(true)));
        Heritage {
            lights: group.unwrap_or(above.lights),
            global_lights,
            group,
            texture: place(&object.texture, &above.texture),
            inside_texture: place(&object.interior_texture, &above.inside_texture),
            interior: Some(interior),
            flags: Flags {
                no_shadow: own.no_shadow || above.flags.no_shadow,
                no_image: own.no_image || above.flags.no_image,
                no_reflection: own.no_reflection || above.flags.no_reflection,
                hollow: is_hollow,
                double_illuminate: own.double_illuminate || above.flags.double_illuminate,
            },
            steps: joined(&object.steps, &above.steps),
        }
    }

    /// The number of a surface with these looks. Neighbours in the file often share theirs.
    fn surface(&mut self, looks: &Heritage, skins: &[Skin]) -> u32 {
        let texture = match &looks.texture {
            Some(placed) => self.prepare(placed),
            None => {
                let fresh = || Texture::from(Layer::default()).prepare(&[], &self.settings);
                let plain = self.plain.get_or_insert_with(|| Arc::new(fresh()));
                Arc::clone(plain)
            }
        };
        let inside_texture = looks
            .inside_texture
            .as_ref()
            .map(|placed| self.prepare(placed));
        let skin = |skin: &Skin| {
            self.prepare(&Placed {
                texture: Arc::clone(&skin.0),
                steps: Arc::clone(&looks.steps),
            })
        };
        let skins = skins.iter().map(skin).collect();
        let interior = looks.interior.unwrap_or(InteriorId::AIR);
        let lit = (looks.lights, looks.flags);
        let surface = Surface::new(texture, inside_texture, skins, interior, lit);
        if let Some(last) = self
            .last_surface
            .filter(|&last| self.surfaces[last as usize].is_same(&surface))
        {
            return last;
        }
        let number = index(self.surfaces.len());
        self.surfaces.push(surface);
        self.last_surface = Some(number);
        number
    }

    /// A texture ready for points of the world. One without patterns is prepared once, wherever it is used.
    fn prepare(&mut self, placed: &Placed) -> Arc<PreparedTexture> {
        if !placed.texture.depends_on_place() {
            let fresh = || Arc::new(placed.texture.prepare(&[], &self.settings));
            // The object has it and hands it down; whoever shares it makes more.
            if Arc::strong_count(&placed.texture) <= 2 {
                return fresh();
            }
            let key = Arc::as_ptr(&placed.texture).addr();
            let kept = || (Arc::clone(&placed.texture), fresh());
            return Arc::clone(&self.prepared.entry(key).or_insert_with(kept).1);
        }
        Arc::new(placed.texture.prepare(&placed.steps, &self.settings))
    }
}

/// A light where the steps move it.
fn placed(light: &Light, steps: &[Step]) -> Light {
    let mut light = light.clone();
    steps.iter().for_each(|step| light.transform(step));
    light
}

/// Whether `bounded_by` decides anything: POV-Ray drops it from finite primitives, which have bounds of their own.
fn is_gated(object: &Object) -> bool {
    let needs_none = matches!(&object.kind, Kind::Shape(shape) if shape.bounds().is_finite());
    !object.bounded_by.is_empty() && !needs_none
}

fn push_node(program: &mut Program, combine: Combine, is_inverse: bool, parent: u32) -> u32 {
    let node = index(program.nodes.len());
    program.nodes[parent as usize].children += 1;
    program.nodes.push(Node {
        combine,
        is_inverse,
        children: 0,
        parent,
    });
    node
}

/// With more steps above than this they are made one, so that objects in objects in objects do not each keep the steps
/// of all around them. No scene written by hand comes near.
const KEPT_STEPS: usize = 250;

/// The steps of an object, then those of everything above it.
fn joined(own: &[Step], above: &Arc<[Step]>) -> Arc<[Step]> {
    if own.is_empty() {
        return Arc::clone(above);
    }
    if above.len() > KEPT_STEPS {
        let one = Step::General(Arc::new(Transform::from_steps(above)));
        return own.iter().cloned().chain([one]).collect();
    }
    own.iter().chain(above.iter()).cloned().collect()
}

fn index(len: usize) -> u32 {
    u32::try_from(len).expect("the number of objects is limited below 2^32")
}
