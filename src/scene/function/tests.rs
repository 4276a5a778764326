//! Programs compute the values of their bodies, regardless of folding, merging, inlining and register allocation.

use super::*;
use crate::base::math::sampling::random::Random;

/// A formula as a tree, evaluated without a program.
enum Tree {
    Constant(f64),
    Parameter(usize),
    Variable(usize),
    Unary(Unary, Box<Tree>),
    Binary(Binary, Box<Tree>, Box<Tree>),
    Select(Box<[Tree; 3]>, Option<Box<Tree>>),
    Loop(Fold, Box<[Tree; 3]>),
    Call(usize, Vec<Tree>),
}

struct Callee {
    tree: Tree,
    function: Arc<Function>,
}

impl Tree {
    fn value(&self, parameters: &[f64], variables: &mut Vec<f64>, callees: &[Callee]) -> f64 {
        match self {
            Tree::Constant(value) => *value,
            Tree::Parameter(index) => parameters[*index],
            Tree::Variable(index) => variables[*index],
            Tree::Unary(f, a) => f.eval(a.value(parameters, variables, callees)),
            Tree::Binary(f, a, b) => {
                let a = a.value(parameters, variables, callees);
                f.eval(a, b.value(parameters, variables, callees))
            }
            Tree::Select(parts, positive) => {
                let test = parts[0].value(parameters, variables, callees);
                let part = match positive {
                    _ if test < 0.0 => &parts[1],
                    Some(positive) if test != 0.0 => positive,
                    _ => &parts[2],
                };
                part.value(parameters, variables, callees)
            }
            Tree::Loop(fold, parts) => {
                let mut at = parts[0].value(parameters, variables, callees);
                let last = parts[1].value(parameters, variables, callees);
                let mut result = f64::from(u8::from(*fold == Fold::Product));
                while at <= last {
                    variables.push(at);
                    let value = parts[2].value(parameters, variables, callees);
                    variables.pop();
                    match fold {
                        Fold::Sum => result += value,
                        Fold::Product => result *= value,
                    }
                    at += 1.0;
                }
                result
            }
            Tree::Call(index, arguments) => {
                let arguments: Vec<f64> = arguments
                    .iter()
                    .map(|a| a.value(parameters, variables, callees))
                    .collect();
                let callee = &callees[*index];
                callee
                    .tree
                    .value(&arguments, &mut Vec::new(), &callees[..*index])
            }
        }
    }

    fn build(&self, graph: &mut Graph, variables: &mut Vec<Id>, callees: &[Callee]) -> Id {
        match self {
            Tree::Constant(value) => graph.constant(*value),
            Tree::Parameter(index) => graph.parameter(u16::try_from(*index).expect("few")),
            Tree::Variable(index) => variables[*index],
            Tree::Unary(f, a) => {
                let a = a.build(graph, variables, callees);
                graph.unary(*f, a)
            }
            Tree::Binary(f, a, b) => {
                let a = a.build(graph, variables, callees);
                let b = b.build(graph, variables, callees);
                graph.binary(*f, a, b)
            }
            Tree::Select(parts, positive) => {
                let test = parts[0].build(graph, variables, callees);
                let mut block = |part: &Tree| {
                    graph.open();
                    let result = part.build(graph, variables, callees);
                    graph.close(result)
                };
                let (negative, zero) = (block(&parts[1]), block(&parts[2]));
                let positive = positive.as_ref().map(|part| block(part));
                graph.select(test, negative, zero, positive)
            }
            Tree::Loop(fold, parts) => {
                let from = parts[0].build(graph, variables, callees);
                let to = parts[1].build(graph, variables, callees);
                let variable = graph.variable();
                variables.push(variable);
                graph.open();
                let value = parts[2].build(graph, variables, callees);
                let body = graph.close(value);
                variables.pop();
                graph.repeat(*fold, variable, (from, to), body)
            }
            Tree::Call(index, arguments) => {
                let arguments: Vec<Id> = arguments
                    .iter()
                    .map(|a| a.build(graph, variables, callees))
                    .collect();
                graph.call(&callees[*index].function, &arguments, Component::At(0))
            }
        }
    }
}

fn function(tree: &Tree, parameters: usize, callees: &[Callee]) -> Function {
    let mut graph = Graph::new();
    let result = tree.build(&mut graph, &mut Vec::new(), callees);
    Function::formula(graph.finish(result), parameters).expect("small functions are accepted")
}

