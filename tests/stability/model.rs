//! Small scenes as data: written as scene files for the renderers, and evaluated directly by the oracle.

use std::fmt::Write as _;

/// Three numbers.
pub(crate) type V = [f64; 3];

/// A scene in flat colours: visible surfaces, and whether they are lit.
#[derive(Clone, Debug)]
pub(crate) struct Model {
    pub(crate) camera: Camera,
    pub(crate) objects: Vec<Object>,
    /// The position of the light; without one everything has its full colour.
    pub(crate) light: Option<V>,
    /// Width and height of the picture.
    pub(crate) size: (u32, u32),
    /// Margin around a pixel's centre in which its answer must be the same, in pixels: the accuracy of the scene's own
    /// numbers.
    pub(crate) margin: f64,
}

/// A perspective view, or with `is_flat` an orthographic one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    pub(crate) location: V,
    pub(crate) direction: V,
    pub(crate) right: V,
    pub(crate) up: V,
    pub(crate) is_flat: bool,
}

/// An object, or a CSG combination of objects.
#[derive(Clone, Debug)]
pub(crate) struct Object {
    pub(crate) kind: Kind,
    pub(crate) steps: Vec<Step>,
    /// Red, green, blue; the parent's where there is none.
    pub(crate) color: Option<V>,
}

#[derive(Clone, Debug)]
pub(crate) enum Kind {
    Sphere(V, f64),
    Box(V, V),
    Cylinder(V, V, f64),
    Cone(V, f64, V, f64),
    Torus(f64, f64),
    Plane(V, f64),
    /// The ten numbers of `quadric`.
    Quadric([f64; 10]),
    /// The 35 numbers of `quartic`.
    Quartic(Box<[f64; 35]>),
    /// A superellipsoid with `e = n = 2 / power`.
    Superellipsoid(u32),
    /// A `blob` of one component of radius and strength 1, with this threshold.
    Blob(f64),
    Csg(&'static str, Vec<Object>),
}

/// A transform; `Matrix` has the twelve numbers of `matrix`.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    Translate(V),
    Scale(V),
    Rotate(V),
    Matrix([f64; 12]),
}

/// The default colour.
pub(crate) const WHITE: V = [1.0, 1.0, 1.0];
pub(crate) const RED: V = [1.0, 0.0, 0.0];
pub(crate) const GREEN: V = [0.0, 1.0, 0.0];
pub(crate) const BLUE: V = [0.0, 0.0, 1.0];

/// Factor of the colour of a point in shadow.
pub(crate) const SHADE: f64 = 0.4;

/// The usual size of a picture.
pub(crate) const SIZE: (u32, u32) = (48, 36);

/// The usual margin: a millionth of a pixel.
pub(crate) const MARGIN: f64 = 1e-6;

impl Camera {
    /// A view along +z from `location`, with a window of this width at distance 1.
    pub(crate) fn ahead(location: V, width: f64) -> Camera {
        Camera {
            location,
            direction: [0.0, 0.0, 1.0],
            right: [width, 0.0, 0.0],
            up: [0.0, 0.75 * width, 0.0],
            is_flat: false,
        }
    }

    /// A view from one point to another, with y up.
    pub(crate) fn at(location: V, target: V, width: f64) -> Camera {
        let to = [0, 1, 2].map(|i| target[i] - location[i]);
        let length = to[0].hypot(to[1]).hypot(to[2]);
        let direction = to.map(|x| x / length);
        let across = direction[0].hypot(direction[2]);
        let right = [direction[2] / across, 0.0, -direction[0] / across];
        let up = [
            direction[1] * right[2] - direction[2] * right[1],
            direction[2] * right[0] - direction[0] * right[2],
            direction[0] * right[1] - direction[1] * right[0],
        ];
        Camera {
            location,
            direction,
            right: right.map(|x| x * width),
            up: up.map(|x| x * 0.75 * width),
            is_flat: false,
        }
    }

    fn scaled(&self, by: f64) -> Camera {
        let times = |v: V| v.map(|x| x * by);
        // A window and its distance scaled alike show the same.
        Camera {
            location: times(self.location),
            direction: times(self.direction),
            right: times(self.right),
            up: times(self.up),
            is_flat: self.is_flat,
        }
    }
}

impl Model {
    /// A lit scene.
    pub(crate) fn lit(camera: Camera, light: V, objects: Vec<Object>) -> Model {
        Model {
            light: Some(light),
            ..Model::flat(camera, objects)
        }
    }

    /// A scene without light: only visibility matters.
    pub(crate) fn flat(camera: Camera, objects: Vec<Object>) -> Model {
        Model {
            camera,
            objects,
            light: None,
            size: SIZE,
            margin: MARGIN,
        }
    }

