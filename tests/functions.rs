//! User functions, internal functions and splines have POV-Ray's values: every line below runs through both programs,
//! which write it by `#debug`.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// Statements that run before every group.
const BEFORE: &str = "#version 3.7; global_settings { assumed_gamma 1 }\n";

/// Runs a scene that writes lines by `#debug` and returns those lines.
fn lines(program: &str, scene: &str, name: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("functions");
    std::fs::create_dir_all(&folder).expect("the folder for test files can be made");
    let file = folder.join(format!("{name}.pov"));
    std::fs::write(&file, scene).expect("test files can be written");
    let output = Command::new(program)
        .arg(format!("+I{}", file.display()))
        .args(["+W4", "+H4", "-D", "-F", "-A", "+WT1"])
        .output()
        .unwrap_or_else(|error| {
            panic!("{program} cannot be run ({error}); tools/test installs what is missing")
        });
    let text = String::from_utf8_lossy(&output.stderr);
    let written: Vec<String> = text
        .lines()
        .filter(|line| line.starts_with("= "))
        .map(|line| line.trim_end().to_owned())
        .collect();
    assert!(
        output.status.success(),
        "{program} failed on {name}:\n{text}"
    );
    written
}

/// The lines that both programs write for a scene.
fn both(name: &str, body: &str, count: usize) -> (Vec<String>, Vec<String>) {
    let scene = format!("{BEFORE}{body}\n");
    let expected = lines("povray", &scene, name);
    assert_eq!(expected.len(), count, "POV-Ray wrote {expected:#?}");
    (expected, lines(env!("CARGO_BIN_EXE_povr"), &scene, name))
}

/// Checks that both programs write the same lines for a scene.
fn same(name: &str, body: &str, count: usize) {
    let (expected, found) = both(name, body, count);
    assert_eq!(found, expected);
}

/// Functions of `x, y, z` with these bodies, in 17 digits at three points.
fn same_bodies(name: &str, before: &str, bodies: &[&str]) {
    let mut scene = before.to_owned();
    for (i, body) in bodies.iter().enumerate() {
        let _ = writeln!(scene, "#declare F{i} = function {{ {body} }}");
        for (k, point) in ["2, 3, 5", "0.7, 1.3, -2.9", "-1.5, 0, 0.25"]
            .iter()
            .enumerate()
        {
            let _ = writeln!(
                scene,
                "#debug concat(\"= {i}.{k} \", str(F{i}({point}), 0, 17), \"\\n\")"
            );
        }
    }
    same(name, &scene, 3 * bodies.len());
}

#[test]
fn operators_agree_to_the_last_bit() {
    same_bodies(
        "operators",
        "#declare A = 0.3; #declare L = array[2] { 4, 5.5 }",
        &[
            "x + y*z",
            "x - y - z",
            "x/y/z",
            "-x*y",
            "x*-y",
            "2*-3",
            "-pow(x, 2)",
            "x - y*z/x + z",
            "x < y",
            "x < y & y < z",
            "x | y & z",
            "1 | 0 & 0",
            "0 & 0 | 1",
            "x = 2",
            "x != 2",
            "x <= 2",
            "x >= 2",
            "x = 2 + 1e-15",
            "1e-17 & 1",
            "x < y < z",
            "3 > 2 > 1",
            "(x < y)",
            "1/0",
            "-1/0",
            "0/0",
            "x/(y - 3)",
            "x + A",
            "x/A",
            "L[1]*x",
            "u + 10*v",
            "\"name\" x",
            "+x",
            "((x))",
            "pi*x",
            "x + .1 + .2",
            "x*.1*3",
            "x/.3",
            "x/.3/.7",
            "1/3*x",
            "x*1/3",
        ],
    );
}

/// POV-Ray combines neighbouring numbers before it evaluates, by rules of its own.
#[test]
fn written_numbers_are_combined_as_pov_ray_combines_them() {
    same_bodies(
        "combined",
        "",
        &[
            "x - 3*5 - 2",
            "x + 3*5 - 2",
            "x - 3*5 + 2",
            "x - 2 - 3*5",
            "x - 3*5 - 2*7",
            "x - 3*5 - 2 - 1",
            "x - 1 - 3*5 - 2",
            "x*3*5 - 2",
            "x - 3/5 - 2",
            "x - (3*5) - 2",
            "x - 3*5 - y",
            "x*y - 3*5 - 2",
            "1 - 2*3 - 1",
            "1 - 2*3 - 1 + x",
            "x - 1 - 2*3 - x - 1 - 2",
            "x = 2 = 1",
            "x < 3 = 1",
            "x <= 2 <= 1",
            "x < 2*3 < 1",
            "x < 1 + 1 < 3",
            "1 < x = 2",
            "x - 1 + 1e-17",
            "x + 1e17 - 1e17",
            "x - pi*5 - 2",
            "2*x/(3)",
            "x/(3)",
            "x/-3",
            "x + -3 + .1",
        ],
    );
}

