#pragma once
// The page's server: shows what is on the stage to whoever looks, and hands on what a person asks for.
//
//   GET  /              the page itself
//   GET  /api/events    the stage, as a stream of events; a hundred at once
//   GET  /api/time      the server's time, for the page's own skew to it
//   POST /api/order, /api/check, /api/hurt      with the token; answered when it is done, or could not be
//   GET  /metrics       for Prometheus
//
// Threads of its own, one per connection; the loop that makes what is shown never waits for one of them. Who may ask
// for what is decided in core/door.hpp.

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/result.hpp"
#include "common/protocol/messages.hpp"
#include "ground/page/page_bundle.hpp"
#include "ground/page/page_requests.hpp"
#include "ground/page/server_bounds.hpp"
#include "ground/page/stage.hpp"

namespace gyre::ground {

struct PageServerOptions {
  std::string address = "127.0.0.1";  ///< to listen at
  std::optional<int> port;            ///< absent: the first that is free from kFirstPort on; 0: any
  std::string token;                  ///< what orders have to show; not empty
  std::vector<std::string> hosts;     ///< names by which this machine is called, beside addresses and "localhost"
  bool takes_orders = true;
  PageBundle page = page_bundle();
  ServerBounds bounds = {};
};

inline constexpr int kFirstPort = 8480;
inline constexpr int kPortsTried = 20;
inline constexpr int kMostWatchers = 100;

/// What somebody waits for at his connection.
struct PageRequest {
  std::variant<protocol::Command, HurtRequest> wish;
  std::shared_ptr<std::promise<Answer>> answer;
};

class PageServer {
 public:
  /// Listens from then on. Fails when the port is taken or the address is none of this machine's; the error says which,
  /// and what to do.
  [[nodiscard]] static Result<std::unique_ptr<PageServer>> open(const PageServerOptions& options);
  /// Every connection is closed, and who still waits for an answer is told so.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// What to open in a browser; `with_token`: as somebody who may give orders.
  [[nodiscard]] std::string url(bool with_token = true) const;

  [[nodiscard]] Stage& stage();
  /// What was asked for since the last call, for the loop to do and to answer.
  [[nodiscard]] std::vector<PageRequest> take_requests();
  /// Of /metrics, from now on.
  void set_metrics(const std::string& text);

  struct Impl;

 private:
  explicit PageServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyre::ground