const UNARY: [Unary; 5] = [
    Unary::Negative,
    Unary::Abs,
    Unary::Floor,
    Unary::Sin,
    Unary::Sqrt,
];
const BINARY: [Binary; 8] = [
    Binary::Add,
    Binary::Sub,
    Binary::Mul,
    Binary::Div,
    Binary::Less,
    Binary::And,
    Binary::Min,
    Binary::Atan2,
];

fn pick(random: &mut Random, count: usize) -> usize {
    usize::try_from(random.bits() % count as u64).expect("it is below a usize")
}

/// A random tree that may use `variables` loop variables and call the first `callees` functions, of two parameters.
fn tree(random: &mut Random, depth: usize, variables: usize, callees: usize) -> Tree {
    let kind = pick(random, if depth == 0 { 3 } else { 10 });
    match kind {
        0 => Tree::Constant([0.0, 1.0, -2.5, 0.1, 3.0][pick(random, 5)]),
        1 => Tree::Parameter(pick(random, 2)),
        2 if variables > 0 => Tree::Variable(pick(random, variables)),
        2 => Tree::Parameter(0),
        3 => {
            let f = UNARY[pick(random, UNARY.len())];
            Tree::Unary(f, Box::new(tree(random, depth - 1, variables, callees)))
        }
        4 => {
            let mut part = || tree(random, depth - 1, variables, callees);
            let parts = Box::new([part(), part(), part()]);
            let positive = (pick(random, 2) == 0)
                .then(|| Box::new(tree(random, depth - 1, variables, callees)));
            Tree::Select(parts, positive)
        }
        5 if variables < 2 => {
            let fold = [Fold::Sum, Fold::Product][pick(random, 2)];
            let last = Tree::Constant([3.0, 0.0, 4.5][pick(random, 3)]);
            let from = tree(random, 0, variables, callees);
            // A loop from a far lower bound would run long.
            let from = Tree::Binary(Binary::Max, Box::new(Tree::Constant(-2.0)), Box::new(from));
            let body = tree(random, depth - 1, variables + 1, callees);
            Tree::Loop(fold, Box::new([from, last, body]))
        }
        6 if callees > 0 => {
            let index = pick(random, callees);
            let arguments = (0..2)
                .map(|_| tree(random, depth - 1, variables, callees))
                .collect();
            Tree::Call(index, arguments)
        }
        _ => {
            let f = BINARY[pick(random, BINARY.len())];
            let a = tree(random, depth - 1, variables, callees);
            let b = tree(random, depth - 1, variables, callees);
            Tree::Binary(f, Box::new(a), Box::new(b))
        }
    }
}

#[test]
fn programs_compute_the_values_of_their_trees() {
    let mut random = Random::new(20);
    for _ in 0..300 {
        let mut callees: Vec<Callee> = Vec::new();
        // Some of these are small enough to be inlined, others are not.
        for depth in [2, 4, 6] {
            let tree = tree(&mut random, depth, 0, callees.len());
            let function = Arc::new(function(&tree, 2, &callees));
            for arguments in [[0.0, 1.0], [0.7, -1.3], [-2.0, 5.5]] {
                let expected = tree.value(&arguments, &mut Vec::new(), &callees);
                let actual = function.eval(&arguments);
                let is_same = actual.to_bits() == expected.to_bits()
                    || actual == expected
                    || actual.is_nan() && expected.is_nan();
                assert!(is_same, "{actual} instead of {expected}: {function:?}");
            }
            callees.push(Callee { tree, function });
        }
    }
}

#[test]
fn bounds_contain_all_values() {
    let mut random = Random::new(21);
    for _ in 0..300 {
        let mut callees: Vec<Callee> = Vec::new();
        for depth in [2, 4, 5] {
            let tree = tree(&mut random, depth, 0, callees.len());
            let function = Arc::new(function(&tree, 2, &callees));
            let (low, size) = (random.vector(3.0), random.vector(1.5));
            let domain = [0, 1].map(|i| Interval::new(low[i], low[i] + size[i].abs()));
            let bounds = function.bounds(&domain);
            for _ in 0..20 {
                let at = domain.map(|side| {
                    (side.low + random.uniform() * (side.high - side.low))
                        .clamp(side.low, side.high)
                });
                let value = function.eval(&at);
                let is_bounded = value.is_nan() || bounds.contains(value);
                assert!(
                    is_bounded,
                    "{value} outside of {bounds:?} at {at:?}: {function:?}"
                );
            }
            callees.push(Callee { tree, function });
        }
    }
}

