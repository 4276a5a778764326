//! What few of very many things have.

/// A value that mostly is the default one, and then takes no room. There may be a million of its owners.
#[derive(Clone, Debug, Default)]
pub struct Rare<T>(Option<Box<T>>);

impl<T: Default> Rare<T> {
    /// The value, unless it is the default one.
    #[must_use]
    pub fn get(&self) -> Option<&T> {
        self.0.as_deref()
    }

    /// The value, to be changed.
    pub fn get_mut(&mut self) -> &mut T {
        self.0.get_or_insert_default()
    }

    /// Lets `change` change the value, if it says that it has.
    ///
    /// # Errors
    /// Those of `change`.
    pub fn change<E>(&mut self, change: impl FnOnce(&mut T) -> Result<bool, E>) -> Result<bool, E> {
        if let Some(value) = &mut self.0 {
            return change(value);
        }
        let mut value = T::default();
        let is_changed = change(&mut value)?;
        if is_changed {
            self.0 = Some(Box::new(value));
        }
        Ok(is_changed)
    }
}
