//! From the graph of a body to its program: leaves out what nothing uses, and gives registers.
//!
//! The operations stand in one line, those of a loop or of the parts of a `select` behind it. A value keeps its register
//! from where it is computed to its last use in that line; what a loop uses and does not compute it keeps to the
//! loop's end.

use super::graph::{Block, Graph, Id, Node};
use super::operation::Binary;
use super::program::{Call, Loop, MOST_REGISTERS, Op, Program, Register, Select, TooLarge};

/// The program of a finished graph.
pub(super) fn lower(graph: &Graph, parameters: usize) -> Result<Program, TooLarge> {
    let result = graph.result.expect("a finished graph has a result");
    let mut lines = Lines::new(graph);
    lines.use_at_the_end(result);
    lines.number(graph.root());
    let mut lowering = Lowering {
        graph,
        lines,
        now: 0,
        program: Program::empty(),
        registers: vec![None; graph.nodes.len()],
        free: Vec::new(),
        parameters,
        next: parameters,
    };
    if parameters > MOST_REGISTERS {
        return Err(TooLarge);
    }
    for (id, node) in graph.nodes.iter().enumerate() {
        if let Node::Parameter(place) = node {
            lowering.registers[id] = Some(*place);
        }
    }
    lowering.block(graph.root())?;
    lowering.program.result = lowering.register_of(result);
    lowering.program.registers = lowering.next.max(1);
    Ok(lowering.program)
}

/// How a node works with a constant operand, which then needs no register.
enum WithConstant {
    AddTo(Id, f64),
    SubFrom(Id, f64),
    MulBy(Id, f64),
    DivInto(Id, f64),
}

fn with_constant(graph: &Graph, node: &Node) -> Option<WithConstant> {
    let &Node::Binary(f, a, b) = node else {
        return None;
    };
    let (left, right) = (graph.constant_of(a), graph.constant_of(b));
    match (f, left, right) {
        (Binary::Add, _, Some(k)) => Some(WithConstant::AddTo(a, k)),
        (Binary::Add, Some(k), _) => Some(WithConstant::AddTo(b, k)),
        (Binary::Sub, _, Some(k)) => Some(WithConstant::AddTo(a, -k)),
        (Binary::Sub, Some(k), _) => Some(WithConstant::SubFrom(b, k)),
        (Binary::Mul, _, Some(k)) => Some(WithConstant::MulBy(a, k)),
        (Binary::Mul, Some(k), _) => Some(WithConstant::MulBy(b, k)),
        (Binary::Div, Some(k), _) => Some(WithConstant::DivInto(b, k)),
        _ => None,
    }
}

/// The nodes that a node reads, but for those in its blocks.
fn operands(graph: &Graph, node: &Node, each: &mut dyn FnMut(Id)) {
    use WithConstant::{AddTo, DivInto, MulBy, SubFrom};
    if let Some(AddTo(a, _) | SubFrom(a, _) | MulBy(a, _) | DivInto(a, _)) =
        with_constant(graph, node)
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
        Node::Select(place) => each(graph.selects[*place as usize].test),
        Node::Loop(place) => {
            let run = &graph.loops[*place as usize];
            each(run.from);
            each(run.to);
        }
    }
}

/// Where in the line each node is computed and last used. A loop takes two places: its start and its end.
struct Lines<'a> {
    graph: &'a Graph,
    is_used: Vec<bool>,
    made: Vec<u32>,
    last_use: Vec<u32>,
    now: u32,
    /// For each loop around: where it starts, and what it uses from outside.
    loops: Vec<(u32, Vec<Id>)>,
    /// For each loop of the graph: what it uses from outside.
    kept: Vec<Vec<Id>>,
}

