//! `texture`: layers of pigment, normal and finish, and changes to them by later parts of a scene.

use super::version_2::FIRST_WITH_BLOCKS;
use super::{Finish, Normal, Patterned, PatternedKind, Pigment, PigmentKind, PreparedTexture};
use crate::base::args::{Args, Parse, Word, declared, interned, transform_step};
use crate::base::color::{Color, Rgb};
use crate::base::math::Step;
use crate::scene::pattern::{NormalTransforms, Settings};
use smallvec::SmallVec;
use std::sync::Arc;

/// The last language version in which upper layers transmit unfiltered the light that they would filter.
const LAST_WITHOUT_FILTER: f64 = 3.1;

/// Limit on the layers: textures that contain themselves twice double their layers at each declaration.
const MAX_LAYERS: usize = 100_000;

/// One layer of a texture: colour, reflection properties and bumps.
#[derive(Clone, Debug, Default)]
pub struct Layer {
    /// The colour.
    pub pigment: Pigment,
    /// The reflection properties.
    pub finish: Arc<Finish>,
    /// Bumps.
    pub normal: Option<Arc<Normal>>,
    /// `no_bump_scale` in the texture itself. Holds for the normal that the layer has at the end of the block.
    pub has_no_bump_scale: bool,
}

impl Layer {
    /// The default layer from version 3.8 on: white, without ambient light.
    #[must_use]
    pub fn of_3_8() -> Layer {
        let finish = Finish {
            ambient: Rgb::BLACK,
            ..Finish::default()
        };
        Layer {
            pigment: Pigment::plain(Color::opaque(Rgb::splat(1.0))),
            finish: Arc::new(finish),
            ..Layer::default()
        }
    }
}

/// The appearance of a surface: layers, the lowest first, at least one.
#[derive(Clone, Debug)]
pub struct Texture {
    layers: SmallVec<[Layer; 1]>,
    /// The pattern that selects among textures, if any. The single layer is unused then.
    pub(super) pattern: Option<Box<Patterned>>,
}

impl From<Layer> for Texture {
    fn from(layer: Layer) -> Self {
        Texture {
            layers: SmallVec::from_buf([layer]),
            pattern: None,
        }
    }
}

