//! The graph of a function body while it is parsed: equal operations are merged (hash consing).
//!
//! Nodes are created in an order in which they can be evaluated. The body of a loop and each part of a `select` form a
//! block of their own: its nodes are evaluated only there, and may use any earlier node of the enclosing blocks.

use super::number::{Component, Fold};
use super::operation::{Binary, Unary};
use super::{Function, Kind};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::sync::Arc;

/// Functions of at most this number of nodes are inlined, as long as the caller stays below [`LARGE`].
pub(super) const SMALL: usize = 40;
/// Callers of at least this number of nodes inline nothing.
const LARGE: usize = 2_000;

/// The index of a node in its graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Id(u32);

impl Id {
    pub(super) fn index(self) -> usize {
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
    /// Index in the list of `select`s.
    Select(u32),
    /// Index in the list of loops.
    Loop(u32),
}

/// Nodes that are evaluated together, in order.
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
    /// `None` if it is the block of zero.
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
    /// The blocks of the parts.
    pub(super) fn parts(&self) -> impl Iterator<Item = &Block> {
        [&self.negative, &self.zero]
            .into_iter()
            .chain(&self.positive)
    }
}

/// A function body.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    pub(super) nodes: Vec<Node>,
    pub(super) selects: Vec<Select>,
    pub(super) loops: Vec<Loop>,
    pub(super) callees: Vec<Arc<Function>>,
    /// The value of the body.
    pub(super) result: Option<Id>,
    /// The nodes of each open block, outermost first.
    open_blocks: Vec<Vec<Id>>,
    /// The nodes in scope by content, to merge equal ones.
    interned: FxHashMap<Node, Id>,
}

impl Graph {
    /// A body without any operation.
    #[must_use]
    pub fn new() -> Self {
        Graph {
            open_blocks: vec![Vec::new()],
            ..Graph::default()
        }
    }

    fn node(&mut self, node: Node) -> Id {
        if let Some(&existing) = self.interned.get(&node) {
            return existing;
        }
        let id = self.push(node.clone());
        self.interned.insert(node, id);
        id
    }

