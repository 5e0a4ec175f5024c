#pragma once
// An HTTP server to which nobody can do more than waste his own connection.
//
// cpp-httplib reads a request for as long as bytes come, headers without end too (before 0.20), and knows no limit for
// the whole of it. So its connections read through a stream that has one: so many bytes and so much time for a
// request, and then the connection is closed. Sending is bounded as well: who does not take what he asked for is left.

#include <httplib.h>

#include <chrono>

namespace gyre::ground {

struct ServerBounds {
  std::size_t request_bytes = 320 * 1024;  ///< line, headers and body
  std::chrono::milliseconds request_time{10'000};
  std::chrono::milliseconds idle_time{5'000};  ///< between two requests of one connection
  std::chrono::milliseconds write_time{5'000};
  int requests_per_connection = 100;
};

class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const ServerBounds& bounds);

 private:
  bool process_and_close_socket(socket_t socket) override;

  const ServerBounds bounds_;
};

}  // namespace gyre::ground
