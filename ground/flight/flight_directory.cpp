#include "ground/flight/flight_directory.hpp"

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace gyre::ground {

Result<FlightDirectory> FlightDirectory::make(const std::optional<std::string>& chosen) {
  std::error_code failure;
  if (chosen) {
    std::filesystem::create_directories(*chosen, failure);
    if (failure) return Error{"--logs " + *chosen + ": cannot make this directory: " + failure.message()};
    return FlightDirectory(*chosen, true);
  }
  const std::filesystem::path parent = std::filesystem::temp_directory_path(failure);
  if (failure) return Error{"TMPDIR is no directory (" + failure.message() + "); set it right or use --logs"};
  std::string path = parent / "gyre-flight-XXXXXX";
  if (::mkdtemp(path.data()) == nullptr) {
    return Error{"cannot make a directory for the logs in " + parent.string() + ": " + std::strerror(errno) +
                 "; set TMPDIR or use --logs"};
  }
  return FlightDirectory(path, false);
}

FlightDirectory::FlightDirectory(FlightDirectory&& other) noexcept
    : path_(std::exchange(other.path_, {})), kept_(other.kept_) {}

FlightDirectory::~FlightDirectory() {
  if (path_.empty() || kept_) return;
  std::error_code ignored;  // what cannot be removed stays in the temporary directory
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace gyre::ground
