#include "common/base/ensure.hpp"

#include <cstdio>
#include <cstdlib>

namespace gyre {

void ensure_failed(const char* condition, const char* file, int line, const char* why) {
  std::fprintf(stderr, "gyre: internal error at %s:%d: %s is false: %s\n", file, line, condition, why);
  std::abort();
}

}  // namespace gyre