    pub(crate) fn with_margin(self, margin: f64) -> Model {
        Model { margin, ..self }
    }

    /// Scales every length, in the numbers of the shapes, not by a transform.
    pub(crate) fn scaled(&self, by: f64) -> Model {
        Model {
            camera: self.camera.scaled(by),
            objects: self.objects.iter().map(|o| o.scaled(by)).collect(),
            light: self.light.map(|v| v.map(|x| x * by)),
            ..self.clone()
        }
    }

    /// Everything moved.
    pub(crate) fn moved(&self, by: V) -> Model {
        let plus = |v: V| [0, 1, 2].map(|i| v[i] + by[i]);
        let mut moved = self.clone();
        moved.camera.location = plus(self.camera.location);
        moved.light = self.light.map(plus);
        for object in &mut moved.objects {
            object.steps.push(Step::Translate(by));
        }
        moved
    }

    /// Moves everything, in the numbers of the shapes where they hold points. Objects may have translations only.
    pub(crate) fn moved_in_numbers(&self, by: V) -> Model {
        let objects = self.objects.iter().map(|object| object.written_at(by));
        Model {
            objects: objects.collect(),
            ..self.moved(by)
        }
    }

    /// The scene file.
    pub(crate) fn text(&self) -> String {
        let camera = &self.camera;
        let kind = if camera.is_flat { "orthographic " } else { "" };
        let mut text = format!(
            "#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\ncamera {{ {kind}location {} direction {} right {} up {} }}\n",
            v(camera.location),
            v(camera.direction),
            v(camera.right),
            v(camera.up)
        );
        if let Some(light) = self.light {
            let _ = writeln!(text, "light_source {{ {}, rgb 1 }}", v(light));
        }
        let finish = if self.light.is_some() {
            format!("ambient {SHADE} diffuse {} brilliance 0", 1.0 - SHADE)
        } else {
            "ambient 1 diffuse 0".to_owned()
        };
        let _ = writeln!(text, "#default {{ finish {{ {finish} }} }}");
        for object in &self.objects {
            object.write(&mut text, Some(object.color.unwrap_or(WHITE)));
            text.push('\n');
        }
        text
    }
}

impl Object {
    pub(crate) fn new(kind: Kind) -> Object {
        Object {
            kind,
            steps: Vec::new(),
            color: None,
        }
    }

    pub(crate) fn colored(self, color: V) -> Object {
        Object {
            color: Some(color),
            ..self
        }
    }

    pub(crate) fn step(mut self, step: Step) -> Object {
        self.steps.push(step);
        self
    }

    pub(crate) fn translate(self, by: V) -> Object {
        self.step(Step::Translate(by))
    }

    pub(crate) fn scale(self, by: V) -> Object {
        self.step(Step::Scale(by))
    }

    pub(crate) fn rotate(self, by: V) -> Object {
        self.step(Step::Rotate(by))
    }

    fn scaled(&self, by: f64) -> Object {
        let times = |v: &V| v.map(|x| x * by);
        let kind = match &self.kind {
            Kind::Sphere(c, r) => Kind::Sphere(times(c), r * by),
            Kind::Box(a, b) => Kind::Box(times(a), times(b)),
            Kind::Cylinder(a, b, r) => Kind::Cylinder(times(a), times(b), r * by),
            Kind::Cone(a, ra, b, rb) => Kind::Cone(times(a), ra * by, times(b), rb * by),
            Kind::Torus(major, minor) => Kind::Torus(major * by, minor * by),
            Kind::Plane(n, d) => Kind::Plane(*n, d * by),
            Kind::Csg(word, parts) => Kind::Csg(word, parts.iter().map(|o| o.scaled(by)).collect()),
            // Their numbers are no lengths.
            own @ (Kind::Quadric(_)
            | Kind::Quartic(_)
            | Kind::Superellipsoid(_)
            | Kind::Blob(_)) => own.clone(),
        };
        let mut steps: Vec<Step> = Vec::new();
        if matches!(
            self.kind,
            Kind::Quadric(_) | Kind::Quartic(_) | Kind::Superellipsoid(_) | Kind::Blob(_)
        ) {
            steps.push(Step::Scale([by; 3]));
        }
        steps.extend(self.steps.iter().map(|step| match step {
            Step::Translate(to) => Step::Translate(times(to)),
            Step::Matrix(m) => {
                let mut m = *m;
                m[9..].iter_mut().for_each(|x| *x *= by);
                Step::Matrix(m)
            }
            other => other.clone(),
        }));
        Object {
            kind,
            steps,
            color: self.color,
        }
    }

