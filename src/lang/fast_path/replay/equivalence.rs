//! Reading with and without replays gives the same scene, the same text and the same findings.

use crate::base::options::ReadOptions;
use crate::base::source::Sources;
use crate::lang::{Reading, evaluate, evaluate_token_by_token};

/// All results of a reading, as text.
fn summary(reading: &Reading) -> String {
    let Reading {
        scene,
        findings,
        messages,
        undrawn,
        ..
    } = reading;
    let objects = scene.iter().flat_map(|scene| scene.objects.iter());
    let first: Vec<_> = objects.clone().take(300).collect();
    let count = objects.count();
    format!("{messages}\n{findings:#?}\n{undrawn:?}\n{count}\n{first:?}")
}

fn agree(text: &str) -> Reading {
    let mut options = ReadOptions::default();
    options.max_repeated_tokens = options.max_repeated_tokens.min(20_000_000);
    let read = |read: fn(_, &mut Sources, &ReadOptions) -> Reading| {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("test.pov", format!("#version 3.7;\n{text}"));
        read(file, &mut sources, &options)
    };
    let replayed = read(evaluate);
    let plain = read(evaluate_token_by_token);
    let (one, other) = (summary(&replayed), summary(&plain));
    if one != other {
        let at = one.bytes().zip(other.bytes()).take_while(|(a, b)| a == b);
        let from = at.count().saturating_sub(200);
        let part = |text: &str| text.chars().skip(from).take(500).collect::<String>();
        panic!(
            "{text}\n--- replayed\n{}\n--- read\n{}",
            part(&one),
            part(&other)
        );
    }
    replayed
}

fn errors(reading: &Reading) -> Vec<&str> {
    let findings = reading.findings.iter();
    let reported = findings.filter(|finding| finding.span.is_some());
    reported.map(|finding| finding.message.as_str()).collect()
}

#[test]
fn objects_of_macros_and_loops() {
    let reading = agree(
        "#declare T = texture { pigment { rgb <0.1, 0.2, 0.3> } finish { phong 1 } }
        #declare Part = union { sphere { 0, 1 } box { -1, 1 } }
        #macro Ball(P, R, C)
          #if (R > 0) sphere { P, R pigment { rgb C } } #end
          cylinder { P, P + y, R/2 open texture { T translate R*x } }
          object { Part scale R rotate <0, 10*R, 0> translate P no_shadow }
          box { -R, R rotate 45*y texture { T } interior { ior 1.25 + R } hollow }
          torus { 2, R inverse pigment { checker rgb C, rgb 1 scale R } finish { phong R ambient C } }
        #end
        #declare I = 0;
        #while (I < 5)
          #for (J, 0, 3) Ball(<I, sin(J), J/3>, I - 1, <I/5, 0.5, J/4>) #end
          #declare I = I + 1;
        #end",
    );
    assert_eq!(reading.scene.unwrap().objects.len(), 20 * 4 + 12);
}

#[test]
fn spheres_of_one_colour() {
    let reading = agree(
        "#macro Ball(P, R, C) sphere { P, R pigment { rgb C } } #end
        #declare Stream = seed(3);
        #for (I, 1, 30)
          Ball(I*x, 0.5, <I/30, 0.5, 0>)
          Ball(I*x, -I, 1)
          sphere { 0, rand(Stream) }
          sphere { <rand(Stream), I, 0> rand(Stream) pigment { color rgbt <rand(Stream), 0, 0, 0.5> } }
          sphere { 1, I pigment { rgbft 0.5 } }
          sphere { I, 1 pigment { rgb 1 } scale I }
          union { sphere { 0, I pigment { rgb I } } sphere { 0, 1 } }
          #if (I = 10) #default { pigment { rgb x } finish { phong 1 } } #end
          #if (I = 15) #default { pigment { checker scale 2 } } #end
          #if (I = 20) #default { pigment { rgb z quick_color rgb 1 } } #end
        #end",
    );
    assert_eq!(reading.scene.unwrap().objects.len(), 30 * 7);
}

