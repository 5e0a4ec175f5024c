#include "common/base/version.hpp"

namespace gyre {

const char* version() {
  return GYRE_VERSION;
}

}  // namespace gyre
