//! Scripted turntables from YAML: steps, staleness, frames, contact sheets.