    fn written_at(&self, by: V) -> Object {
        let plus = |v: &V| [0, 1, 2].map(|i| v[i] + by[i]);
        let kind = match &self.kind {
            Kind::Sphere(c, r) => Kind::Sphere(plus(c), *r),
            Kind::Box(a, b) => Kind::Box(plus(a), plus(b)),
            Kind::Cylinder(a, b, r) => Kind::Cylinder(plus(a), plus(b), *r),
            Kind::Cone(a, ra, b, rb) => Kind::Cone(plus(a), *ra, plus(b), *rb),
            Kind::Plane(n, d) => Kind::Plane(*n, d + n[0] * by[0] + n[1] * by[1] + n[2] * by[2]),
            Kind::Csg(word, parts) => {
                Kind::Csg(word, parts.iter().map(|o| o.written_at(by)).collect())
            }
            _ => return self.clone().translate(by),
        };
        Object {
            kind,
            ..self.clone()
        }
    }

    fn write(&self, text: &mut String, color: Option<V>) {
        let numbers = |all: &[f64]| all.iter().map(|x| n(*x)).collect::<Vec<_>>().join(", ");
        let _ = match &self.kind {
            Kind::Sphere(c, r) => write!(text, "sphere {{ {}, {}", v(*c), n(*r)),
            Kind::Box(a, b) => write!(text, "box {{ {}, {}", v(*a), v(*b)),
            Kind::Cylinder(a, b, r) => write!(text, "cylinder {{ {}, {}, {}", v(*a), v(*b), n(*r)),
            Kind::Cone(a, ra, b, rb) => {
                write!(text, "cone {{ {}, {}, {}, {}", v(*a), n(*ra), v(*b), n(*rb))
            }
            Kind::Torus(major, minor) => write!(text, "torus {{ {}, {}", n(*major), n(*minor)),
            Kind::Plane(normal, d) => write!(text, "plane {{ {}, {}", v(*normal), n(*d)),
            Kind::Quadric(q) => write!(
                text,
                "quadric {{ <{}>, <{}>, <{}>, {}",
                numbers(&q[..3]),
                numbers(&q[3..6]),
                numbers(&q[6..9]),
                n(q[9])
            ),
            Kind::Quartic(c) => write!(text, "quartic {{ <{}>", numbers(&c[..])),
            Kind::Superellipsoid(power) => {
                let e = n(2.0 / f64::from(*power));
                write!(text, "superellipsoid {{ <{e}, {e}>")
            }
            Kind::Blob(threshold) => write!(
                text,
                "blob {{ threshold {} sphere {{ 0, 1, 1 }}",
                n(*threshold)
            ),
            Kind::Csg(word, parts) => {
                let _ = write!(text, "{word} {{");
                for part in parts {
                    text.push(' ');
                    part.write(text, part.color);
                }
                Ok(())
            }
        };
        if let Some(c) = color {
            let _ = write!(text, " pigment {{ rgb {} }}", v(c));
        }
        for step in &self.steps {
            let _ = match step {
                Step::Translate(by) => write!(text, " translate {}", v(*by)),
                Step::Scale(by) => write!(text, " scale {}", v(*by)),
                Step::Rotate(by) => write!(text, " rotate {}", v(*by)),
                Step::Matrix(m) => write!(text, " matrix <{}>", numbers(m)),
            };
        }
        text.push_str(" }");
    }
}

/// A number that reads back as itself.
pub(crate) fn n(x: f64) -> String {
    format!("{x:e}")
}

/// A vector that reads back as itself.
pub(crate) fn v(v: V) -> String {
    format!("<{}, {}, {}>", n(v[0]), n(v[1]), n(v[2]))
}

pub(crate) fn sphere(centre: V, radius: f64) -> Object {
    Object::new(Kind::Sphere(centre, radius))
}

pub(crate) fn cuboid(a: V, b: V) -> Object {
    Object::new(Kind::Box(a, b))
}

pub(crate) fn cylinder(a: V, b: V, radius: f64) -> Object {
    Object::new(Kind::Cylinder(a, b, radius))
}

pub(crate) fn cone(a: V, ra: f64, b: V, rb: f64) -> Object {
    Object::new(Kind::Cone(a, ra, b, rb))
}

pub(crate) fn torus(major: f64, minor: f64) -> Object {
    Object::new(Kind::Torus(major, minor))
}

pub(crate) fn plane(normal: V, distance: f64) -> Object {
    Object::new(Kind::Plane(normal, distance))
}

pub(crate) fn csg(word: &'static str, parts: Vec<Object>) -> Object {
    Object::new(Kind::Csg(word, parts))
}