#[test]
fn numbers_of_spheres_that_change() {
    for change in [
        "#declare C = <1, 2, 3>;",
        "#declare C = rgbt <1, 0, 0, 1>;",
        "#declare R = <1, 2, 3>;",
        "#declare R = 1e400;",
        "#declare C = 1e60;",
        "#declare P = 2;",
        "#declare P = <1, 2>;",
        "#declare P = <1, 2, 3, 4>;",
        "#undef P",
        "#undef R #macro R() 2 #end",
        "#undef C #macro C() 0.5 filter 0.5 #end",
        "#undef P #declare P = sphere { 0, 1 }",
        "#declare deprecated R = 2;",
        "#version 3.1;",
        "#declare N = sphere { 0, 1 }",
    ] {
        agree(&format!(
            "#declare R = 0.5; #declare C = 0.2; #declare P = <1, 2, 3>; #declare N = 1;
            #for (I, 1, 12)
              sphere {{ P + I*x, R + N pigment {{ rgb C }} }}
              sphere {{ P, R pigment {{ rgbf C }} }}
              #if (I > 3 & I < 8) {change} #end
            #end"
        ));
    }
}

#[test]
fn names_that_change_between_rounds() {
    for change in [
        "#declare R = <1, 2, 3>;",
        "#declare R = \"text\"",
        "#undef R",
        "#declare R = sphere { 0, 1 }",
        "#declare R = array[2] {1, 2}",
        "#macro More() + 1 #end",
        "#undef More #macro More() + 2 #end",
        "#undef More #declare More = 5;",
        "#declare C = rgbt <1, 0, 0, 1>;",
        "#declare C = 0.5;",
        "#declare C = texture { pigment { rgb 1 } }",
        "#declare T = pigment { rgb 1 }",
        "#undef Part #declare Part = 3;",
        "#declare Part = torus { 3, 1 }",
        "#undef Set #macro Set(A) #declare A = 7; #end",
        "#undef Set #macro Set(A, B) #declare A = B; #end",
        "#default { pigment { rgb x } }",
        "#version 3.1;",
        "#declare R = 1/0;",
        "global_settings { assumed_gamma 2.2 }",
        "#declare deprecated R = 2;",
    ] {
        agree(&format!(
            "#declare R = 0.5; #declare C = rgb 0.2; #declare V = <1, 2, 3>;
            #macro More() * 2 #end
            #macro Set(A) #declare A = A + 1; #end
            #declare T = texture {{ pigment {{ rgb y }} }}
            #declare Part = sphere {{ 0, 1 }}
            #for (I, 1, 8)
              sphere {{ V*I, R pigment {{ color C }} }}
              sphere {{ 0, I texture {{ T }} }}
              #local X = R + I More() ;
              #declare S = (I < 4 ? R : -R);
              object {{ Part translate I*x }}
              Set(X) Set(R)
              #debug concat(str(X, 0, 5), \" \", str(S, 0, 5), \"\\n\")
              #if (I = 4) {change} #else #local N = I; #end
            #end"
        ));
    }
}

#[test]
fn faults_of_a_later_call_have_the_same_place() {
    for fault in [
        "sphere { 0, 1/(I - 3) }",
        "#local A = 1/(I - 3);",
        "#local A = sqrt(3.5 - I);",
        "#local A = asin(I/3);",
        "#local A = List[I];",
        "#if (List[I] > 0) box { -1, 1 } #end",
        "sphere { <0, 0, List[I]>, 1 }",
        "sphere { 0, 1 scale <1, 1, I - 3> }",
        "sphere { 0, 1 pigment { rgb <1, 1, 1/(I - 3)> } }",
        "Inner(List[I])",
        "Inner(1/(I - 3))",
        "Inner(I, I)",
        "#if (I = 3) #declare U = 1; #end #local A = 2*U;",
        "#if (I > 3) #break #end Inner(I)",
        "#local A = I #if (I > 3) + Nothing #end ;",
        "cylinder { 0, (I - 3)*y, 1 }",
        "object { #if (I = 3) Nothing #else Part #end }",
        "sphere { 0, 1 pigment { rgb 1 } #if (I = 3) nonsense #end }",
        "sphere { 0, 1 rotate I*Nothing }",
        "#while (List[I] > 0) #break #end",
    ] {
        let reading = agree(&format!(
            "#declare List = array[4] {{ 1, 2, 3, 4 }}
            #declare Part = sphere {{ 0, 1 }}
            #macro Inner(Q) sphere {{ 0, Q }} #end
            #macro Outer(I) {fault} #end
            #for (K, 0, 7) Outer(K) #end"
        ));
        let is_faultless = fault.contains("#break #end Inner");
        assert!(is_faultless || !errors(&reading).is_empty(), "{fault}");
    }
}

