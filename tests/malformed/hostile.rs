//! Scenes written to exhaust a reader: nesting, loops, recursion, growth.

/// Levels of nesting far beyond what any author writes.
const DEEP: usize = 100_000;

/// The rest of a scene around a hostile part.
const REST: &str = "light_source { <-4, 6, -8>, rgb 1 }\ncamera { location -5*z look_at 0 }\n";

/// All hostile scenes by name.
pub(crate) fn scenes() -> Vec<(&'static str, String)> {
    let mut all = nesting();
    all.extend(endless());
    all.extend(growth());
    all.extend(odd_files());
    all
}

/// `start`, then `open` many times, then `middle`, then `close` as often.
fn nested(start: &str, open: &str, middle: &str, close: &str) -> String {
    let (open, close) = (open.repeat(DEEP), close.repeat(DEEP));
    format!("{start}{open}{middle}{close}\n{REST}")
}

fn nesting() -> Vec<(&'static str, String)> {
    let sphere = "sphere { 0, 1 }";
    vec![
        ("open_braces", nested("", "{", "", "")),
        ("open_parentheses", nested("#declare A = ", "(", "", "")),
        ("open_angles", nested("sphere { ", "<", "", "")),
        ("open_comments", nested("", "/* ", "", "")),
        ("nested_comments", nested("", "/* ", "", " */")),
        ("open_ifs", nested("", "#if (1) ", "", "")),
        ("nested_ifs", nested("", "#if (1) ", sphere, " #end")),
        ("skipped_ifs", nested("", "#if (0) ", sphere, " #end")),
        ("nested_whiles", nested("", "#while (0) ", "", " #end")),
        (
            "nested_switches",
            nested("", "#switch (1) #case (1) ", sphere, " #end"),
        ),
        (
            "open_unions",
            nested("", "union { sphere { 0, 1 } ", "", ""),
        ),
        ("unions", nested("", "union { sphere { 0, 1 } ", "", "}")),
        (
            "differences",
            nested("", "difference { ", sphere, " sphere { 1, 0.1 } }"),
        ),
        (
            "differences_on_the_right",
            nested("", "difference { sphere { 0, 2 } ", sphere, " }"),
        ),
        (
            "inverse_intersections",
            nested("", "intersection { ", sphere, " plane { y, 2 } inverse }"),
        ),
        (
            "clips",
            nested("", "sphere { 0, 1 clipped_by { ", "plane { y, 0 }", " } }"),
        ),
        (
            "bounds",
            nested("", "union { bounded_by { ", sphere, " } }"),
        ),
        (
            "transforms",
            nested("#declare T = ", "transform { ", "translate x", " }"),
        ),
        (
            "objects",
            nested("", "object { ", sphere, " translate 0.00001*x }"),
        ),
        (
            "textures",
            nested("sphere { 0, 1 ", "texture { ", "", " } }"),
        ),
        ("pigments", nested("sphere { 0, 1 ", "pigment { ", "", "")),
        ("macros", nested("", "#macro M() ", "", " #end")),
        ("parentheses", nested("#declare A = ", "(", "1", ")")),
        ("signs", nested("#declare A = ", "- ", "1;", "")),
        ("nots", nested("#declare A = ", "!", "1;", "")),
        ("calls", nested("#declare A = ", "abs(", "1", ")")),
        ("vectors", nested("#declare A = ", "<", "1", ">")),
        ("conditions", nested("#declare A = (", "1 ? ", "1", " : 2")),
        ("strings", nested("#declare A = ", "concat(", "\"a\"", ")")),
        (
            "arguments",
            nested("#macro M(A) A #end #declare A = ", "M(", "1", ")"),
        ),
        ("declarations", nested("", "#declare A = <1, ", "1", ">;")),
        ("arrays", nested("#declare A = ", "array[1] { ", "1", " }")),
        ("open_conditions", nested("", "#if (", "", "")),
        ("long_sum", nested("#declare A = 1", " + 1e-9", ";", "")),
    ]
}

