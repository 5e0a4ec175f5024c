#pragma once
// Where a flight's logs are: a fresh directory that goes with a good flight, or one the user named, which stays.

#include <optional>
#include <string>

#include "common/base/result.hpp"

namespace gyre::ground {

class FlightDirectory {
 public:
  /// Without `chosen`: a new directory below $TMPDIR, else /tmp. With it: that one, made if need be, and kept.
  [[nodiscard]] static Result<FlightDirectory> make(const std::optional<std::string>& chosen);

  ~FlightDirectory();
  FlightDirectory(FlightDirectory&& other) noexcept;
  FlightDirectory& operator=(FlightDirectory&&) = delete;
  FlightDirectory(const FlightDirectory&) = delete;
  FlightDirectory& operator=(const FlightDirectory&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  void keep() { kept_ = true; }

 private:
  FlightDirectory(std::string path, bool kept) : path_(std::move(path)), kept_(kept) {}

  std::string path_;  // empty: moved away
  bool kept_;
};

}  // namespace gyre::ground
