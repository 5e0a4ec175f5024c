#include "tests/places.hpp"

namespace gyre::test {

std::string source_directory() {
  return GYRE_SOURCE_DIRECTORY;
}

std::string program_directory() {
  return GYRE_PROGRAM_DIRECTORY;
}

}  // namespace gyre::test
