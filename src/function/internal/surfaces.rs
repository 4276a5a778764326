//! later
use super::Internal;
pub(super) static LIST: &[Internal] = &[Internal::new(61, "f_sphere", 1, |p| (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt() - p[3])];
