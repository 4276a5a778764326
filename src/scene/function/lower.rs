//! Lowers the graph of a body to a program: dead code elimination and register allocation.
//!
//! The operations form one linear sequence: a loop or a `select` is followed by the operations of its blocks. A value
//! occupies its register from its definition to its last use in that sequence; values that a loop uses but does not
//! define stay live to the end of the loop.

use super::graph::{Block, Graph, Id, Node};
use super::operation::Binary;
use super::program::{Call, Loop, MAX_REGISTERS, Op, Program, Register, Select, TooLarge};

impl Program {
    /// Lowers a finished graph of a body with this number of parameters.
    ///
    /// # Errors
    /// If the body needs too many registers.
    pub fn new(graph: Graph, parameters: usize) -> Result<Self, TooLarge> {
        let mut program = lower(&graph, parameters)?;
        program.graph = (graph.nodes.len() <= super::graph::SMALL).then_some(graph);
        Ok(program)
    }
}

/// Lowers a finished graph of a body with this number of parameters.
pub(super) fn lower(graph: &Graph, parameters: usize) -> Result<Program, TooLarge> {
    let result = graph.result.expect("a finished graph has a result");
    let mut liveness = Liveness::new(graph);
    liveness.record_use_at_end(result);
    liveness.visit(graph.root());
    let mut lowering = Lowering {
        graph,
        liveness,
        position: 0,
        program: Program::empty(),
        registers: vec![None; graph.nodes.len()],
        free_registers: Vec::new(),
        parameters,
        next_register: parameters,
    };
    if parameters > MAX_REGISTERS {
        return Err(TooLarge);
    }
    for (id, node) in graph.nodes.iter().enumerate() {
        if let Node::Parameter(index) = node {
            lowering.registers[id] = Some(*index);
        }
    }
    lowering.block(graph.root())?;
    lowering.program.result = lowering.register_of(result);
    lowering.program.registers = lowering.next_register.max(1);
    Ok(lowering.program)
}

/// An operation with an immediate operand, a constant that needs no register.
enum ImmediateForm {
    AddTo(Id, f64),
    SubFrom(Id, f64),
    MulBy(Id, f64),
    DivInto(Id, f64),
}

fn immediate_form(graph: &Graph, node: &Node) -> Option<ImmediateForm> {
    let &Node::Binary(f, a, b) = node else {
        return None;
    };
    let (left, right) = (graph.constant_of(a), graph.constant_of(b));
    match (f, left, right) {
        (Binary::Add, _, Some(k)) => Some(ImmediateForm::AddTo(a, k)),
        (Binary::Add, Some(k), _) => Some(ImmediateForm::AddTo(b, k)),
        (Binary::Sub, _, Some(k)) => Some(ImmediateForm::AddTo(a, -k)),
        (Binary::Sub, Some(k), _) => Some(ImmediateForm::SubFrom(b, k)),
        (Binary::Mul, _, Some(k)) => Some(ImmediateForm::MulBy(a, k)),
        (Binary::Mul, Some(k), _) => Some(ImmediateForm::MulBy(b, k)),
        (Binary::Div, Some(k), _) => Some(ImmediateForm::DivInto(b, k)),
        _ => None,
    }
}

/// Calls `each` for the operands of a node, without those in its blocks.
fn operands(graph: &Graph, node: &Node, each: &mut dyn FnMut(Id)) {
    use ImmediateForm::{AddTo, DivInto, MulBy, SubFrom};
    if let Some(AddTo(a, _) | SubFrom(a, _) | MulBy(a, _) | DivInto(a, _)) =
        immediate_form(graph, node)
    {
        return each(a);
    }
    match node {
        Node::Constant(_) | Node::Parameter(_) | Node::Variable => {}
        Node::Unary(_, a) => each(*a),
        Node::Binary(_, a, b) => {
            each(*a);
            each(*b);
        }
        Node::Call { arguments, .. } => arguments.iter().for_each(|&a| each(a)),
        Node::Select(index) => each(graph.selects[*index as usize].test),
        Node::Loop(index) => {
            let loop_node = &graph.loops[*index as usize];
            each(loop_node.from);
            each(loop_node.to);
        }
    }
}

/// Live ranges: the positions at which each node is defined and last used. A loop has two positions, its start and its
/// end.
struct Liveness<'a> {
    graph: &'a Graph,
    is_used: Vec<bool>,
    defined: Vec<u32>,
    last_use: Vec<u32>,
    position: u32,
    /// For each enclosing loop, its start and the outer values it uses.
    enclosing_loops: Vec<(u32, Vec<Id>)>,
    /// For each loop of the graph, the outer values it uses.
    loop_inputs: Vec<Vec<Id>>,
}