#[test]
fn parameters_by_reference_and_random_numbers() {
    let reading = agree(
        "#declare S = seed(7); #declare Sum = 0; #declare V = <0, 0, 0>;
        #macro Add(To, What) #declare To = To + What; #local What = 5; #declare Sum = Sum + What; #end
        #macro Twice(A) Add(A, rand(S)) Add(A, A*rand(S)) #end
        #declare I = 0; #declare B = 1;
        #while (I < 20)
          Twice(B)
          #if (mod(I, 3) = 0) #declare B = 1; #elseif (B > 50) #declare B = B/2; #else #local Q = B; #end
          sphere { <rand(S), rand(S), rand(S)>, rand(S) + 0.1 pigment { rgb <rand(S), B/100, 0> } }
          sphere { V, 1/(rand(S) > 0.5 ? 1 : 2) #if (rand(S) > 0.5) no_shadow #end }
          Add(V.x*1, 1)
          #declare V = V + x*rand(S);
          #debug concat(str(B, 0, 9), \" \", str(Sum, 0, 9), \" \", vstr(3, V, \",\", 0, 9), \"\\n\")
          #declare I = I + 1;
        #end",
    );
    assert!(reading.messages.lines().count() >= 1);
}

/// A reproducible sequence of choices.
struct Choices(u64);

impl Choices {
    fn below(&mut self, many: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from((self.0 >> 11) % many as u64).unwrap()
    }

    fn of<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }

    fn number(&mut self, depth: usize) -> String {
        let names = ["A", "B", "C", "I", "P", "Q"];
        if depth == 0 {
            return match self.below(8) {
                0..4 => self.of(&names).to_owned(),
                4 => "V.x".to_owned(),
                5 => format!("List[{}]", self.below(4)),
                _ => format!("{}", self.below(9)),
            };
        }
        let (one, two) = (self.number(depth - 1), self.number(depth - 1));
        match self.below(12) {
            0..3 => format!("{one} + {two}"),
            3 => format!("{one} - {two}"),
            4..6 => format!("({one})*{two}"),
            6 => format!("({one})/(1 + abs({two}))"),
            7 => format!("sin({one})"),
            8 => format!("max({one}, {two})"),
            9 => format!("({one} > {two} ? {one} : 1)"),
            10 => format!("-{one}"),
            _ => format!("Mean({one}, {two})"),
        }
    }

    fn vector(&mut self) -> String {
        match self.below(4) {
            0 => "V".to_owned(),
            1 => format!("V*{}", self.number(0)),
            _ => format!(
                "<{}, {}, {}>",
                self.number(1),
                self.number(0),
                self.below(5)
            ),
        }
    }

    fn object(&mut self) -> String {
        let mut text = match self.below(5) {
            0 => format!("sphere {{ {}, {}", self.vector(), self.number(1)),
            1 => format!("box {{ {}, {}", self.vector(), self.vector()),
            2 => "object { Part".to_owned(),
            3 => format!("union {{ {} {}", self.object(), self.object()),
            _ => format!("torus {{ {}, 0.5", self.number(0)),
        };
        for _ in 0..self.below(4) {
            text += &match self.below(8) {
                0 => format!(" pigment {{ rgb {} }}", self.vector()),
                1 => format!(" finish {{ phong {} }}", self.number(1)),
                2 => " texture { T }".to_owned(),
                3 => format!(" translate {}", self.vector()),
                4 => format!(" scale 1 + abs({})", self.number(0)),
                5 => format!(" rotate {}*y", self.number(0)),
                6 => format!(" #if ({}) no_shadow #end", self.number(1)),
                _ => " pigment { checker rgb 1, rgb 0 }".to_owned(),
            };
        }
        text + " }"
    }

    /// An argument that a macro may change, or one that is no name.
    fn argument(&mut self) -> String {
        match self.below(3) {
            0 => self.of(&["A", "B", "C", "V.y", "List[2]"]).to_owned(),
            _ => format!("0 + {}", self.number(1)),
        }
    }

    fn statements(&mut self, depth: usize) -> String {
        let mut text = String::new();
        for _ in 0..=self.below(4) {
            text += &match self.below(13) {
                0..3 => format!(
                    "#declare {} = {};",
                    self.of(&["A", "B", "C", "P"]),
                    self.number(2)
                ),
                3 => format!("#local {} = {};", self.of(&["A", "Q", "D"]), self.number(2)),
                4 => format!("#declare V = {};", self.vector()),
                5 => format!("#debug concat(str({}, 0, 6), \"\\n\")", self.number(1)),
                6..9 => self.object(),
                9 => format!("#declare List[{}] = {};", self.below(4), self.number(1)),
                _ if depth == 0 => format!("#local R = {};", self.number(1)),
                10 => format!(
                    "#if ({} > {}) {} #else {} #end",
                    self.number(1),
                    self.number(0),
                    self.statements(depth - 1),
                    self.statements(depth - 1)
                ),
                11 => format!(
                    "#for (K, 0, {}) {} #end",
                    self.below(4),
                    self.statements(depth - 1)
                ),
                _ => format!("Small({}, {})", self.argument(), self.of(&["A", "B", "C"])),
            };
            text.push(' ');
        }
        text
    }
}