#[test]
fn functions_in_bodies_agree_to_the_last_bit() {
    same_bodies(
        "in_bodies",
        "#declare R = function(a, b) { sqrt(a*a + b*b) }
        #declare Big = function(a) { sum(i, 1, 30, sin(a*i)/i) + prod(k, 1, 5, a + k) + pow(abs(a), 1.3)
            - atan2(a, 2) + exp(-a*a) + cosh(a/3)*sinh(a/5) - tanh(a) + asinh(a) + ln(abs(a) + 1) }",
        &[
            "sin(x) + cos(y)*tan(z)", "asin(x/9) + acos(y/9) + atan(z)", "atan2(x, y)", "atan2(x - x, 0)",
            "sinh(x/9) + cosh(y/9) + tanh(z/9)", "asinh(x)", "acosh(abs(x) + 1)", "atanh(x/9)",
            "exp(x/9) + ln(abs(x)) + log(abs(x))", "sqrt(x)", "ln(x - 2)", "log(-abs(x))", "pow(x, y)",
            "pow(0, 0)", "pow(-1, .5)", "acos(x)", "abs(x) + floor(x) + ceil(x) + int(x)", "int(x*1e10)",
            "int(-1.7)", "ceil(-.5)", "div(x, .3)", "div(7, 0)", "mod(-7 - x, y)", "mod(5.5, -2)",
            "degrees(x) + radians(y)", "min(x, y, 1, z)", "max(x, y, 0.9)", "max(sqrt(-1), x)",
            "min(x, sqrt(-1))", "select(x, 1, 2, 3)", "select(x - 2, y, z)", "select(sqrt(-1), 1, 2, 3)",
            "sum(i, 1, 4, i*i)", "sum(i, .5, 3.2, i)", "sum(i, 4, 1, i)", "prod(i, 4, 1, i)",
            "sum(i, 1, abs(y), sum(k, 1, i, k*x))", "sum(x, 1, 2, x)", "sum(i, 1, i, i)",
            "sum(i, -2.5, 2.5, i*.1)", "sum(i, 1, 100, sin(i*.37)*x/i)",
            "sum(i, 1, 3, select(i - 2, x, y, z)*sum(j, i, 4, j*i + x))", "R(x, y) + R(y, x*R(z, 1))",
            "R(x < y, y > 2)", "Big(x) - Big(y)*Big(R(x, z))", "sum(i, 1, 3, Big(x + i))",
        ],
    );
}

#[test]
fn calls_stand_in_expressions_loops_and_macros() {
    same(
        "calls",
        "#declare A = array[2] { 3, 4 }
        #declare F = function(a, b) { a + 10*b + A[1] }
        #for (I, 0, 3) #debug concat(\"= \", str(F(I, 2*I) + 1, 0, 5), \"\\n\") #end
        #macro M(q) q*2 #end
        #declare G = function(x) { M(3) + x #for (K, 1, 3) + K*x #end #local Q = 7; - Q*x }
        #debug concat(\"= \", str(G(2), 0, 5), \" \", str(2*G(3)*2, 0, 5), \" \", str(-G(1), 0, 5), \"\\n\")
        #declare V = <F(1, 2), G(1) 0>;
        #debug concat(\"= \", vstr(3, V, \",\", 0, 3), \"\\n\")
        #macro Apply(H, w) H(w) + H(w + 1) #end
        #debug concat(\"= \", str(Apply(G, 3), 0, 5), \"\\n\")
        #if (F(1, 2) > 3 & G(1) < 100) #debug \"= yes\\n\" #end
        #declare C = 5;
        #declare K1 = function(q) { q*C }
        #declare C = 6;
        #debug concat(\"= \", str(K1(2), 0, 5), \" \", str(sin(K1(1)), 0, 9), \" \", str(F((1 < 2) 3), 0, 3), \"\\n\")
        #undef K1
        #declare K1 = function(z, y, x) { x - 10*y + 100*z + u }
        #debug concat(\"= \", str(K1(1, 2, 3), 0, 5), \"\\n\")
        #declare Twice = function(q, q) { q }
        #debug concat(\"= \", str(Twice(1, 2), 0, 5), \"\\n\")",
        11,
    );
}

