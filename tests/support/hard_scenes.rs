//! Generated scenes that are hard to sample: any number of every kind, all different.
//!
//! Small or thin objects are sized in pixels of a picture [`ROWS`] rows high, so that as many of them lie below a pixel
//! as above.

use std::fmt::Write;

/// The height of the pictures that the sizes in the scenes are made for.
pub(crate) const ROWS: u32 = 36;

/// The camera stands 6 before the origin; this is the height of its view there.
const SIGHT: f64 = 4.0;

/// A kind of hard scene and the function that writes its objects.
type Kind = (&'static str, fn(&mut Chance, &mut String));

const KINDS: &[Kind] = &[
    ("wires", wires),
    ("horizon", horizon),
    ("highlights", highlights),
    ("glass", glass),
    ("mirrors", mirrors),
    ("far", far),
    ("soft", soft),
    ("fine", fine),
    ("holes", holes),
    ("gaps", gaps),
    ("specks", specks),
    ("letters", letters),
    ("mesh", mesh),
    ("ripples", ripples),
    ("shadows", shadows),
    ("panes", panes),
];

/// A hard scene.
pub(crate) struct HardScene {
    /// The kind and the number.
    pub(crate) name: String,
    pub(crate) text: String,
}

/// The scene of each kind with this number.
pub(crate) fn hard_scenes(number: u32) -> impl Iterator<Item = HardScene> {
    (0u64..).zip(KINDS).map(move |(which, (kind, write))| {
        let mut chance = Chance::of(which << 32 | u64::from(number));
        let mut text = String::from(
            "#version 3.7; global_settings { assumed_gamma 1 max_trace_level 8 }\n\
             camera { location -6*z right 4/3*x look_at 0 angle 47.925 }\n",
        );
        write(&mut chance, &mut text);
        HardScene {
            name: format!("{kind}-{number}"),
            text,
        }
    })
}

/// Reproducible random numbers (Steele et al. 2014, "Fast splittable pseudorandom number generators").
struct Chance(u64);

impl Chance {
    fn of(seed: u64) -> Chance {
        let mut chance = Chance(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d);
        chance.next();
        chance
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    #[allow(clippy::cast_precision_loss, reason = "53 bits are left")]
    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// Log-uniform: as often between 1 and 2 as between 2 and 4.
    fn of_any_size(&mut self, least: f64, most: f64) -> f64 {
        least * (most / least).powf(self.between(0.0, 1.0))
    }

    /// A length of some pixels at the distance of the origin.
    fn pixels(&mut self, least: f64, most: f64) -> f64 {
        self.of_any_size(least, most) * SIGHT / f64::from(ROWS)
    }

    fn below(&mut self, end: u64) -> u64 {
        self.next() % end
    }

    fn color(&mut self, least: f64, most: f64) -> String {
        let [r, g, b] = [(); 3].map(|()| self.between(least, most));
        format!("rgb <{r:.3}, {g:.3}, {b:.3}>")
    }

    /// A point in view.
    fn point(&mut self, depth: f64) -> String {
        let (x, y) = (self.between(-2.4, 2.4), self.between(-1.8, 1.8));
        let z = self.between(-depth, depth);
        format!("<{x:.4}, {y:.4}, {z:.4}>")
    }

    fn turn(&mut self) -> String {
        let [x, y, z] = [(); 3].map(|()| self.between(0.0, 360.0));
        format!("rotate <{x:.2}, {y:.2}, {z:.2}>")
    }

    fn light(&mut self) -> String {
        let (x, y, z) = (
            self.between(-8.0, 8.0),
            self.between(3.0, 9.0),
            self.between(-12.0, -5.0),
        );
        format!("light_source {{ <{x:.3}, {y:.3}, {z:.3}>, rgb 0.8 }}\n")
    }

    fn surroundings(&mut self) -> String {
        let (light, back) = (self.light(), self.color(0.05, 0.8));
        format!("{light}background {{ {back} }}\n")
    }
}

fn add(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("a text takes all");
    text.push('\n');
}

fn wires(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    for _ in 0..8 {
        let (from, to) = (chance.point(1.0), chance.point(1.0));
        let (radius, color) = (chance.pixels(0.02, 1.0), chance.color(0.0, 0.9));
        add(
            text,
            format_args!("cylinder {{ {from}, {to}, {radius:.6} pigment {{ {color} }} }}"),
        );
    }
    let (radius, turn) = (chance.pixels(0.05, 0.6), chance.turn());
    add(
        text,
        format_args!("torus {{ 1.3, {radius:.6} {turn} pigment {{ rgb 0.9 }} }}"),
    );
}

fn horizon(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let pattern = ["checker", "hexagon", "brick", "checker"][chance.below(4) as usize];
    let colors: Vec<String> = (0..3).map(|_| chance.color(0.0, 1.0)).collect();
    let count = if pattern == "hexagon" { 3 } else { 2 };
    let scale = chance.of_any_size(0.02, 0.6);
    let (tilt, yaw) = (chance.between(-8.0, 8.0), chance.between(0.0, 360.0));
    let height = chance.between(0.3, 1.5);
    add(
        text,
        format_args!(
            "plane {{ y, 0 pigment {{ {pattern} {} scale {scale:.4} rotate {yaw:.2}*y }} finish {{ ambient 0.2 diffuse 0.7 }} \
             translate -{height:.3}*y rotate {tilt:.2}*z }}",
            colors[..count].join(", ")
        ),
    );
}

fn highlights(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    text.push_str(&chance.light());
    for _ in 0..24 {
        let (point, radius) = (chance.point(1.0), chance.pixels(0.5, 6.0));
        let (color, shine) = (chance.color(0.0, 0.5), chance.of_any_size(0.0003, 0.03));
        let bright = chance.between(0.3, 3.0);
        add(
            text,
            format_args!(
                "sphere {{ {point}, {radius:.4} pigment {{ {color} }} finish {{ specular {bright:.3} roughness {shine:.6} }} }}"
            ),
        );
    }
}

fn glass(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let (a, b) = (chance.color(0.0, 0.5), chance.color(0.4, 0.9));
    let scale = chance.of_any_size(0.05, 0.8);
    let pattern = ["gradient x", "checker", "radial frequency 24"][chance.below(3) as usize];
    let colors = match pattern {
        "checker" => format!("{a}, {b} scale {scale:.3}"),
        _ => format!("color_map {{ [0.5 {a}] [0.5 {b}] }} scale {scale:.3}"),
    };
    add(
        text,
        format_args!(
            "plane {{ z, 3 pigment {{ {pattern} {colors} rotate 20*z }} finish {{ ambient 0.5 diffuse 0.4 }} }}"
        ),
    );
    for _ in 0..4 {
        let (point, size, turn) = (chance.point(0.8), chance.between(0.3, 0.9), chance.turn());
        let ior = chance.between(1.1, 2.0);
        let shape = [
            format!("sphere {{ 0, {size:.3}"),
            format!("box {{ -{size:.3}/2, {size:.3}/2"),
            format!("torus {{ {size:.3}, {:.3}", size / 4.0),
            format!(
                "difference {{ sphere {{ 0, {size:.3} }} sphere {{ 0, {:.4} }}",
                size * 0.95
            ),
        ][chance.below(4) as usize]
            .clone();
        add(
            text,
            format_args!(
                "{shape} pigment {{ rgbf <0.95, 0.97, 1, 0.92> }} finish {{ reflection 0.1 specular 0.4 roughness 0.01 }} \
                 interior {{ ior {ior:.3} }} {turn} translate {point} }}"
            ),
        );
    }
}

fn mirrors(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let (a, b, scale) = (
        chance.color(0.0, 0.4),
        chance.color(0.5, 0.9),
        chance.between(0.1, 1.0),
    );
    add(
        text,
        format_args!("plane {{ y, -1.6 pigment {{ checker {a}, {b} scale {scale:.3} }} }}"),
    );
    for _ in 0..12 {
        let (point, size, turn) = (
            chance.point(1.0),
            chance.of_any_size(0.05, 0.8),
            chance.turn(),
        );
        let shape = [
            format!("sphere {{ 0, {size:.3}"),
            format!("box {{ -{size:.3}, {size:.3}"),
            format!("torus {{ {size:.3}, {:.3}", size / 5.0),
        ][chance.below(3) as usize]
            .clone();
        let share = chance.between(0.3, 0.9);
        add(
            text,
            format_args!(
                "{shape} pigment {{ rgb 0.1 }} finish {{ diffuse 0.3 reflection {share:.3} }} {turn} translate {point} }}"
            ),
        );
    }
}

fn far(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    for _ in 0..60 {
        let (point, size, turn) = (chance.point(2.0), chance.pixels(0.1, 2.0), chance.turn());
        let shape = [
            format!("sphere {{ 0, {size:.5}"),
            format!("box {{ -{size:.5}/2, {size:.5}/2"),
            format!("torus {{ {size:.5}, {size:.5}/4"),
            format!("cone {{ 0, {size:.5}, y*{size:.5}*3, 0"),
        ][chance.below(4) as usize]
            .clone();
        let color = chance.color(0.0, 1.0);
        add(
            text,
            format_args!("{shape} pigment {{ {color} }} {turn} translate {point} }}"),
        );
    }
}

fn soft(chance: &mut Chance, text: &mut String) {
    let back = chance.color(0.1, 0.6);
    add(text, format_args!("background {{ {back} }}"));
    let (size, count) = (chance.between(0.3, 3.0), 3 + 2 * chance.below(3));
    let extra =
        ["", "jitter", "adaptive 1 jitter", "circular orient jitter"][chance.below(4) as usize];
    let (x, z) = (chance.between(-5.0, 5.0), chance.between(-8.0, -3.0));
    add(
        text,
        format_args!(
            "light_source {{ <{x:.3}, 7, {z:.3}>, rgb 0.9 area_light {size:.3}*x, {size:.3}*z, {count}, {count} {extra} }}"
        ),
    );
    add(
        text,
        format_args!(
            "plane {{ y, -1.6 pigment {{ rgb 0.8 }} }} plane {{ z, 4 pigment {{ rgb <0.6, 0.5, 0.4> }} }}"
        ),
    );
    for _ in 0..7 {
        let (point, radius, color) = (
            chance.point(1.0),
            chance.of_any_size(0.01, 0.5),
            chance.color(0.1, 0.9),
        );
        let to = chance.point(1.0);
        let shape = match chance.below(2) {
            0 => format!("sphere {{ {point}, {radius:.4}"),
            _ => format!("cylinder {{ {point}, {to}, {radius:.4}/4"),
        };
        add(text, format_args!("{shape} pigment {{ {color} }} }}"));
    }
}

fn fine(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let patterns = [
        "granite color_map { [0 rgb 0] [1 rgb 1] }",
        "wrinkles color_map { [0 rgb <0.2, 0.1, 0>] [1 rgb 0.9] }",
        "bozo color_map { [0.5 rgb 0.1] [0.5 rgb 0.8] }",
        "wood color_map { [0.4 rgb <0.5, 0.3, 0.1>] [0.5 rgb <0.9, 0.7, 0.4>] }",
        "crackle color_map { [0 rgb 0] [0.1 rgb 0.8] }",
        "image_map { function 40, 40 { abs(sin(x*37)*cos(y*61)) } }",
        "spotted color_map { [0.3 rgb 0.9] [0.4 rgb 0.2] }",
    ];
    for number in 0..6 {
        let (point, size, turn) = (chance.point(1.0), chance.between(0.3, 0.9), chance.turn());
        let pattern = patterns[chance.below(patterns.len() as u64) as usize];
        let scale = chance.of_any_size(0.02, 0.7);
        let shape = match number % 2 {
            0 => format!("sphere {{ 0, {size:.3}"),
            _ => format!("box {{ -{size:.3}, {size:.3}"),
        };
        add(
            text,
            format_args!(
                "{shape} pigment {{ {pattern} scale {scale:.4} }} finish {{ ambient 0.2 diffuse 0.7 }} {turn} translate {point} }}"
            ),
        );
    }
}

fn holes(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let (back, front, turn) = (
        chance.color(0.5, 1.0),
        chance.color(0.0, 0.4),
        chance.between(-35.0, 35.0),
    );
    add(
        text,
        format_args!("plane {{ z, 2 pigment {{ {back} }} finish {{ ambient 0.6 }} }}"),
    );
    add(
        text,
        format_args!("difference {{ box {{ <-2.2, -1.6, 0>, <2.2, 1.6, 0.1> }}"),
    );
    for _ in 0..40 {
        let (x, y) = (chance.between(-2.1, 2.1), chance.between(-1.5, 1.5));
        let radius = chance.pixels(0.05, 1.2);
        add(
            text,
            format_args!("cylinder {{ <{x:.4}, {y:.4}, -1>, <{x:.4}, {y:.4}, 1>, {radius:.5} }}"),
        );
    }
    add(
        text,
        format_args!("pigment {{ {front} }} rotate {turn:.2}*y rotate {turn:.2}*z/2 }}"),
    );
}

fn gaps(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let (back, front, turn) = (
        chance.color(0.6, 1.0),
        chance.color(0.0, 0.3),
        chance.between(0.0, 180.0),
    );
    add(
        text,
        format_args!("plane {{ z, 2 pigment {{ {back} }} finish {{ ambient 0.7 }} }}"),
    );
    add(text, format_args!("union {{"));
    let mut at = -4.0;
    while at < 4.0 {
        let (wide, gap) = (chance.between(0.2, 1.0), chance.pixels(0.02, 0.7));
        add(
            text,
            format_args!("box {{ <{at:.5}, -4, 0>, <{:.5}, 4, 0.01> }}", at + wide),
        );
        at += wide + gap;
    }
    add(
        text,
        format_args!("pigment {{ {front} }} rotate {turn:.2}*z }}"),
    );
}

fn specks(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let wall = chance.color(0.1, 0.5);
    add(text, format_args!("plane {{ z, 2 pigment {{ {wall} }} }}"));
    for _ in 0..60 {
        let (point, radius, bright) = (
            chance.point(1.0),
            chance.pixels(0.03, 0.5),
            chance.of_any_size(0.5, 4.0),
        );
        add(
            text,
            format_args!(
                "sphere {{ {point}, {radius:.5} pigment {{ rgb 1 }} finish {{ ambient {bright:.3} }} }}"
            ),
        );
    }
}

fn letters(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let words = [
        "truth and error",
        "samples of a pixel",
        "between the lines",
        "what nobody saw",
    ];
    for line in 0..6 {
        let word = words[chance.below(4) as usize];
        let font = ["cyrvetic.ttf", "timrom.ttf", "crystal.ttf"][chance.below(3) as usize];
        let (size, color, turn) = (
            chance.of_any_size(0.1, 0.8),
            chance.color(0.0, 1.0),
            chance.between(-30.0, 30.0),
        );
        let y = 1.5 - 0.6 * f64::from(line);
        add(
            text,
            format_args!(
                "text {{ ttf \"{font}\" \"{word}\" 0.1, 0 scale <{size:.3}, {size:.3}, 1> pigment {{ {color} }} rotate {turn:.2}*z \
                 translate <-2.2, {y:.2}, 0> }}"
            ),
        );
    }
}

fn mesh(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    let (color, steep) = (chance.color(0.2, 0.9), chance.between(0.1, 1.0));
    let step = chance.pixels(0.4, 4.0);
    let turn = chance.between(-60.0, -15.0);
    add(text, format_args!("mesh {{"));
    let corners = (3.0 / step).ceil().min(30.0);
    let height = |chance: &mut Chance| chance.between(0.0, steep * step);
    let mut y = -corners;
    while y < corners {
        let mut x = -corners;
        while x < corners {
            let (a, b) = (height(chance), height(chance));
            let at = |dx: f64, dy: f64| {
                (
                    format!("{:.5}", (x + dx) * step),
                    format!("{:.5}", (y + dy) * step),
                )
            };
            let ([ax, ay], [bx, by], [cx, cy], [dx, dy]) = (
                at(0.0, 0.0).into(),
                at(1.0, 0.0).into(),
                at(0.0, 1.0).into(),
                at(1.0, 1.0).into(),
            );
            let [ax, ay, bx, by, cx, cy, dx, dy]: [String; 8] = [ax, ay, bx, by, cx, cy, dx, dy];
            add(
                text,
                format_args!(
                    "triangle {{ <{ax}, 0, {ay}>, <{bx}, {a:.5}, {by}>, <{cx}, {b:.5}, {cy}> }} \
                     triangle {{ <{bx}, {a:.5}, {by}>, <{cx}, {b:.5}, {cy}>, <{dx}, 0, {dy}> }}"
                ),
            );
            x += 1.0;
        }
        y += 1.0;
    }
    add(
        text,
        format_args!("pigment {{ {color} }} rotate {turn:.2}*x rotate {turn:.2}*z }}"),
    );
}

fn ripples(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    for _ in 0..4 {
        let (point, size, turn) = (chance.point(1.0), chance.between(0.4, 1.2), chance.turn());
        let normal = ["bumps", "ripples", "waves", "wrinkles", "dents"][chance.below(5) as usize];
        let (deep, scale) = (chance.between(0.2, 1.0), chance.of_any_size(0.01, 0.4));
        let (color, size_of_phong) = (chance.color(0.1, 0.7), chance.of_any_size(20.0, 400.0));
        add(
            text,
            format_args!(
                "sphere {{ 0, {size:.3} pigment {{ {color} }} normal {{ {normal} {deep:.3} scale {scale:.4} }} \
                 finish {{ phong 0.7 phong_size {size_of_phong:.1} reflection 0.1 }} {turn} translate {point} }}"
            ),
        );
    }
}

fn shadows(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    text.push_str(&chance.light());
    let color = chance.color(0.5, 0.9);
    add(
        text,
        format_args!("plane {{ z, 1 pigment {{ {color} }} rotate <-20, 15, 0> }}"),
    );
    for _ in 0..14 {
        let (from, to, radius) = (
            chance.point(0.5),
            chance.point(0.5),
            chance.pixels(0.03, 1.0),
        );
        // Outside of the view, except for its shadow.
        let hidden = if chance.below(2) == 0 { "no_image" } else { "" };
        add(
            text,
            format_args!("cylinder {{ {from}, {to}, {radius:.5} pigment {{ rgb 0.3 }} {hidden} }}"),
        );
    }
}

fn panes(chance: &mut Chance, text: &mut String) {
    text.push_str(&chance.surroundings());
    for number in 0..7 {
        let (a, b) = (chance.point(0.0), chance.point(0.0));
        let (color, clear, turn) = (
            chance.color(0.1, 0.9),
            chance.between(0.2, 0.8),
            chance.between(0.0, 360.0),
        );
        let z = f64::from(number) * 0.2;
        add(
            text,
            format_args!(
                "box {{ <0, 0, 0>, <1.2, 0.9, 0.01> pigment {{ {color} transmit {clear:.3} }} rotate {turn:.2}*z \
                 translate {a}*<1, 1, 0> + {z:.2}*z no_shadow }} \
                 disc {{ {b}, z, 0.4, 0.38 pigment {{ {color} filter {clear:.3} }} }}"
            ),
        );
    }
}