impl<'a> Liveness<'a> {
    fn new(graph: &'a Graph) -> Self {
        let count = graph.nodes.len();
        let mut is_used = vec![false; count];
        let result = graph.result.expect("a finished graph has a result");
        is_used[result.index()] = true;
        // Operands precede their users, so one backward pass marks all of them.
        for (id, node) in graph.nodes.iter().enumerate().rev() {
            if !is_used[id] {
                continue;
            }
            operands(graph, node, &mut |a| is_used[a.index()] = true);
            match node {
                Node::Select(index) => {
                    for part in graph.selects[*index as usize].parts() {
                        is_used[part.result.index()] = true;
                    }
                }
                Node::Loop(index) => {
                    let loop_node = &graph.loops[*index as usize];
                    is_used[loop_node.body.result.index()] = true;
                    is_used[loop_node.variable.index()] = true;
                }
                _ => {}
            }
        }
        Liveness {
            graph,
            is_used,
            defined: vec![0; count],
            last_use: vec![0; count],
            position: 0,
            enclosing_loops: Vec::new(),
            loop_inputs: vec![Vec::new(); graph.loops.len()],
        }
    }

    fn record_use_at_end(&mut self, id: Id) {
        self.last_use[id.index()] = u32::MAX;
    }

    fn record_use(&mut self, id: Id) {
        let last = &mut self.last_use[id.index()];
        *last = (*last).max(self.position);
        if let Some((start, inputs)) = self.enclosing_loops.last_mut()
            && self.defined[id.index()] < *start
        {
            inputs.push(id);
        }
    }

    fn visit(&mut self, nodes: &[Id]) {
        for &id in nodes {
            if self.is_used[id.index()] {
                self.visit_node(id);
            }
        }
    }

    fn visit_node(&mut self, id: Id) {
        self.position += 1;
        let graph = self.graph;
        let node = &graph.nodes[id.index()];
        operands(graph, node, &mut |a| self.record_use(a));
        match node {
            Node::Select(index) => {
                for part in graph.selects[*index as usize].parts() {
                    self.visit(&part.nodes);
                    self.position += 1;
                    self.record_use(part.result);
                }
            }
            Node::Loop(index) => {
                let loop_node = &graph.loops[*index as usize];
                self.enclosing_loops.push((self.position, Vec::new()));
                self.visit(&loop_node.body.nodes);
                self.position += 1;
                self.record_use(loop_node.body.result);
                let (_, mut inputs) = self.enclosing_loops.pop().unwrap_or_default();
                inputs.push(loop_node.variable);
                inputs.iter().for_each(|&id| self.record_use(id));
                self.loop_inputs[*index as usize] = inputs;
            }
            _ => {}
        }
        // A parameter is defined from the start, wherever its node stands.
        if !matches!(node, Node::Parameter(_)) {
            self.defined[id.index()] = self.position;
        }
    }
}

struct Lowering<'a> {
    graph: &'a Graph,
    liveness: Liveness<'a>,
    position: u32,
    program: Program,
    registers: Vec<Option<Register>>,
    free_registers: Vec<Register>,
    /// The number of registers of parameters, which are never reused.
    parameters: usize,
    next_register: usize,
}

