//! Values of identifiers and expressions.

use super::text::Text;
use crate::base::source::Diagnostic;
use crate::lang::frame::Macro;
use crate::scene::Object;
use rustc_hash::FxHashMap;
use std::any::{Any, TypeId};
use std::fmt;
use std::rc::Rc;
use std::sync::Arc;

/// A number, or a vector or colour of up to five components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number {
    /// The components; those from `len` on are zero.
    pub(crate) v: [f64; 5],
    /// Their number: 1 for a float, 2 to 4 for a vector, 5 for a colour.
    pub(crate) len: u8,
}

impl Number {
    /// A float.
    pub(crate) fn float(v: f64) -> Self {
        Number {
            v: [v, 0.0, 0.0, 0.0, 0.0],
            len: 1,
        }
    }

    /// 1 or 0.
    pub(crate) fn truth(v: bool) -> Self {
        Number::float(f64::from(u8::from(v)))
    }

    /// A vector of three.
    pub(crate) fn vector(v: glam::DVec3) -> Self {
        Number {
            v: [v.x, v.y, v.z, 0.0, 0.0],
            len: 3,
        }
    }

    /// The first three components.
    pub(crate) fn xyz(&self) -> glam::DVec3 {
        glam::DVec3::new(self.v[0], self.v[1], self.v[2])
    }

    /// The brightness of a colour.
    pub(crate) fn grey(&self) -> f64 {
        0.297 * self.v[0] + 0.589 * self.v[1] + 0.114 * self.v[2]
    }

    /// The same value with `len` components: a float is repeated, a shorter vector is filled with zeros.
    pub(crate) fn promoted(mut self, len: u8) -> Self {
        if self.len == 1 && len > 1 {
            let v = self.v[0];
            self.v[..usize::from(len)].fill(v);
        }
        self.len = self.len.max(len);
        self
    }

    /// Its kind in the author's words.
    pub(crate) fn kind(&self) -> &'static str {
        match self.len {
            1 => "a number",
            2 => "a vector of 2",
            3 => "a vector",
            4 => "a vector of 4",
            _ => "a colour",
        }
    }
}

/// Formats as a scene writes it.
impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<String> = self.v[..usize::from(self.len)]
            .iter()
            .map(|v| ((v * ROUNDED).round() / ROUNDED).to_string())
            .collect();
        match parts.as_slice() {
            [only] => f.write_str(only),
            parts => write!(f, "<{}>", parts.join(", ")),
        }
    }
}

/// Messages show numbers with six decimals.
const ROUNDED: f64 = 1e6;

/// The kind of strings, as [`Array::holds`] has it.
pub(crate) const STRING: &str = "a string";

/// A value of an identifier.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// A float, vector or colour.
    Number(Number),
    /// A text.
    Text(Text),
    /// A macro.
    Macro(Rc<Macro>),
    /// An array.
    Array(Rc<Array>),
    /// An object or CSG.
    Object(Arc<Object>),
    /// An open file, by its handle.
    File(usize),
    /// A texture, finish, camera, ...: anything that elements read by `args::declared`.
    Element(Element),
    /// The result of something that failed: using it fails without a further message, or, for an unsupported feature,
    /// with the message that its declaration withheld.
    Poison(Option<Rc<Diagnostic>>),
}

/// A scene element of an identifier.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    /// Its word: "texture", "finish".
    pub(crate) name: &'static str,
    /// The element itself.
    pub(crate) value: Arc<dyn Any + Send + Sync>,
}

impl Element {
    /// An element with its word.
    pub(crate) fn new<T: Any + Send + Sync>(name: &'static str, value: T) -> Self {
        Element {
            name,
            value: Arc::new(value),
        }
    }

    /// The Rust type of the element.
    pub(crate) fn kind(&self) -> TypeId {
        (*self.value).type_id()
    }
}

/// An array of one to five dimensions, row-major; or a dictionary, whose entries are the items of one dimension.
#[derive(Clone, Debug)]
pub(crate) struct Array {
    /// The sizes by dimension.
    pub(crate) sizes: Vec<usize>,
    /// The elements; `None` is not initialised.
    pub(crate) items: Vec<Option<Value>>,
    /// The kind of all elements, once one has been set. Mixed arrays have none.
    pub(crate) holds: Option<&'static str>,
    /// No item before this one has a value.
    begin: usize,
    /// True if elements may be of several kinds.
    pub(crate) is_mixed: bool,
    /// True once an element was an array for which [`Value::is_mixed`] holds.
    holds_mixed: bool,
    /// Access to items beyond the size.
    pub(crate) extent: Extent,
}

