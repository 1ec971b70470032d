//! What every groomkit program shares: exit codes, Ctrl-C, progress.
