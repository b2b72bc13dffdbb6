//! Friction at a contact: modes and path, scenes, messages, comparison of laws.

#[path = "friction/modes.rs"]
mod modes;
#[path = "friction/scenes.rs"]
mod scenes;
#[path = "friction/surd.rs"]
mod surd;
