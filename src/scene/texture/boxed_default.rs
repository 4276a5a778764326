//! A boxed optional field for values that are rarely set.

/// A value that is stored on the heap only if it is not the default. Costs one pointer otherwise; a scene may have a
/// million owners.
#[derive(Clone, Debug, Default)]
pub struct BoxedDefault<T>(Option<Box<T>>);

impl<T: Default> BoxedDefault<T> {
    /// The value, or `None` for the default.
    #[must_use]
    pub fn get(&self) -> Option<&T> {
        self.0.as_deref()
    }

    /// The value for modification; allocates it if it is the default.
    pub fn get_mut(&mut self) -> &mut T {
        self.0.get_or_insert_default()
    }

    /// Applies `change`, which returns true if it has changed the value. A default value that stays unchanged is not
    /// allocated.
    ///
    /// # Errors
    /// The errors of `change`.
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
