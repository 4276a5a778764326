//! The body of a function while it is read: a graph of operations in which equal ones are one.
//!
//! Nodes are made in the order in which they can be computed. A loop and each part of a `select` have a block of their
//! own: what is made inside is computed there only, and may use everything made before outside.

use super::number::{Component, Fold};
use super::operation::{Binary, Unary};
use super::{Function, Kind};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::sync::Arc;

/// Functions of no more nodes than this are put in place of their calls, as long as the caller stays below
/// [`LARGE`].
pub(super) const SMALL: usize = 40;
/// Callers of this size call all others.
const LARGE: usize = 2_000;

/// A node of the graph being built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Id(u32);

impl Id {
    pub(super) fn at(self) -> usize {
        self.0 as usize
    }
}

/// The arguments of a call.
pub(super) type Arguments = SmallVec<[Id; 4]>;

/// One operation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Node {
    /// The bits of a number.
    Constant(u64),
    Parameter(u16),
    /// The variable of a loop.
    Variable,
    Unary(Unary, Id),
    Binary(Binary, Id, Id),
    Call {
        callee: u32,
        component: Component,
        arguments: Arguments,
    },
    /// By its place in the list of `select`s.
    Select(u32),
    /// By its place in the list of loops.
    Loop(u32),
}

/// Nodes that are computed together, in their order.
#[derive(Clone, Debug)]
pub struct Block {
    pub(super) nodes: Vec<Id>,
    pub(super) result: Id,
}

#[derive(Clone, Debug)]
pub(super) struct Select {
    pub(super) test: Id,
    pub(super) negative: Block,
    pub(super) zero: Block,
    /// `None` if it is that of zero.
    pub(super) positive: Option<Block>,
}

#[derive(Clone, Debug)]
pub(super) struct Loop {
    pub(super) fold: Fold,
    pub(super) variable: Id,
    pub(super) from: Id,
    pub(super) to: Id,
    pub(super) body: Block,
}

impl Select {
    /// The parts that are computed each by itself.
    pub(super) fn parts(&self) -> impl Iterator<Item = &Block> {
        [&self.negative, &self.zero]
            .into_iter()
            .chain(&self.positive)
    }
}

/// A body with all that it refers to.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    pub(super) nodes: Vec<Node>,
    pub(super) selects: Vec<Select>,
    pub(super) loops: Vec<Loop>,
    pub(super) callees: Vec<Arc<Function>>,
    /// What the body gives.
    pub(super) result: Option<Id>,
    /// The blocks being built, outermost first, and in each what was made.
    open: Vec<Vec<Id>>,
    known: FxHashMap<Node, Id>,
}

impl Graph {
    /// A body without any operation.
    #[must_use]
    pub fn new() -> Self {
        Graph {
            open: vec![Vec::new()],
            ..Graph::default()
        }
    }

    fn node(&mut self, node: Node) -> Id {
        if let Some(&known) = self.known.get(&node) {
            return known;
        }
        let id = self.push(node.clone());
        self.known.insert(node, id);
        id
    }