#[test]
fn scenes_at_random() {
    let mut choices = Choices(88_172_645_463_325_252);
    for _ in 0..60 {
        let mean = choices.number(1).replace("Mean", "max");
        let small = choices.statements(1).replace("Small", "Tiny");
        let (big, round) = (choices.statements(2), choices.statements(2));
        let change = choices.of(&[
            "",
            "#if (I = 3) #declare Part = box { -1, 1 } #end",
            "#if (I = 3) #macro Mean(P, Q) (P*0.25 + Q) #end #end",
            "#if (I = 3) #undef C #end",
            "#if (I = 2) #declare C = <1, 2, 3>; #end",
            "#if (I = 2) #declare T = texture { pigment { rgb z } } #end",
        ]);
        agree(&format!(
            "#declare A = 1; #declare B = 2.5; #declare C = -1; #declare P = 1; #declare Q = 2;
            #declare I = 0; #declare V = <1, 2, 3>; #declare List = array[4] {{ 1, 2, 3, 4 }}
            #declare T = texture {{ pigment {{ rgb y }} }} #declare Part = sphere {{ 0, 1 }}
            #macro Mean(P, Q) ({mean}) #end
            #macro Tiny(P, Q) #local P = Q; #end
            #macro Small(P, Q) {small} #end
            #macro Big(P, Q) {big} #end
            #while (I < 5) {round} Big(A + I, B) Small(0 + I, C) {change} #declare I = I + 1; #end"
        ));
    }
}

#[test]
fn numbers_declared_over_others() {
    for change in [
        "#declare Z = 0;",
        "#declare N = <1, 2, 3>;",
        "#declare N = \"text\";",
        "#undef N",
        "#declare V = 1;",
        "#local N = 7;",
        "#declare Angle = 1e308*10;",
    ] {
        agree(&format!(
            "#declare N = 1; #declare Z = 2; #declare V = <1, 2>; #declare Angle = 0.5;
            #declare List = array[2] {{ 1, 2 }}
            #macro Count(A) #declare A = A + 1; #end
            #macro Own(A) #declare A = A*2; #local A = A + 1; #local Z = A; sphere {{ A, Z }} #end
            #for (I, 1, 12)
              Count(N) Count(List[1]) Own(N) Own(N + 0)
              #declare Q = N/Z;
              #declare W = Z/3;
              #declare V = V + 1;
              #declare Angle = sin(Angle) + cos(Angle*2) - sin(cos(Angle));
              #if (N - I) #declare N = N - 1; #end
              #while (Z > 5) #declare Z = Z - 1; #end
              sphere {{ <Q, W, Angle>, 1 + List[1] + V.x }}
              #debug concat(str(Q, 0, 6), str(Angle, 0, 12))
              #if (I = 7) {change} #end
            #end"
        ));
    }
}

#[test]
fn semicolons_behind_macros_and_hashes_before_names() {
    let reading = agree(
        "#declare F = function(a) { a + 1 } #declare A = array[2] { F, F }
        #declare V = <0.1, 0.2, 0.3>; #declare N = 0; #declare W = 0*x;
        #macro Set(To, Value) #local Half = Value/2; #declare To = 2*Half; #end
        #macro Set_Open(To, Value) #declare To = Value #end
        #macro Set_Both(To, Value) Set(N, Value.x) Set_Open(To, Value); #end
        #for (I, 1, 30)
          Set(N, I);
          Set_Open(N, N + 1);;
          Set_Both(W, I*V)
          #declare N = F(N);;
          #local B = array[1] { A[mod(I, 2)] }
          #declare W = #V*I + W;
          sphere { #W, B[0](N)/10 pigment { rgb #V } }
          #local Drawn = rand(seed(I)) + rand(seed(I));
          sphere { I*y, Drawn }
        #end
        #debug concat(str(N, 0, 3), \" \", vstr(3, W, \",\", 0, 3))",
    );
    assert_eq!(errors(&reading), [""; 0]);
    assert_eq!(reading.scene.unwrap().objects.len(), 60);
}