/// The way in which an array gets further items.
#[derive(Clone, Debug)]
pub(crate) enum Extent {
    /// It gets none.
    Fixed,
    /// An index beyond the end makes it longer.
    Growing,
    /// A dictionary: the index of the item of each key. Removed keys keep theirs.
    Keys(FxHashMap<Rc<str>, usize>),
}

impl Array {
    /// An array without any values.
    pub(crate) fn new(sizes: Vec<usize>) -> Self {
        Array {
            items: vec![None; sizes.iter().product()],
            sizes,
            begin: usize::MAX,
            holds: None,
            is_mixed: false,
            holds_mixed: false,
            extent: Extent::Fixed,
        }
    }

    /// A dictionary without entries.
    pub(crate) fn dictionary() -> Self {
        let mut array = Array::new(vec![0]);
        array.is_mixed = true;
        array.extent = Extent::Keys(FxHashMap::default());
        array
    }

    /// True for a dictionary.
    pub(crate) fn is_dictionary(&self) -> bool {
        matches!(self.extent, Extent::Keys(_))
    }

    /// The index of the item with a key of a dictionary.
    pub(crate) fn index_of(&self, key: &str) -> Option<usize> {
        match &self.extent {
            Extent::Keys(keys) => keys.get(key).copied(),
            Extent::Fixed | Extent::Growing => None,
        }
    }

    /// The same; a new key gets an item without a value.
    pub(crate) fn index_for(&mut self, key: &str) -> usize {
        let next = self.items.len();
        if let Extent::Keys(keys) = &mut self.extent {
            if let Some(&known) = keys.get(key) {
                return known;
            }
            keys.insert(key.into(), next);
            self.grow(next + 1);
        }
        next
    }

    /// The first item that has a value.
    pub(crate) fn first(&self) -> Option<&Value> {
        self.values().next()
    }

    /// True if the items, which are all of one kind, are elements of this Rust type.
    pub(crate) fn holds_elements(&self, kind: TypeId) -> bool {
        let read = |value: &&Value| !matches!(value, Value::Poison(_));
        self.values()
            .find(read)
            .is_some_and(|value| value.is_element(kind))
    }

    /// The items that have a value.
    fn values(&self) -> impl Iterator<Item = &Value> {
        let items = self.items.get(self.begin..).unwrap_or_default();
        items.iter().flatten()
    }

    /// Makes an array of one dimension at least this long.
    pub(crate) fn grow(&mut self, size: usize) {
        if size > self.items.len() {
            self.items.resize(size, None);
            self.sizes[0] = size;
        }
    }

    /// Sets an item; if the items are of another kind, returns that kind and changes nothing.
    pub(crate) fn set(&mut self, at: usize, value: Value) -> Option<&'static str> {
        if !self.is_mixed {
            let sort = value.sort();
            if let (Some(sort), Some(holds)) = (sort, self.holds)
                && sort != holds
            {
                return Some(holds);
            }
            self.holds = self.holds.or(sort);
        }
        self.holds_mixed |= value.is_mixed();
        *self.items.get_mut(at)? = Some(value);
        self.begin = self.begin.min(at);
        None
    }
}

/// Arrays may be nested as deep as a loop makes them, and the stack of the dropping thread may be small.
impl Drop for Array {
    fn drop(&mut self) {
        let mut open = std::mem::take(&mut self.items);
        while let Some(item) = open.pop() {
            if let Some(Value::Array(array)) = item
                && let Ok(mut last) = Rc::try_unwrap(array)
            {
                open.append(&mut last.items);
            }
        }
    }
}

impl Value {
    /// The item of an array, or of nested arrays, by the indices from the outermost on.
    pub(crate) fn item(&self, path: &[usize]) -> Option<&Value> {
        path.iter().try_fold(self, |value, &at| match value {
            Value::Array(array) => array.items.get(at)?.as_ref(),
            _ => None,
        })
    }

    /// An item, for changes; arrays on the path that are shared with other names are copied.
    pub(crate) fn item_mut(&mut self, path: &[usize]) -> Option<&mut Option<Value>> {
        let (&first, rest) = path.split_first()?;
        let Value::Array(array) = self else {
            return None;
        };
        let item = Rc::make_mut(array).items.get_mut(first)?;
        if rest.is_empty() {
            return Some(item);
        }
        item.as_mut()?.item_mut(rest)
    }