    fn push(&mut self, node: Node) -> Id {
        let id = Id(u32::try_from(self.nodes.len()).expect("tokens are fewer than 2^32"));
        self.nodes.push(node);
        if let Some(block) = self.open_blocks.last_mut() {
            block.push(id);
        }
        id
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> Id {
        self.node(Node::Constant(value.to_bits()))
    }

    /// The value of a constant node.
    #[must_use]
    pub fn constant_of(&self, id: Id) -> Option<f64> {
        match self.nodes[id.index()] {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// The parameter of this index.
    pub fn parameter(&mut self, index: u16) -> Id {
        self.node(Node::Parameter(index))
    }

    /// A function of one value.
    pub fn unary(&mut self, f: Unary, a: Id) -> Id {
        match self.constant_of(a) {
            Some(value) => self.constant(f.eval(value)),
            None => self.node(Node::Unary(f, a)),
        }
    }

    /// An operation of two values.
    pub fn binary(&mut self, f: Binary, a: Id, b: Id) -> Id {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(a), Some(b)) => self.constant(f.eval(a, b)),
            _ => self.node(Node::Binary(f, a, b)),
        }
    }

    /// A call of another function, or a component of its value. The caller has checked the number of arguments.
    pub fn call(&mut self, function: &Arc<Function>, arguments: &[Id], component: Component) -> Id {
        if let Kind::Program(program) = &function.kind
            && let Some(graph) = program.small_graph()
            && self.nodes.len() < LARGE
        {
            return self.inline(graph, arguments);
        }
        if let Kind::Ridged(calls) = &function.kind {
            let constant = |at: usize| arguments.get(at).and_then(|&id| self.constant_of(id));
            calls.note(
                constant(3)
                    .zip(constant(4))
                    .map(|(h, lacunarity)| [h, lacunarity]),
            );
        }
        let existing = self.callees.iter().position(|f| Arc::ptr_eq(f, function));
        let callee = existing.unwrap_or_else(|| {
            self.callees.push(Arc::clone(function));
            self.callees.len() - 1
        });
        self.node(Node::Call {
            callee: u32::try_from(callee).expect("tokens are fewer than 2^32"),
            component,
            arguments: arguments.into(),
        })
    }

    /// Opens a block: nodes created until [`Graph::close`] belong to it.
    pub fn open(&mut self) {
        self.open_blocks.push(Vec::new());
    }

    /// Closes the innermost block, whose value is `result`.
    pub fn close(&mut self, result: Id) -> Block {
        let nodes = self.open_blocks.pop().unwrap_or_default();
        for id in &nodes {
            // The node has no value outside of its block.
            self.interned.remove(&self.nodes[id.index()]);
        }
        Block { nodes, result }
    }

    /// `select(test, negative, zero, positive)`; without `positive`, `zero` also stands for positive tests.
    pub fn select(
        &mut self,
        test: Id,
        negative: Block,
        zero: Block,
        positive: Option<Block>,
    ) -> Id {
        let index = u32::try_from(self.selects.len()).expect("tokens are fewer than 2^32");
        self.selects.push(Select {
            test,
            negative,
            zero,
            positive,
        });
        self.push(Node::Select(index))
    }

    /// The variable of a loop, created before the block of its body.
    pub fn variable(&mut self) -> Id {
        self.push(Node::Variable)
    }

    /// The loop over a variable.
    pub fn repeat(&mut self, fold: Fold, variable: Id, range: (Id, Id), body: Block) -> Id {
        let index = u32::try_from(self.loops.len()).expect("tokens are fewer than 2^32");
        let (from, to) = range;
        self.loops.push(Loop {
            fold,
            variable,
            from,
            to,
            body,
        });
        self.push(Node::Loop(index))
    }

    /// The outermost block.
    pub(super) fn root(&self) -> &[Id] {
        self.open_blocks.first().map_or(&[], Vec::as_slice)
    }

    /// Copies a body in place of its call and returns its value.
    fn inline(&mut self, body: &Graph, arguments: &[Id]) -> Id {
        let mut inliner = Inliner {
            body,
            arguments,
            copies: vec![None; body.nodes.len()],
        };
        inliner.nodes(body.root(), self);
        let result = body.result.expect("a body has a result");
        inliner.copies[result.index()].expect("all of a body was copied")
    }

    /// Finishes the graph of a body whose value is `result`.
    #[must_use]
    pub fn finish(mut self, result: Id) -> Self {
        self.result = Some(result);
        self.interned = FxHashMap::default();
        self
    }
}

/// Copies the nodes of one graph into another, with arguments for its parameters.
struct Inliner<'a> {
    body: &'a Graph,
    arguments: &'a [Id],
    copies: Vec<Option<Id>>,
}

impl Inliner<'_> {
    fn nodes(&mut self, nodes: &[Id], into: &mut Graph) {
        for &id in nodes {
            let copy = self.node(id, into);
            self.copies[id.index()] = Some(copy);
        }
    }

    fn copy_of(&self, id: Id) -> Id {
        self.copies[id.index()].expect("operands are made before what uses them")
    }

    fn block(&mut self, block: &Block, into: &mut Graph) -> Block {
        into.open();
        self.nodes(&block.nodes, into);
        into.close(self.copy_of(block.result))
    }

    fn node(&mut self, id: Id, into: &mut Graph) -> Id {
        match &self.body.nodes[id.index()] {
            Node::Constant(bits) => into.constant(f64::from_bits(*bits)),
            Node::Parameter(index) => self.arguments[usize::from(*index)],
            Node::Variable => into.variable(),
            Node::Unary(f, a) => into.unary(*f, self.copy_of(*a)),
            Node::Binary(f, a, b) => into.binary(*f, self.copy_of(*a), self.copy_of(*b)),
            Node::Call {
                callee,
                component,
                arguments,
            } => {
                let arguments: Arguments = arguments.iter().map(|&a| self.copy_of(a)).collect();
                let function = &self.body.callees[*callee as usize];
                into.call(function, &arguments, *component)
            }
            Node::Select(index) => {
                let body = self.body;
                let select = &body.selects[*index as usize];
                let negative = self.block(&select.negative, into);
                let zero = self.block(&select.zero, into);
                let positive = select.positive.as_ref();
                let positive = positive.map(|positive| self.block(positive, into));
                into.select(self.copy_of(select.test), negative, zero, positive)
            }
            Node::Loop(index) => {
                let body = self.body;
                let loop_node = &body.loops[*index as usize];
                let variable = self.copy_of(loop_node.variable);
                let block = self.block(&loop_node.body, into);
                into.repeat(
                    loop_node.fold,
                    variable,
                    (self.copy_of(loop_node.from), self.copy_of(loop_node.to)),
                    block,
                )
            }
        }
    }
}
