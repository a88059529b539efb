//! The small forward renderer behind the contrejour command line.
