#pragma once
// An HTTP server to which nobody can do more than waste his own connection.
//
// cpp-httplib reads a request for as long as bytes come, headers without end too (before 0.20), and knows no limit for
// the whole of it. So its connections read through a stream that has one: so many bytes and so much time for a
// request, and then the connection is closed. Sending is bounded as well: who does not take what he asked for is left.
// And it can end: its own stop() waits for whoever is slow.

#include <httplib.h>

#include <condition_variable>
#include <mutex>
#include <set>

#include "ground/page/server_bounds.hpp"

namespace gyre::ground {

class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const ServerBounds& bounds);

  /// Takes no more connections and requests, and leaves who does not take his answer: listening ends soon.
  void end();

 private:
  bool process_and_close_socket(socket_t socket) override;
  bool serve(socket_t socket);
  [[nodiscard]] bool admit(socket_t socket);
  void leave(socket_t socket);

  const ServerBounds bounds_;
  std::mutex mutex_;
  std::condition_variable left_;
  std::set<socket_t> open_;
  bool ended_ = false;
};

}  // namespace gyre::ground