    fn push(&mut self, node: Node) -> Id {
        let id = Id(u32::try_from(self.nodes.len()).expect("tokens are fewer than 2^32"));
        self.nodes.push(node);
        if let Some(block) = self.open.last_mut() {
            block.push(id);
        }
        id
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> Id {
        self.node(Node::Constant(value.to_bits()))
    }

    /// The number that a node is, if it is one.
    #[must_use]
    pub fn constant_of(&self, id: Id) -> Option<f64> {
        match self.nodes[id.at()] {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// A parameter of the function by its place.
    pub fn parameter(&mut self, place: u16) -> Id {
        self.node(Node::Parameter(place))
    }

    /// A function of one value.
    pub fn unary(&mut self, f: Unary, a: Id) -> Id {
        match self.constant_of(a) {
            Some(value) => self.constant(f.of_f64(value)),
            None => self.node(Node::Unary(f, a)),
        }
    }

    /// An operation of two values.
    pub fn binary(&mut self, f: Binary, a: Id, b: Id) -> Id {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(a), Some(b)) => self.constant(f.of_f64(a, b)),
            _ => self.node(Node::Binary(f, a, b)),
        }
    }

    /// What another function gives, or a component of it. The number of arguments is right.
    pub fn call(&mut self, function: &Arc<Function>, arguments: &[Id], component: Component) -> Id {
        if let Kind::Program(program) = &function.kind
            && let Some(graph) = program.small_graph()
            && self.nodes.len() < LARGE
        {
            return self.inlined(graph, arguments);
        }
        let known = self.callees.iter().position(|f| Arc::ptr_eq(f, function));
        let callee = known.unwrap_or_else(|| {
            self.callees.push(Arc::clone(function));
            self.callees.len() - 1
        });
        self.node(Node::Call {
            callee: u32::try_from(callee).expect("tokens are fewer than 2^32"),
            component,
            arguments: arguments.into(),
        })
    }

    /// Opens a block: what is made until [`Graph::close`] belongs to it.
    pub fn open(&mut self) {
        self.open.push(Vec::new());
    }

    /// Closes the innermost block, which gives `result`.
    pub fn close(&mut self, result: Id) -> Block {
        let nodes = self.open.pop().unwrap_or_default();
        for id in &nodes {
            // Outside, its value is not there.
            self.known.remove(&self.nodes[id.at()]);
        }
        Block { nodes, result }
    }

    /// `select(test, negative, zero, positive)`; without `positive` that of zero stands for both.
    pub fn select(
        &mut self,
        test: Id,
        negative: Block,
        zero: Block,
        positive: Option<Block>,
    ) -> Id {
        let place = u32::try_from(self.selects.len()).expect("tokens are fewer than 2^32");
        self.selects.push(Select {
            test,
            negative,
            zero,
            positive,
        });
        self.push(Node::Select(place))
    }

    /// The variable of a loop that is about to be built.
    pub fn variable(&mut self) -> Id {
        self.push(Node::Variable)
    }

    /// The loop of a variable.
    pub fn repeat(&mut self, fold: Fold, variable: Id, range: (Id, Id), body: Block) -> Id {
        let place = u32::try_from(self.loops.len()).expect("tokens are fewer than 2^32");
        let (from, to) = range;
        self.loops.push(Loop {
            fold,
            variable,
            from,
            to,
            body,
        });
        self.push(Node::Loop(place))
    }

    /// The outermost block.
    pub(super) fn root(&self) -> &[Id] {
        self.open.first().map_or(&[], Vec::as_slice)
    }

    /// The result of the body in place of its call; the root block ends with it.
    fn inlined(&mut self, body: &Graph, arguments: &[Id]) -> Id {
        let mut copy = Copying {
            body,
            arguments,
            made: vec![None; body.nodes.len()],
        };
        copy.nodes(body.root(), self);
        let result = body.result.expect("a body has a result");
        copy.made[result.at()].expect("all of a body was copied")
    }

    /// Ends the building: `result` is what the body gives.
    #[must_use]
    pub fn finish(mut self, result: Id) -> Self {
        self.result = Some(result);
        self.known = FxHashMap::default();
        self
    }
}

/// Copies the nodes of one graph into another.
struct Copying<'a> {
    body: &'a Graph,
    arguments: &'a [Id],
    made: Vec<Option<Id>>,
}

impl Copying<'_> {
    fn nodes(&mut self, nodes: &[Id], into: &mut Graph) {
        for &id in nodes {
            let copy = self.node(id, into);
            self.made[id.at()] = Some(copy);
        }
    }

    fn of(&self, id: Id) -> Id {
        self.made[id.at()].expect("operands are made before what uses them")
    }

    fn block(&mut self, block: &Block, into: &mut Graph) -> Block {
        into.open();
        self.nodes(&block.nodes, into);
        into.close(self.of(block.result))
    }

    fn node(&mut self, id: Id, into: &mut Graph) -> Id {
        match &self.body.nodes[id.at()] {
            Node::Constant(bits) => into.constant(f64::from_bits(*bits)),
            Node::Parameter(place) => self.arguments[usize::from(*place)],
            Node::Variable => into.variable(),
            Node::Unary(f, a) => into.unary(*f, self.of(*a)),
            Node::Binary(f, a, b) => into.binary(*f, self.of(*a), self.of(*b)),
            Node::Call {
                callee,
                component,
                arguments,
            } => {
                let arguments: Arguments = arguments.iter().map(|&a| self.of(a)).collect();
                let function = &self.body.callees[*callee as usize];
                into.call(function, &arguments, *component)
            }
            Node::Select(place) => {
                let body = self.body;
                let select = &body.selects[*place as usize];
                let negative = self.block(&select.negative, into);
                let zero = self.block(&select.zero, into);
                let positive = select.positive.as_ref();
                let positive = positive.map(|positive| self.block(positive, into));
                into.select(self.of(select.test), negative, zero, positive)
            }
            Node::Loop(place) => {
                let body = self.body;
                let run = &body.loops[*place as usize];
                let variable = self.of(run.variable);
                let block = self.block(&run.body, into);
                into.repeat(
                    run.fold,
                    variable,
                    (self.of(run.from), self.of(run.to)),
                    block,
                )
            }
        }
    }
}
