#pragma once
// A bug in our own code stops the process at once, in every build type: flying on with a broken invariant is worse.

namespace gyre {

[[noreturn]] void ensure_failed(const char* condition, const char* file, int line, const char* why);

}  // namespace gyre

/// States an invariant of our own code. Never for input: input is judged with Result and answered with an Error.
#define GYRE_ENSURE(condition, why) \
  ((condition) ? static_cast<void>(0) : ::gyre::ensure_failed(#condition, __FILE__, __LINE__, why))