#[test]
fn bounds_are_tight() {
    let x = Interval::new(0.5, 1.5);
    let assert_close = |bounds: Interval, low: f64, high: f64| {
        let is_close = (bounds.low - low).abs() < 1e-12 && (bounds.high - high).abs() < 1e-12;
        assert!(is_close, "{bounds:?} instead of {low} to {high}");
    };
    assert_close(x + x, 1.0, 3.0);
    assert_close(x - x, -1.0, 1.0);
    assert_close(x * x, 0.25, 2.25);
    assert_close(x / x, 1.0 / 3.0, 3.0);
    assert_close(x.unary(Unary::Sin), 0.5f64.sin(), 1.5f64.sin());
    assert_close(Interval::new(1.0, 2.0).unary(Unary::Sin), 1f64.sin(), 1.0);
    assert_close(Interval::new(3.0, 4.0).unary(Unary::Cos), -1.0, 4f64.cos());
    assert_close(Interval::new(-1.0, 2.0).unary(Unary::Abs), 0.0, 2.0);
    let two = Interval::constant(2.0);
    assert_close(Interval::new(-1.0, 2.0).binary(Binary::Pow, two), 0.0, 4.0);
    assert_close(x.binary(Binary::Less, two), 1.0, 1.0);
    assert_close(x.binary(Binary::Less, Interval::constant(1.0)), 0.0, 1.0);
}

#[test]
fn equal_operations_are_computed_once() {
    let mut graph = Graph::new();
    let x = graph.parameter(0);
    let (a, b) = (graph.unary(Unary::Sin, x), graph.unary(Unary::Sin, x));
    assert_eq!(a, b);
    let sum = graph.binary(Binary::Add, a, b);
    let program = Program::new(graph.finish(sum), 1).expect("it is small");
    assert_eq!(program.cost(), 2);
}

#[test]
fn dead_operations_are_removed() {
    let mut graph = Graph::new();
    let x = graph.parameter(0);
    graph.unary(Unary::Sin, x);
    let two = graph.constant(2.0);
    let product = graph.binary(Binary::Mul, x, two);
    let program = Program::new(graph.finish(product), 1).expect("it is small");
    assert_eq!(program.cost(), 1);
    assert_eq!(program.run(&[4.0]), 8.0);
}

#[test]
fn functions_that_run_for_years_are_refused() {
    let mut last: Option<Arc<Function>> = None;
    for depth in 0..80 {
        let mut graph = Graph::new();
        let x = graph.parameter(0);
        // Too large to be inlined, and calls the function of the previous depth twice.
        let mut sum = x;
        for i in 0..50 {
            let k = graph.constant(f64::from(i) + 0.5);
            let term = graph.binary(Binary::Pow, x, k);
            sum = graph.binary(Binary::Add, sum, term);
        }
        if let Some(below) = &last {
            let moved = graph.unary(Unary::Sin, x);
            for argument in [x, moved] {
                let value = graph.call(below, &[argument], Component::At(0));
                sum = graph.binary(Binary::Add, sum, value);
            }
        }
        match Function::formula(graph.finish(sum), 1) {
            Ok(function) => last = Some(Arc::new(function)),
            Err(refusal) => {
                assert_eq!(refusal, Refusal::TooLong);
                assert!(depth > 10);
                return;
            }
        }
    }
    panic!("80 functions that call each other twice were accepted");
}

#[test]
fn bodies_that_need_too_many_registers_are_refused() {
    let mut graph = Graph::new();
    let x = graph.parameter(0);
    let values: Vec<Id> = (0..3000)
        .map(|i| {
            let k = graph.constant(f64::from(i));
            graph.binary(Binary::Pow, x, k)
        })
        .collect();
    let sum = values
        .into_iter()
        .rev()
        .reduce(|sum, value| graph.binary(Binary::Atan2, sum, value));
    let graph = graph.finish(sum.expect("there are values"));
    assert_eq!(Function::formula(graph, 1).unwrap_err(), Refusal::TooLarge);
}
