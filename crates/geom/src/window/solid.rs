//! Solid windows.