    /// Assigns an item of an array; if the items are of another kind, returns that kind and changes nothing.
    pub(crate) fn put(&mut self, path: &[usize], value: Value) -> Option<&'static str> {
        let (&first, rest) = path.split_first()?;
        let Value::Array(array) = self else {
            return None;
        };
        let array = Rc::make_mut(array);
        if !rest.is_empty() {
            let inner = array.items.get_mut(first)?.as_mut()?;
            let others = inner.put(rest, value);
            array.holds_mixed |= inner.is_mixed();
            return others;
        }
        array.set(first, value)
    }

    /// An array or one within it, for changes; those on the path that are shared with other names are copied.
    pub(crate) fn array_mut(&mut self, path: &[usize]) -> Option<&mut Array> {
        let held = match path {
            [] => self,
            path => self.item_mut(path)?.as_mut()?,
        };
        match held {
            Value::Array(array) => Some(Rc::make_mut(array)),
            _ => None,
        }
    }

    /// True for an array whose items, or those of arrays that are or were in it, may be of several kinds.
    pub(crate) fn is_mixed(&self) -> bool {
        matches!(self, Value::Array(array) if array.is_mixed || array.holds_mixed)
    }

    /// Number of items that [`Value::item_mut`] copies.
    pub(crate) fn copied_by(&self, path: &[usize]) -> usize {
        let Value::Array(array) = self else {
            return 0;
        };
        let own = if Rc::strong_count(array) > 1 {
            array.items.len()
        } else {
            0
        };
        let item = path.first().and_then(|&at| array.items.get(at)?.as_ref());
        own + item.map_or(0, |item| item.copied_by(&path[1..]))
    }

    /// Its kind for arrays, whose items are all of one kind; `None` for a value that could not be read.
    pub(crate) fn sort(&self) -> Option<&'static str> {
        Some(match self {
            Value::Number(n) => n.kind(),
            Value::Text(_) => STRING,
            Value::Macro(_) => "a macro",
            Value::Array(array) if array.is_dictionary() => "a dictionary",
            Value::Array(_) => "an array",
            Value::Object(_) => "an object",
            Value::Element(e) => e.name,
            Value::File(_) => "an open file",
            Value::Poison(_) => return None,
        })
    }

    /// True if it is an element of this Rust type.
    pub(crate) fn is_element(&self, kind: TypeId) -> bool {
        matches!(self, Value::Element(element) if element.kind() == kind)
    }

    /// Its kind in the author's words, with an article.
    pub(crate) fn kind(&self) -> String {
        match self {
            Value::Number(n) => n.kind().to_owned(),
            Value::Text(_) => "a string".to_owned(),
            Value::Macro(_) => "a macro".to_owned(),
            Value::Array(array) if array.is_dictionary() => "a dictionary".to_owned(),
            Value::Array(_) => "an array".to_owned(),
            Value::Object(_) => "an object".to_owned(),
            Value::Element(e) => format!("a {}", e.name),
            Value::File(_) => "an open file".to_owned(),
            Value::Poison(_) => "a value that could not be read".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(items: usize) -> Array {
        Array::new(vec![items])
    }

    #[test]
    fn an_array_is_mixed_once_one_in_it_is() {
        let mut mixed = array(1);
        mixed.is_mixed = true;
        let mut inner = array(2);
        inner.set(0, Value::Array(Rc::new(array(1))));
        let mut outer = array(1);
        outer.set(0, Value::Array(Rc::new(inner)));
        let mut outer = Value::Array(Rc::new(outer));
        assert!(!outer.is_mixed());
        assert_eq!(outer.put(&[0, 1], Value::Array(Rc::new(mixed))), None);
        assert!(outer.is_mixed());
    }

    #[test]
    fn the_first_value_may_be_set_last_and_removed() {
        let text = |array: &Array| match array.first() {
            Some(Value::Text(text)) => text.letters().to_owned(),
            _ => String::new(),
        };
        let mut array = array(3);
        assert_eq!(text(&array), "");
        for (at, value) in [(2, "last"), (1, "middle")] {
            assert_eq!(array.set(at, Value::Text(value.into())), None);
            assert_eq!(text(&array), value);
        }
        let mut held = Value::Array(Rc::new(array));
        *held.item_mut(&[1]).unwrap() = None;
        assert_eq!(text(held.array_mut(&[]).unwrap()), "last");
    }
}