fn endless() -> Vec<(&'static str, String)> {
    let rest = |text: &str| format!("{text}\n{REST}");
    vec![
        ("while_forever", rest("#while (1) #end")),
        (
            "while_counts",
            rest("#declare I = 0;\n#while (I >= 0) #declare I = I + 1; #end"),
        ),
        (
            "while_makes_objects",
            rest("#while (1) sphere { 0, 1 } #end"),
        ),
        (
            "while_in_union",
            rest("union { #while (1) sphere { 0, 1 } #end }"),
        ),
        (
            "while_writes_messages",
            rest("#while (1) #debug \"again\\n\" #end"),
        ),
        ("for_to_infinity", rest("#for (I, 0, 1e300) #end")),
        ("for_tiny_steps", rest("#for (I, 0, 1, 1e-300) #end")),
        (
            "for_nested",
            rest("#for (I, 0, 1e5) #for (J, 0, 1e5) #for (K, 0, 1e5) #end #end #end"),
        ),
        ("macro_calls_itself", rest("#macro M() M() #end\nM()")),
        ("macro_doubles", rest("#macro M() M() M() #end\nM()")),
        (
            "macro_in_its_argument",
            rest("#macro M(A) M(A + 1) #end\nsphere { 0, M(1) }"),
        ),
        (
            "macros_call_each_other",
            rest("#macro A() B() #end\n#macro B() A() #end\nunion { A() }"),
        ),
        (
            "macro_in_objects",
            rest("#macro M() union { M() } #end\nM()"),
        ),
        ("include_itself", rest("#include \"include_itself.pov\"")),
        ("include_a_folder", rest("#include \"/\"")),
        ("include_a_device", rest("#include \"/dev/zero\"")),
        (
            "ask_for_a_device",
            rest("#if (file_exists(\"/dev/zero\")) sphere { 0, 1 } #end"),
        ),
    ]
}

fn growth() -> Vec<(&'static str, String)> {
    let rest = |text: &str| format!("{text}\n{REST}");
    vec![
        (
            "string_doubles",
            rest("#declare S = \"ab\";\n#for (I, 1, 60) #declare S = concat(S, S); #end"),
        ),
        (
            "union_doubles",
            rest(
                "#declare U = sphere { 0, 1 };\n#for (I, 1, 60) #declare U = union { object { U } object { U translate x } } #end\nobject { U }",
            ),
        ),
        (
            "union_deepens",
            rest(
                "#declare U = sphere { 0, 1 };\n#for (I, 1, 1e6) #declare U = union { object { U } sphere { I, 1 } } #end\nobject { U }",
            ),
        ),
        (
            "clip_doubles",
            rest(
                "#declare U = sphere { 0, 1 };\n#for (I, 1, 60) #declare U = sphere { 0, 1 clipped_by { object { U } object { U } } } #end\nobject { U }",
            ),
        ),
        (
            "layers_double",
            rest(
                "#declare T = texture { pigment { rgbt 0.5 } }\n#for (I, 1, 60) #declare T = texture { T } texture { T } #end\nsphere { 0, 1 texture { T } }",
            ),
        ),
        (
            "macro_calls_double",
            rest(
                &((1..60).fold("#macro M0() #end\n".to_owned(), |all, i| {
                    let below = i - 1;
                    format!("{all}#macro M{i}() M{below}() M{below}() #end\n")
                }) + "M59()"),
            ),
        ),
        (
            "array_deepens",
            rest(
                "#declare A = array[1] { 1 }\n#for (I, 1, 1e6) #declare B = array[1] { A } #declare A = B; #end",
            ),
        ),
        (
            "arrays_huge",
            rest("#declare A = array[5e7]\n#declare B = array[5e7]\n#declare C = array[5e7]"),
        ),
        (
            "arrays_copied",
            rest(
                "#declare Q = array[1000]\n#for (I, 0, 999) #declare A = array[1e6] #declare Q[I] = A; #declare A[0] = 1; #end",
            ),
        ),
        (
            "strings_kept",
            rest(
                "#declare A = array[1e6]\n#declare S = str(1, 400, 0);\n#for (I, 1, 12) #declare S = concat(S, S) #end\n#for (I, 0, 1e6) #declare A[I] = concat(S, \"x\") #end",
            ),
        ),
        (
            "object_turned_often",
            rest(
                "#declare A = box { -1, 1 }\n#for (I, 1, 1e5) #declare A = object { A rotate y } #end\nobject { A }",
            ),
        ),
        (
            "texture_moved_often",
            rest(
                "#declare T = texture { pigment { checker rgb 1 rgb 0 } }\n#for (I, 1, 1e5) #declare T = texture { T translate x } #end\nsphere { 0, 1 texture { T } }",
            ),
        ),
        (
            "unions_moved",
            rest(&format!(
                "{}{}",
                "union { sphere { 0, 1 } ".repeat(1900),
                "translate 0.001*x }".repeat(1900)
            )),
        ),
        (
            "infinite_numbers",
            rest(
                "sphere { 0, 1/0 }\nsphere { <1e999, 0, 0>, 1 }\nsphere { 0, 1 pigment { rgb 1e999 } }\nsphere { 0, 1 matrix <1/0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0> }",
            ),
        ),
        (
            "no_numbers",
            rest(
                "#declare A = 1/0 - 1/0;\n#for (I, A, 10) #end\n#for (I, 0, A) #end\n#for (I, 0, 9, A) #end\nsphere { A, 1 }\nsphere { 0, 1 rotate A }",
            ),
        ),
        (
            "string_padded",
            rest("#declare S = str(1, 1000000000, 1000000000);"),
        ),
        (
            "vector_string_padded",
            rest("#declare S = vstr(5, <1, 2, 3>, \", \", 1000000000, 1000000000);"),
        ),
        (
            "letter_out_of_range",
            rest("#declare S = concat(chr(-1), chr(1000000000), chr(1e300));"),
        ),
        (
            "substring_out_of_range",
            rest("#declare S = substr(\"abc\", -5, 1e300);"),
        ),
        (
            "trace_level_huge",
            rest(
                "global_settings { max_trace_level 1e9 }\nplane { z, 1 finish { reflection 1 } }\nplane { -z, 9 finish { reflection 1 } }",
            ),
        ),
        (
            "seed_huge",
            rest(
                "#declare S = seed(1e300);\nsphere { 0, rand(S) }\nsphere { 0, rand(-1) }\nsphere { 0, rand(1e300) }",
            ),
        ),
        (
            "many_layers",
            rest(&format!(
                "sphere {{ 0, 1 {} }}",
                "texture { pigment { rgbt 0.9 } }".repeat(20_000)
            )),
        ),
        (
            "many_clips",
            rest(&format!(
                "sphere {{ 0, 1 {} }}",
                "clipped_by { plane { y, 2 } }".repeat(20_000)
            )),
        ),
        (
            "many_lights",
            format!(
                "{}{REST}sphere {{ 0, 1 pigment {{ rgb 1 }} }}",
                "light_source { 9*y, rgb 0.01 }\n".repeat(20_000)
            ),
        ),
        (
            "many_members",
            rest(&format!(
                "difference {{ box {{ -1, 1 }} {} }}",
                "sphere { 1, 0.5 }".repeat(50_000)
            )),
        ),
        (
            "long_name",
            rest(&format!("#declare {} = 1;", "A".repeat(1_000_000))),
        ),
        (
            "long_number",
            rest(&format!(
                "sphere {{ 0, 0.{} }}",
                "1234567890".repeat(100_000)
            )),
        ),
        (
            "long_string",
            rest(&format!("#declare S = \"{}\";", "text ".repeat(500_000))),
        ),
    ]
}