impl Lowering<'_> {
    fn block(&mut self, nodes: &[Id]) -> Result<(), TooLarge> {
        for &id in nodes {
            if self.liveness.is_used[id.index()] {
                self.node(id)?;
            }
        }
        Ok(())
    }

    fn register_of(&self, id: Id) -> Register {
        self.registers[id.index()].expect("operands are computed before what uses them")
    }

    fn allocate_register(&mut self, id: Id) -> Result<Register, TooLarge> {
        let register = match self.free_registers.pop() {
            Some(register) => register,
            None if self.next_register < MAX_REGISTERS => {
                self.next_register += 1;
                Register::try_from(self.next_register - 1).map_err(|_| TooLarge)?
            }
            None => return Err(TooLarge),
        };
        self.registers[id.index()] = Some(register);
        Ok(register)
    }

    /// Frees the registers of those of `ids` whose last use is the current position.
    fn release(&mut self, ids: &[Id]) {
        for id in ids {
            if self.liveness.last_use[id.index()] == self.position
                && let Some(register) = self.registers[id.index()]
                && usize::from(register) >= self.parameters
                && !self.free_registers.contains(&register)
            {
                self.free_registers.push(register);
            }
        }
    }

    fn node(&mut self, id: Id) -> Result<(), TooLarge> {
        self.position += 1;
        let graph = self.graph;
        let node = &graph.nodes[id.index()];
        let mut used = Vec::new();
        operands(graph, node, &mut |a| used.push(a));
        match node {
            Node::Parameter(_) => return Ok(()),
            Node::Variable => return self.allocate_register(id).map(|_| ()),
            Node::Select(index) => return self.select(id, *index, &used),
            Node::Loop(index) => return self.repeat(id, *index, &used),
            _ => {}
        }
        let call = u32::try_from(self.program.calls.len()).map_err(|_| TooLarge)?;
        if let Node::Call {
            callee,
            component,
            arguments,
        } = node
        {
            self.program.calls.push(Call {
                function: std::sync::Arc::clone(&graph.callees[*callee as usize]),
                component: *component,
                arguments: arguments.iter().map(|&a| self.register_of(a)).collect(),
            });
        }
        let of = |id: Id| self.register_of(id);
        let immediate = immediate_form(graph, node);
        let to = 0;
        let mut op = match (immediate, node) {
            (Some(ImmediateForm::AddTo(a, k)), _) => Op::AddTo { to, a: of(a), k },
            (Some(ImmediateForm::SubFrom(a, k)), _) => Op::SubFrom { to, a: of(a), k },
            (Some(ImmediateForm::MulBy(a, k)), _) => Op::MulBy { to, a: of(a), k },
            (Some(ImmediateForm::DivInto(a, k)), _) => Op::DivInto { to, a: of(a), k },
            (None, Node::Constant(bits)) => Op::Constant {
                to,
                k: f64::from_bits(*bits),
            },
            (None, Node::Unary(f, a)) => Op::Unary {
                to,
                a: of(*a),
                f: *f,
            },
            (None, Node::Binary(Binary::Mul, a, b)) if a == b => Op::Square { to, a: of(*a) },
            (None, Node::Binary(f, a, b)) => {
                let (a, b) = (of(*a), of(*b));
                match f {
                    Binary::Add => Op::Add { to, a, b },
                    Binary::Sub => Op::Sub { to, a, b },
                    Binary::Mul => Op::Mul { to, a, b },
                    Binary::Div => Op::Div { to, a, b },
                    _ => Op::Binary { to, a, b, f: *f },
                }
            }
            _ => Op::Call { to, index: call },
        };
        self.release(&used);
        *target(&mut op) = self.allocate_register(id)?;
        self.program.ops.push(op);
        Ok(())
    }

    fn select(&mut self, id: Id, graph_index: u32, used: &[Id]) -> Result<(), TooLarge> {
        let select = &self.graph.selects[graph_index as usize];
        let test = self.register_of(select.test);
        self.release(used);
        let site = self.program.ops.len();
        let index = u32::try_from(self.program.selects.len()).map_err(|_| TooLarge)?;
        self.program.selects.push(Select::default());
        self.program.ops.push(Op::Select { to: 0, test, index });
        for (i, part) in select.parts().enumerate() {
            let start = u32::try_from(self.program.ops.len()).map_err(|_| TooLarge)?;
            let (end, value) = self.part(part)?;
            let site = &mut self.program.selects[index as usize];
            // The last part present stands for the missing ones.
            site.parts[i..].fill((start, end, value));
            site.end = end;
        }
        *target(&mut self.program.ops[site]) = self.allocate_register(id)?;
        Ok(())
    }

    /// Lowers a block; returns its end and the register of its value.
    fn part(&mut self, block: &Block) -> Result<(u32, Register), TooLarge> {
        self.block(&block.nodes)?;
        self.position += 1;
        let value = self.register_of(block.result);
        self.release(&[block.result]);
        let end = u32::try_from(self.program.ops.len()).map_err(|_| TooLarge)?;
        Ok((end, value))
    }

    fn repeat(&mut self, id: Id, graph_index: u32, used: &[Id]) -> Result<(), TooLarge> {
        let loop_node = &self.graph.loops[graph_index as usize];
        let variable = self.register_of(loop_node.variable);
        let (from, last) = (
            self.register_of(loop_node.from),
            self.register_of(loop_node.to),
        );
        self.release(used);
        let site = self.program.ops.len();
        let index = u32::try_from(self.program.loops.len()).map_err(|_| TooLarge)?;
        self.program.ops.push(Op::Loop { to: 0, index });
        self.program.loops.push(Loop {
            fold: loop_node.fold,
            variable,
            from,
            to: last,
            end: 0,
            value: 0,
            iterations: self.iterations(loop_node.from, loop_node.to),
        });
        let (end, value) = self.part(&loop_node.body)?;
        self.program.loops[index as usize].end = end;
        self.program.loops[index as usize].value = value;
        // Outer values used by the body may be dead now.
        let inputs = std::mem::take(&mut self.liveness.loop_inputs[graph_index as usize]);
        self.release(&inputs);
        *target(&mut self.program.ops[site]) = self.allocate_register(id)?;
        Ok(())
    }

    fn iterations(&self, from: Id, to: Id) -> Option<u32> {
        let (from, to) = (self.graph.constant_of(from)?, self.graph.constant_of(to)?);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a float that does not fit goes to the nearest bound"
        )]
        let iterations = ((to - from).floor() + 1.0).max(0.0) as u32;
        Some(iterations)
    }
}

/// The destination register of an operation.
fn target(op: &mut Op) -> &mut Register {
    match op {
        Op::Constant { to, .. }
        | Op::Add { to, .. }
        | Op::Sub { to, .. }
        | Op::Mul { to, .. }
        | Op::Square { to, .. }
        | Op::Div { to, .. }
        | Op::AddTo { to, .. }
        | Op::SubFrom { to, .. }
        | Op::MulBy { to, .. }
        | Op::DivInto { to, .. }
        | Op::Unary { to, .. }
        | Op::Binary { to, .. }
        | Op::Call { to, .. }
        | Op::Select { to, .. }
        | Op::Loop { to, .. } => to,
    }
}
