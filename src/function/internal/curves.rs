//! later
use super::Internal;
pub(super) static LIST: &[Internal] = &[];