#[test]
fn functions_of_patterns_pigments_and_transforms_agree() {
    let mut scene = "#declare G = function { pigment { rgbft <.1,.2,.3,.4,.5> } }
        #declare H = function(a) { G(a, a*2, 3).red + G(a, 1, 2).gray - G(1, 2, 3).transmit + G(a, 0, 0).t + G(a, a, a).u }
        #declare T = function { transform { scale 2 rotate <10, 20, 30> translate x } }
        #declare N = function(a) { T(a, 2, 3).x*T(3, a, 1).z - T(1, 1, a).v }
        #declare P = function { pattern { wood turbulence .3 scale .5 rotate 30*x sine_wave frequency 2 } }
        #declare B = function { pattern { bozo } }\n"
        .to_owned();
    for point in [".3, .2, .1", "-1.7, 2.25, .6", "12.34, -5.67, 8.9"] {
        let _ = write!(
            scene,
            "#debug concat(\"= \", vstr(5, G({point}), \",\", 0, 9), \"\\n\")
            #debug concat(\"= \", vstr(3, T({point}), \",\", 0, 12), \"\\n\")
            #debug concat(\"= \", str(P({point}), 0, 12), \" \", str(B({point}), 0, 12), \" \", str(T({point}).y, 0, 9), \"\\n\")
            #debug concat(\"= \", str(G({point}).gray, 0, 9), \" \", str(H(vlength(<{point}>)), 0, 9), \"\\n\")
            #debug concat(\"= \", str(N(vlength(<{point}>)), 0, 9), \"\\n\")\n"
        );
    }
    same("fields", &scene, 15);
}

/// The extra parameters of every internal function.
const INTERNAL: [(u16, &[f64]); 78] = [
    (0, &[1.3, 1.2, 1.0, 0.2, 25.0]),
    (1, &[1.3, 9.0, 1.0, 0.2, 25.0]),
    (2, &[0.7, 1.2, 0.0, 0.2, 25.0]),
    (3, &[1.3, 9.0, 1.0, -0.3, 25.0]),
    (4, &[0.9, 1.2]),
    (5, &[0.4, 1.7]),
    (6, &[1.1, 0.9, 0.8, 1.2, 1.1]),
    (7, &[0.8, 1.2, 1.5, 0.3]),
    (8, &[0.02, 1.3]),
    (9, &[1.4]),
    (10, &[0.4, 1.1, 1.2, 0.1]),
    (11, &[1.2]),
    (12, &[1.2]),
    (13, &[0.6]),
    (14, &[0.6]),
    (15, &[0.6, 0.8, 1.1, 1.0, 0.2, 30.0]),
    (16, &[0.1, 1.1, 0.4, 0.3, 0.2, 1.3]),
    (17, &[1.1, 0.7, 0.5]),
    (18, &[0.01]),
    (19, &[0.4, 1.1, 1.2, 0.1]),
    (20, &[0.6, 1.2, 0.7]),
    (21, &[0.6, 1.2, 0.7, 1.0, 0.2, 30.0]),
    (22, &[1.2]),
    (23, &[0.3]),
    (24, &[0.9, 3.0, 1.5, 0.3, 0.1, 0.4, 0.2, 2.0, 0.7, 0.6]),
    (25, &[2.0, 3.0, 0.2, 0.7, 1.2, 0.8, 20.0]),
    (26, &[2.0, 3.0, 0.2, 0.7, 1.2, 1.6, 20.0]),
    (27, &[1.0]),
    (28, &[1.0]),
    (29, &[0.8, 2.1, 4.3, 0.6, 1.0, 2.0]),
    (30, &[0.0001]),
    (31, &[0.4, 1.2, 0.3]),
    (32, &[0.4, 1.1, 1.2, 0.1]),
    (33, &[0.8, 1.1, 0.7]),
    (34, &[0.8, 1.1, 0.7, 1.0, 0.2, 30.0]),
    (35, &[0.02]),
    (36, &[0.8]),
    (37, &[0.8, -1.2, 0.7, 0.4]),
    (38, &[0.8]),
    (39, &[0.8, 1.1, 0.7, 1.0, 0.2, 30.0]),
    (40, &[0.4, 0.5, 1.2, 0.3, 1.1]),
    (41, &[0.4]),
    (42, &[0.4]),
    (43, &[0.4]),
    (44, &[0.4, 1.1, 0.3, 2.0]),
    (45, &[1.2]),
    (46, &[0.4, 1.1, 0.3]),
    (47, &[]),
    (48, &[0.4]),
    (49, &[0.4]),
    (50, &[0.4, 1.2, -0.7, 1.1, 1.0, 0.2, 30.0]),
    (51, &[0.5, 0.3, -0.2, 0.4, 0.1]),
    (52, &[5.0, 0.5, 0.3, -0.2, 0.4, 0.1]),
    (53, &[1.0]),
    (54, &[0.4]),
    (55, &[0.4]),
    (56, &[0.4, 1.1, 0.8]),
    (57, &[]),
    (58, &[2.1, 3.4, 0.6, 0.3, 0.5, 2.0]),
    (59, &[0.8, 2.1, 4.0, 0.9, 1.8, 2.0]),
    (60, &[0.2, 0.9, 0.8, 1.1]),
    (61, &[1.2]),
    (62, &[0.3, 0.9, 1.1, 1.4, 0.6]),
    (63, &[0.7, 5.0, 4.0, 0.6]),
    (64, &[0.4, 0.1, 1.3, 0.0, 0.0, 1.3]),
    (65, &[0.8]),
    (66, &[0.8, 0.7, 0.3, 1.1]),
    (67, &[0.8, 0.7, 0.3, 1.1, 1.0, 0.2, 30.0]),
    (68, &[0.4, 1.3]),
    (69, &[]),
    (70, &[0.9, 0.3]),
    (71, &[0.6, 0.9, 0.3]),
    (72, &[0.1]),
    (73, &[0.8]),
    (74, &[0.8, 0.3]),
    (75, &[0.8, 0.7, 0.3, 1.0, 0.2, 30.0]),
    (76, &[]),
    (78, &[3.0]),
];

