//! Friction at a contact: modes and path, scenes, messages, comparison of laws.

#[path = "friction/modes.rs"]
mod modes;
#[path = "friction/surd.rs"]
mod surd;
