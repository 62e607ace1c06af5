// What a program that writes pictures must know about output files.
#pragma once

namespace laterna {

/// Outputs are written beside their target and renamed into place when complete. A program that is
/// interrupted calls this from its signal handler, before it ends the process, so that no half-written file
/// stays behind: it unlinks every temporary file that this process has not yet renamed. Async-signal-safe; a
/// call that races with the end of a write leaves either no file or the whole file. Writes still in progress
/// then fail. The library itself installs no signal handlers.
void remove_pending_outputs() noexcept;

}  // namespace laterna