/// In twelve digits, without the last one: long sums may be taken in another order.
#[test]
fn internal_functions_agree() {
    const POINTS: [&str; 6] = [
        "0.3, 0.2, 0.1",
        "-0.7, 0.55, 0.4",
        "0.9, -0.6, -1.1",
        "-1.2, -0.3, 0.05",
        "0, 0.8, 0",
        "1.4, 1.1, -0.2",
    ];
    let mut scene = String::new();
    for (number, parameters) in INTERNAL {
        let _ = writeln!(
            scene,
            "#declare F{number} = function {{ internal({number}) }}"
        );
        let extra: String = parameters.iter().map(|p| format!(", {p}")).collect();
        for point in POINTS {
            let _ = writeln!(
                scene,
                "#debug concat(\"= {number} \", str(F{number}({point}{extra}), 0, 12), \"\\n\")"
            );
        }
    }
    let (expected, found) = both("internal", &scene, POINTS.len() * INTERNAL.len());
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        let number = |line: &str| {
            let words: Vec<&str> = line.split(' ').collect();
            words[2].parse::<f64>().expect("a number was written")
        };
        let is_close =
            (number(found) - number(expected)).abs() < 3e-12 && found[..5] == expected[..5];
        assert!(is_close, "{found} instead of {expected}");
    }
}

#[test]
fn the_names_of_functions_inc_agree() {
    let names = [
        "f_agate",
        "f_boxed",
        "f_bozo",
        "f_brick",
        "f_bumps",
        "f_checker",
        "f_crackle",
        "f_cylindrical",
        "f_dents",
        "f_gradientX",
        "f_granite",
        "f_leopard",
        "f_marble",
        "f_mandel",
        "f_onion",
        "f_planar",
        "f_radial",
        "f_ripples",
        "f_spherical",
        "f_spiral1",
        "f_spiral2",
        "f_spotted",
        "f_waves",
        "f_wood",
        "f_wrinkles",
        "f_sine_wave",
        "f_scallop_wave",
        "f_snoise3d",
        "f_noise3d",
    ];
    let mut scene = "#include \"functions.inc\"\n".to_owned();
    for name in names {
        for point in [".3, .2, .1", "-1.7, 2.25, .6", "12.34, -5.67, 8.9"] {
            let _ = writeln!(
                scene,
                "#debug concat(\"= {name} \", str({name}({point}), 0, 12), \"\\n\")"
            );
        }
    }
    same("names", &scene, 3 * names.len());
}

#[test]
fn noise_is_that_of_the_scene() {
    same(
        "noise",
        "#include \"functions.inc\"
        global_settings { noise_generator 1 }
        #debug concat(\"= \", str(f_noise3d(.3, .2, .1), 0, 12), \"\\n\")
        #declare F = function { f_noise3d(2*x, y, z) }
        #debug concat(\"= \", str(F(.3, .2, .1), 0, 12), \"\\n\")",
        2,
    );
}