impl Layer {
    /// Reads `pigment`, `normal` or `finish` with its block into this layer if `word`, the next token, is one of them;
    /// false otherwise. Values that the block does not set stay as they are.
    ///
    /// # Errors
    /// A malformed block, or an unsupported keyword.
    pub fn read_part(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::Pigment => {
                args.accept(word)?;
                self.pigment = Pigment::read(args, &self.pigment)?;
            }
            Word::Finish => {
                args.accept(word)?;
                let finish = Finish::read(args, &self.finish)?;
                self.finish = interned(args, finish);
            }
            Word::Normal => {
                args.accept(word)?;
                self.normal = Some(Normal::read(args, self.normal.as_ref())?);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Reads the name of a pigment, normal or finish without its word; false for another token.
    fn read_named(&mut self, args: &mut dyn Args) -> Parse<bool> {
        if let Some(pigment) = declared::<Pigment>(args)? {
            self.pigment = (*pigment).clone();
        } else if let Some(normal) = declared::<Arc<Normal>>(args)? {
            self.normal = Some(Arc::clone(&normal));
        } else if let Some(finish) = declared::<Finish>(args)? {
            self.finish = finish;
        } else {
            return Ok(false);
        }
        Ok(true)
    }

    /// A layer of one colour and a finish.
    #[must_use]
    pub(crate) fn colored(color: Color, finish: Arc<Finish>) -> Layer {
        Layer {
            pigment: Pigment::plain(color),
            finish,
            normal: None,
            has_no_bump_scale: false,
        }
    }

    /// The layer as the default of later textures. `no_bump_scale` stays with the normal, if there is one
    /// (measured with POV-Ray).
    #[must_use]
    pub(crate) fn into_default(mut self) -> Layer {
        if std::mem::take(&mut self.has_no_bump_scale)
            && let Some(normal) = &mut self.normal
        {
            Arc::make_mut(normal).has_no_bump_scale = true;
        }
        self
    }

    /// True if the layer has a pigment without modifiers, a finish, and nothing else.
    #[must_use]
    pub(crate) fn is_bare(&self) -> bool {
        self.normal.is_none() && self.pigment.is_bare()
    }

    /// Transforms the layer. A pigment that is set later is transformed too, as in POV-Ray.
    pub fn transform(&mut self, step: &Step) {
        self.pigment.transform(step);
        if let Some(normal) = &mut self.normal {
            Arc::make_mut(normal).transform(step);
        }
    }
}

impl Texture {
    /// Reads a texture block. Parts that the block does not set are those of `default`.
    ///
    /// Parts after the name of a layered texture change its top layer; transforms apply to all its layers.
    ///
    /// # Errors
    /// A malformed value, or an unsupported keyword.
    pub fn read(args: &mut dyn Args, default: &Layer) -> Parse<Texture> {
        args.open()?;
        let mut texture = Texture::begin(args, default)?;
        while !args.accept_close()? {
            if !texture.read_item(args, default)? {
                return Err(args.expected(match texture.pattern {
                    Some(_) => "`texture_map`, a modifier of the pattern or `}` in `texture`",
                    None => "`pigment`, `normal`, `finish` or `}` in `texture`",
                }));
            }
        }
        texture.checked(args)
    }

    /// Reads a transform, a part of the top layer, or a modifier of the pattern; false if none is next. Before version 3
    /// the name of a texture replaces all that precedes it.
    pub(super) fn read_item(&mut self, args: &mut dyn Args, default: &Layer) -> Parse<bool> {
        if let Some(pattern) = &mut self.pattern {
            return pattern.read_item(args, default);
        }
        if let Some(step) = transform_step(args)? {
            self.transform(&step);
            return Ok(true);
        }
        match args.word()? {
            Some(Word::NoBumpScale) => {
                self.top_mut().has_no_bump_scale = args.accept(Word::NoBumpScale)?;
                Ok(true)
            }
            Some(word) => {
                let layer = self.top_mut();
                Ok(layer.read_part(word, args)? || layer.read_old(args)?)
            }
            None => {
                if args.version() < FIRST_WITH_BLOCKS
                    && let Some(known) = declared::<Texture>(args)?
                {
                    *self = Texture::clone(&known);
                    return Ok(true);
                }
                let layer = self.top_mut();
                Ok(layer.read_named(args)? || layer.read_old(args)?)
            }
        }
    }

    /// Completes the texture; an error if a required part is missing.
    pub(super) fn checked(mut self, args: &mut dyn Args) -> Parse<Texture> {
        if let Some(pattern) = &mut self.pattern {
            pattern.check(args)?;
            pattern.spread_no_bump_scale();
        }
        Ok(self)
    }

    /// Sets `no_bump_scale` on the top layer, or on the pattern and the textures that it selects from.
    pub(super) fn set_no_bump_scale(&mut self) {
        match &mut self.pattern {
            Some(pattern) => {
                pattern.has_no_bump_scale = true;
                pattern.spread_no_bump_scale();
            }
            None => self.top_mut().has_no_bump_scale = true,
        }
    }

    /// True if a pattern selects among textures.
    #[must_use]
    pub fn is_patterned(&self) -> bool {
        self.pattern.is_some()
    }

    /// The pattern that selects among textures, if there is one.
    #[must_use]
    pub fn pattern(&self) -> Option<&Patterned> {
        self.pattern.as_deref()
    }

    /// The layers, the lowest first.
    #[must_use]
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// True if a finish has values that belong in the interior since version 3.1.
    pub(crate) fn has_interior_finish(&self) -> bool {
        self.layers.iter().any(|layer| layer.finish.has_interior())
    }

    /// The colour and the finish of a texture that has nothing else.
    #[must_use]
    pub(crate) fn bare(&self) -> Option<(Color, &Arc<Finish>)> {
        match (&*self.layers, &self.pattern) {
            ([layer], None) if layer.is_bare() => match layer.pigment.kind {
                PigmentKind::Plain(color) => Some((color, &layer.finish)),
                _ => None,
            },
            _ => None,
        }
    }

    /// The top layer, declared last, which parts outside of a texture block change.
    pub fn top_mut(&mut self) -> &mut Layer {
        self.layers.last_mut().expect("a texture has a layer")
    }

    /// This texture with one colour as the pigment of its top layer.
    #[must_use]
    pub fn with_color(&self, color: Color) -> Texture {
        let mut texture = self.clone();
        texture.top_mut().pigment = Pigment::plain(color);
        texture
    }

    /// The reason why another texture cannot be layered over this one, if there is one.
    #[must_use]
    pub fn layering_error(&self, upper: &Texture) -> Option<String> {
        if self.is_patterned() || upper.is_patterned() {
            return Some("a texture chosen by a pattern cannot be a layer of another".to_owned());
        }
        let has_too_many = self.layers.len() + upper.layers.len() > MAX_LAYERS;
        has_too_many.then(|| format!("a texture has at most {MAX_LAYERS} layers"))
    }

    /// Layers another texture over this one. In versions up to 3.1 the upper layers transmit instead of filtering.
    pub fn lay_over(&mut self, upper: Texture, version: f64) {
        let first = self.layers.len();
        self.layers.extend(upper.layers);
        self.transmit_from(first, version);
    }

    /// The texture as the lowest of an object's, a material's or a declared one's. In versions up to 3.1 its upper
    /// layers transmit instead of filtering, also where a later version declared them.
    #[must_use]
    pub fn as_lowest(mut self, version: f64) -> Texture {
        self.transmit_from(1, version);
        self
    }

    fn transmit_from(&mut self, first: usize, version: f64) {
        if version <= LAST_WITHOUT_FILTER {
            let upper = self.layers.iter_mut().skip(first);
            upper.for_each(|layer| layer.pigment.filter_to_transmit());
        }
    }

    /// Transforms all layers.
    pub fn transform(&mut self, step: &Step) {
        for layer in &mut self.layers {
            layer.transform(step);
        }
        if let Some(pattern) = &mut self.pattern {
            pattern.transform(step);
        }
    }

    /// True if the texture depends on position, so that a transform may change it.
    #[must_use]
    pub fn depends_on_position(&self) -> bool {
        self.pattern.is_some()
            || self.layers.iter().any(|layer| {
                layer.normal.is_some() || !matches!(layer.pigment.kind, PigmentKind::Plain(_))
            })
    }

    /// True if it depends on the texture coordinates of the surface.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        match &self.pattern {
            None => self.layers.iter().any(|layer| {
                let normal = layer.normal.as_ref();
                layer.pigment.uses_uv() || normal.is_some_and(|normal| normal.uses_uv())
            }),
            Some(pattern) => {
                matches!(pattern.kind, PatternedKind::Uv(_))
                    || pattern.textures().into_iter().any(Texture::uses_uv)
            }
        }
    }

