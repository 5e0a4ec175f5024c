#pragma once
// What every command of `gyre` has in common: how it is added to the command line, and what it answers to the shell.

namespace gyre::ground {

inline constexpr int kExitOk = 0;
inline constexpr int kExitRefused = 1;   ///< a mission is refused, or something failed
inline constexpr int kExitBadUsage = 2;  ///< bad options or a bad file; nothing was started

}  // namespace gyre::ground