impl<'a> Lines<'a> {
    fn new(graph: &'a Graph) -> Self {
        let count = graph.nodes.len();
        let mut is_used = vec![false; count];
        let result = graph.result.expect("a finished graph has a result");
        is_used[result.at()] = true;
        // Operands are made before what uses them, so one pass from the end finds all.
        for (id, node) in graph.nodes.iter().enumerate().rev() {
            if !is_used[id] {
                continue;
            }
            operands(graph, node, &mut |a| is_used[a.at()] = true);
            match node {
                Node::Select(place) => {
                    for part in graph.selects[*place as usize].parts() {
                        is_used[part.result.at()] = true;
                    }
                }
                Node::Loop(place) => {
                    let run = &graph.loops[*place as usize];
                    is_used[run.body.result.at()] = true;
                    is_used[run.variable.at()] = true;
                }
                _ => {}
            }
        }
        Lines {
            graph,
            is_used,
            made: vec![0; count],
            last_use: vec![0; count],
            now: 0,
            loops: Vec::new(),
            kept: vec![Vec::new(); graph.loops.len()],
        }
    }

    fn use_at_the_end(&mut self, id: Id) {
        self.last_use[id.at()] = u32::MAX;
    }

    fn use_now(&mut self, id: Id) {
        let last = &mut self.last_use[id.at()];
        *last = (*last).max(self.now);
        if let Some((start, outer)) = self.loops.last_mut()
            && self.made[id.at()] < *start
        {
            outer.push(id);
        }
    }

    fn number(&mut self, nodes: &[Id]) {
        for &id in nodes {
            if self.is_used[id.at()] {
                self.number_node(id);
            }
        }
    }

    fn number_node(&mut self, id: Id) {
        self.now += 1;
        let graph = self.graph;
        let node = &graph.nodes[id.at()];
        operands(graph, node, &mut |a| self.use_now(a));
        match node {
            Node::Select(place) => {
                for part in graph.selects[*place as usize].parts() {
                    self.number(&part.nodes);
                    self.now += 1;
                    self.use_now(part.result);
                }
            }
            Node::Loop(place) => {
                let run = &graph.loops[*place as usize];
                self.loops.push((self.now, Vec::new()));
                self.number(&run.body.nodes);
                self.now += 1;
                self.use_now(run.body.result);
                let (_, mut outer) = self.loops.pop().unwrap_or_default();
                outer.push(run.variable);
                outer.iter().for_each(|&id| self.use_now(id));
                self.kept[*place as usize] = outer;
            }
            _ => {}
        }
        // A parameter is there from the start, wherever it is first used.
        if !matches!(node, Node::Parameter(_)) {
            self.made[id.at()] = self.now;
        }
    }
}

struct Lowering<'a> {
    graph: &'a Graph,
    lines: Lines<'a>,
    now: u32,
    program: Program,
    registers: Vec<Option<Register>>,
    free: Vec<Register>,
    /// The registers of the parameters, which are kept.
    parameters: usize,
    next: usize,
}

