#pragma once
// An HTTP server to which nobody can do more than waste his own connection.
//
// cpp-httplib reads a request for as long as bytes come, headers without end too (before 0.20), and knows no limit for
// the whole of it. So its connections read through a stream that has one: so many bytes and so much time for a
// request, and then the connection is closed. Sending is bounded as well: who does not take what he asked for is left.
// Each connection has a thread while it is open, and there are so many: when all are taken, who has let the server wait
// for the longest leaves for who comes (core/place_book.hpp). And it can end: its own stop() waits for whoever is slow.
//
// What follows a body that nobody read would be taken for the next request, past whoever judged the one before: such a
// connection is closed, and its owner gets his answer first.

#include <httplib.h>

#include <condition_variable>
#include <mutex>
#include <set>

#include "common/base/time.hpp"
#include "ground/page/core/place_book.hpp"
#include "ground/page/server_bounds.hpp"

namespace gyre::ground {

class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const ServerBounds& bounds);

  /// For a handler, of the request that it has: whatever comes behind it on its connection is not to be read.
  static void close_after_this();

  /// Takes no more connections and requests, and leaves who does not take his answer: listening ends soon.
  void end();

 private:
  class Queue;
  class Stream;

  bool process_and_close_socket(socket_t socket) override;
  bool serve(socket_t socket);
  [[nodiscard]] bool admit(socket_t socket);
  void leave(socket_t socket);
  void come();
  void wait(socket_t socket, LocalTime since);
  void go_on(socket_t socket);
  /// With the lock.
  void make_room();

  const ServerBounds bounds_;
  std::mutex mutex_;
  std::condition_variable left_;
  std::set<socket_t> open_;
  PlaceBook book_;
  bool ended_ = false;
};

}  // namespace gyre::ground
