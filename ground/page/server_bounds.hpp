#pragma once
// How much of a server one connection may have.

#include <chrono>
#include <cstddef>

namespace gyre::ground {

struct ServerBounds {
  std::size_t request_bytes = 320 * 1024;  ///< line, headers and body
  std::chrono::milliseconds request_time{10'000};
  std::chrono::milliseconds idle_time{5'000};  ///< between two requests of one connection
  std::chrono::milliseconds write_time{5'000};
  std::chrono::milliseconds last_words{300};  ///< for answers that are on their way when the server ends
  std::size_t places = 116;                   ///< connections at once: a hundred that watch, and some for what is short
  int requests_per_connection = 100;
};

}  // namespace gyre::ground
