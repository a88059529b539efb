//! The CPU twin of every compute stage of contrejour.