const KINDS: [&str; 5] = [
    "",
    "linear_spline",
    "quadratic_spline",
    "cubic_spline",
    "natural_spline",
];
const PARAMETERS: [&str; 14] = [
    "-1", "0", ".25", ".37", "1", "1.234", "2", "2.7", "3", "3.5", "4", "4.9", "5", "7",
];

fn spline_values(name: &str, declaration: &str) -> String {
    let mut scene = declaration.to_owned();
    for t in PARAMETERS {
        let _ = write!(
            scene,
            "\n#debug concat(\"= \", vstr(3, {name}({t}), \",\", 0, 12), \"\\n\")"
        );
    }
    scene + "\n"
}

#[test]
fn splines_of_every_kind_agree() {
    let all = [
        "0, <0,1,2>, 1, <3,-1,4>, 2, <1,5,9>, 3.5, <2,6,5>, 5, <3,5,8>",
        "2, <1,5,9>, 0, <0,1,2>, 5, <3,5,8>, 1, <3,-1,4>, 3.5, <2,6,5>",
        "1, <0,1,2>",
        "1, <0,1,2>, 3, <3,-1,4>",
        "0, <0,1,2>, 1, <3,-1,4>, 2, <1,5,9>",
        "0, <0,1,2>, 1, <3,-1,4>, 1, <1,5,9>, 2, <7,7,7>, 4, <1,1,1>",
        "0, <0,1,2>, 2, <3,-1,4>, 1, <1,5,9>, 1, <7,7,7>, 4, <1,1,1>, 0, <2,2,2>, 4, <5,5,5>",
        "0 <0,1> .5 4 1.5 <2,3,4> 2.25 <1,-1,1>",
    ];
    for (i, kind) in KINDS.iter().enumerate() {
        let mut scene = String::new();
        for (k, points) in all.iter().enumerate() {
            let declaration = format!("#declare S{k} = spline {{ {kind} {points} }}");
            scene += &spline_values(&format!("S{k}"), &declaration);
        }
        same(&format!("splines{i}"), &scene, all.len() * PARAMETERS.len());
    }
}

#[test]
fn splines_extend_each_other_and_change_their_kind() {
    let first = "#declare S = spline { linear_spline 0, <0,1,2>, 1, <3,-1,4>, 2, <1,5,9>, 3.5, <2,6,5>, 5, <3,5,8> }\n";
    let mut scene = spline_values("S", first);
    for declaration in [
        "S",
        "S 1.5, <9,9,9>",
        "S 1, <9,9,9>, 5, <0,0,0>",
        "S cubic_spline",
        "S quadratic_spline 7, <9,9,9>, -1, <1,1,1>",
    ] {
        scene += &spline_values("T", &format!("#declare T = spline {{ {declaration} }}"));
    }
    let mut count = 6 * PARAMETERS.len();
    for kind in &KINDS[1..] {
        for t in ["0.5", "1.7", "4.2"] {
            let _ = writeln!(
                scene,
                "#debug concat(\"= \", vstr(3, S({t}, {kind}), \",\", 0, 12), \"\\n\")"
            );
            count += 1;
        }
    }
    same("extended", &scene, count);
}

#[test]
fn splines_stand_in_expressions_functions_and_arrays() {
    same(
        "spline_uses",
        "#declare S = spline { natural_spline 0, <0,1,2>, 1, <3,-1,4>, 2, <1,5,9> }
        #declare One = spline { 0, 1, 1, 3 }
        #declare Five = spline { 0, <1,2,3,4,5>, 1, <3,4,5,6,8> }
        #declare F = function { spline { S } }
        #declare G = function(q) { F(q).y*2 + F(1).z }
        #declare A = array[1] { S }
        #declare T = S;
        #macro M(P) P(.5) #end
        #declare Z = 2*S(.3).x + 1;
        #declare V = S(.3)*2 + x;
        #debug concat(\"= \", vstr(2, One(.5), \",\", 0, 12), \" \", str(One(.5).y, 0, 3), \"\\n\")
        #debug concat(\"= \", vstr(5, Five(.5), \",\", 0, 9), \"\\n\")
        #debug concat(\"= \", vstr(3, F(.7), \",\", 0, 12), \" \", str(G(.7), 0, 12), \"\\n\")
        #debug concat(\"= \", vstr(3, A[0](.5), \",\", 0, 12), \"\\n\")
        #debug concat(\"= \", vstr(3, T(.5), \",\", 0, 12), \"\\n\")
        #debug concat(\"= \", vstr(3, M(S), \",\", 0, 12), \"\\n\")
        #debug concat(\"= \", str(Z, 0, 12), \" \", vstr(3, V, \",\", 0, 12), \"\\n\")",
        7,
    );
}