impl Lowering<'_> {
    fn block(&mut self, nodes: &[Id]) -> Result<(), TooLarge> {
        for &id in nodes {
            if self.lines.is_used[id.at()] {
                self.node(id)?;
            }
        }
        Ok(())
    }

    fn register_of(&self, id: Id) -> Register {
        self.registers[id.at()].expect("operands are computed before what uses them")
    }

    fn take_register(&mut self, id: Id) -> Result<Register, TooLarge> {
        let register = match self.free.pop() {
            Some(register) => register,
            None if self.next < MOST_REGISTERS => {
                self.next += 1;
                Register::try_from(self.next - 1).map_err(|_| TooLarge)?
            }
            None => return Err(TooLarge),
        };
        self.registers[id.at()] = Some(register);
        Ok(register)
    }

    /// Gives back the registers of those of `ids` that nothing uses from here on.
    fn release(&mut self, ids: &[Id]) {
        for id in ids {
            if self.lines.last_use[id.at()] == self.now
                && let Some(register) = self.registers[id.at()]
                && usize::from(register) >= self.parameters
                && !self.free.contains(&register)
            {
                self.free.push(register);
            }
        }
    }

    fn node(&mut self, id: Id) -> Result<(), TooLarge> {
        self.now += 1;
        let graph = self.graph;
        let node = &graph.nodes[id.at()];
        let mut used = Vec::new();
        operands(graph, node, &mut |a| used.push(a));
        match node {
            Node::Parameter(_) => return Ok(()),
            Node::Variable => return self.take_register(id).map(|_| ()),
            Node::Select(place) => return self.select(id, *place, &used),
            Node::Loop(place) => return self.repeat(id, *place, &used),
            _ => {}
        }
        let place = u32::try_from(self.program.calls.len()).map_err(|_| TooLarge)?;
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
        let with = with_constant(graph, node);
        let to = 0;
        let mut op = match (with, node) {
            (Some(WithConstant::AddTo(a, k)), _) => Op::AddTo { to, a: of(a), k },
            (Some(WithConstant::SubFrom(a, k)), _) => Op::SubFrom { to, a: of(a), k },
            (Some(WithConstant::MulBy(a, k)), _) => Op::MulBy { to, a: of(a), k },
            (Some(WithConstant::DivInto(a, k)), _) => Op::DivInto { to, a: of(a), k },
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
            _ => Op::Call { to, at: place },
        };
        self.release(&used);
        *target(&mut op) = self.take_register(id)?;
        self.program.ops.push(op);
        Ok(())
    }

    fn select(&mut self, id: Id, place: u32, used: &[Id]) -> Result<(), TooLarge> {
        let select = &self.graph.selects[place as usize];
        let test = self.register_of(select.test);
        self.release(used);
        let site = self.program.ops.len();
        let at = u32::try_from(self.program.selects.len()).map_err(|_| TooLarge)?;
        self.program.selects.push(Select::default());
        self.program.ops.push(Op::Select { to: 0, test, at });
        for (i, part) in select.parts().enumerate() {
            let start = u32::try_from(self.program.ops.len()).map_err(|_| TooLarge)?;
            let (end, value) = self.part(part)?;
            let site = &mut self.program.selects[at as usize];
            // The last part given stands for those that are not.
            site.parts[i..].fill((start, end, value));
            site.end = end;
        }
        *target(&mut self.program.ops[site]) = self.take_register(id)?;
        Ok(())
    }

    /// A block and where it ends, with the register of its value.
    fn part(&mut self, block: &Block) -> Result<(u32, Register), TooLarge> {
        self.block(&block.nodes)?;
        self.now += 1;
        let value = self.register_of(block.result);
        self.release(&[block.result]);
        let end = u32::try_from(self.program.ops.len()).map_err(|_| TooLarge)?;
        Ok((end, value))
    }

    fn repeat(&mut self, id: Id, place: u32, used: &[Id]) -> Result<(), TooLarge> {
        let run = &self.graph.loops[place as usize];
        let variable = self.register_of(run.variable);
        let (from, last) = (self.register_of(run.from), self.register_of(run.to));
        self.release(used);
        let site = self.program.ops.len();
        let at = u32::try_from(self.program.loops.len()).map_err(|_| TooLarge)?;
        self.program.ops.push(Op::Loop { to: 0, at });
        self.program.loops.push(Loop {
            fold: run.fold,
            variable,
            from,
            to: last,
            end: 0,
            value: 0,
            rounds: self.rounds(run.from, run.to),
        });
        let (end, value) = self.part(&run.body)?;
        self.program.loops[at as usize].end = end;
        self.program.loops[at as usize].value = value;
        // What the body uses from before the loop may be free now.
        let kept = std::mem::take(&mut self.lines.kept[place as usize]);
        self.release(&kept);
        *target(&mut self.program.ops[site]) = self.take_register(id)?;
        Ok(())
    }

    fn rounds(&self, from: Id, to: Id) -> Option<u32> {
        let (from, to) = (self.graph.constant_of(from)?, self.graph.constant_of(to)?);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a float that does not fit goes to the nearest bound"
        )]
        let rounds = ((to - from).floor() + 1.0).max(0.0) as u32;
        Some(rounds)
    }
}

/// Where an operation writes.
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