fn odd_files() -> Vec<(&'static str, String)> {
    vec![
        ("empty", String::new()),
        ("blank", "\n\n \t\r\n".to_owned()),
        ("one_quote", "\"".to_owned()),
        ("one_hash", "#".to_owned()),
        ("open_directive", format!("{REST}#declare")),
        (
            "byte_order_mark",
            format!("\u{feff}{REST}sphere {{ 0, 1 }}"),
        ),
        (
            "end_of_file_mark",
            format!("{REST}sphere {{ 0, 1 }}\n\u{1a}"),
        ),
        (
            "carriage_returns",
            format!("{REST}// comment\rsphere {{ 0, 1 }}\r").replace('\n', "\r"),
        ),
        (
            "not_ascii",
            format!("// größe\n{REST}#declare größe = 1;\nsphere {{ 0, größe }}"),
        ),
        (
            "size_of_nothing",
            "camera { location 0 look_at 0 }\nsphere { 0, 1 }".to_owned(),
        ),
        (
            "view_without_length",
            "camera { direction 0 right 0 up 0 }\nsphere { 0, 1 }".to_owned(),
        ),
        ("plane_without_normal", format!("{REST}plane {{ 0, 1 }}")),
        (
            "cylinder_without_length",
            format!("{REST}cylinder {{ y, y, 1 }}"),
        ),
        (
            "singular_matrix",
            format!("{REST}sphere {{ 0, 1 matrix <1, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0> }}"),
        ),
        (
            "empty_solids",
            format!("{REST}union {{ }}\nintersection {{ }}\ndifference {{ }}\nmerge {{ }}"),
        ),
        (
            "box_without_end",
            "camera { location <0, 5, -9> look_at <0, 0.5, 0> angle 50 }\nplane { y, 0 }\nsphere { <-1.5, 1, 0>, 1 }\n\
             box { <0.6, 0, -0.6>, <2, 1e308, 0.8> }\nlight_source { <-5, 6, -4>, rgb 1 }\n"
                .to_owned(),
        ),
        (
            "colour_of_six",
            format!("{REST}sphere {{ 0, 1 pigment {{ color <1, 2, 3, 4, 5, 6> }} }}"),
        ),
    ]
}