    /// Prepares the texture for rendering. The transforms of the object, `after`, follow those of the texture.
    #[must_use]
    pub fn prepare(&self, after: &[Step], settings: &Settings) -> PreparedTexture {
        PreparedTexture::new(self, after, &NormalTransforms::default(), settings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;
    use crate::base::color::Rgb;
    use glam::DVec3;

    fn read_with(args: &mut TextArgs) -> Parse<Texture> {
        Texture::read(args, &Layer::default())
    }

    fn read(text: &str) -> Texture {
        read_with(&mut TextArgs::new(text)).unwrap()
    }

    fn color(layer: &Layer) -> Color {
        match layer.pigment.kind {
            PigmentKind::Plain(color) => color,
            _ => panic!("the pigment is plain"),
        }
    }

    fn glass(filter: f64) -> Texture {
        let color = Color::from_components([1.0, 1.0, 1.0, filter, 0.0]);
        Texture::from(Layer {
            pigment: Pigment::plain(color),
            ..Layer::default()
        })
    }

    #[test]
    fn a_texture_without_pigment_has_the_default_pigment() {
        let default = glass(0.25).layers()[0].clone();
        let mut args = TextArgs::new("{ finish { phong 1 } }");
        let texture = Texture::read(&mut args, &default).unwrap();
        assert_eq!(color(&texture.layers()[0]).filter, 0.25);
        assert_eq!(texture.layers()[0].finish.phong, 1.0);
    }

    #[test]
    fn parts_after_a_name_change_the_top_layer() {
        let mut known = glass(0.0);
        known.lay_over(glass(0.5), 3.7);
        let mut args = TextArgs::new("{ T finish { ambient 0.75 } }").with("T", known);
        let texture = read_with(&mut args).unwrap();
        assert_eq!(texture.layers()[0].finish.ambient, Rgb::splat(0.1));
        assert_eq!(texture.layers()[1].finish.ambient, Rgb::splat(0.75));
    }

    #[test]
    fn a_pigment_after_a_transform_is_transformed_too() {
        // In POV-Ray 3.7 both translations apply to the second pigment of
        // `pigment { checker ... translate .5 } translate x pigment { ... }`.
        let texture = read("{ pigment { checker translate 1 } scale 2 pigment { hexagon } }");
        let expected = [Step::Translate(DVec3::ONE), Step::Scale(DVec3::splat(2.0))];
        assert_eq!(
            texture.layers()[0]
                .pigment
                .modifiers
                .get()
                .unwrap()
                .chain
                .steps(),
            expected
        );
    }

    #[test]
    fn upper_layers_do_not_filter_up_to_version_3_1() {
        let mut old = glass(0.5);
        old.lay_over(glass(0.5), 3.1);
        let through: Vec<_> = old.layers().iter().map(color).collect();
        assert_eq!((through[0].filter, through[0].transmit), (0.5, 0.0));
        assert_eq!((through[1].filter, through[1].transmit), (0.0, 0.5));
        let mut new = glass(0.5);
        new.lay_over(glass(0.5), 3.5);
        assert_eq!(color(&new.layers()[1]).filter, 0.5);
    }
}
