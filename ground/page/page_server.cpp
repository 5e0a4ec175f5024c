#include "ground/page/page_server.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

#include "common/base/text.hpp"
#include "ground/page/bounded_server.hpp"
#include "ground/page/core/door.hpp"
#include "ground/page/page_json.hpp"

namespace gyre::ground {
namespace {

using httplib::Request;
using httplib::Response;
using Handled = httplib::Server::HandlerResponse;

/// Longer than an order may take (OrderDesk).
constexpr auto kAnswerPatience = std::chrono::seconds(25);
/// Whoever holds the promise may not know that the server ends.
constexpr auto kEndIsSeen = std::chrono::milliseconds(100);
/// A stream that has nothing to say says so, or what lies between closes it.
constexpr Duration kStillThere = std::chrono::seconds(5);
constexpr Duration kLook = std::chrono::seconds(1);

static_assert(ServerBounds{}.places > kMostWatchers, "who looks on leaves places for what is short");

constexpr const char* kTheServerEnds = "the server ends";
constexpr const char* kNoPage =
    "<!doctype html><meta charset=utf-8><title>Gyre</title><p>This gyre was built without the page: Node and npm were "
    "missing then. Install them (deploy/install build), build again, and it is here.<p>What the swarm says is at "
    "<code>/api/events</code>, figures for Prometheus at <code>/metrics</code>.";

LocalTime local_now() {
  return LocalTime(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

void refuse(Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(answer_json({false, text}), "application/json");
}

/// Streams end by a look that fails, or never: the watcher is counted by a guard that goes with the response.
struct Watcher {
  explicit Watcher(Stage& entered) : stage(entered) {}
  ~Watcher() { stage.leave(); }
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;

  Stage& stage;
  Stage::Cursor cursor;
  Duration quiet{};
};

}  // namespace

struct PageServer::Impl {
  explicit Impl(const PageServerOptions& asked) : options(asked), server(asked.bounds) {}

  void route();
  [[nodiscard]] bool may_be_routed(const Request& request, Response& response) const;
  [[nodiscard]] bool admits(const Request& request, Response& response);
  void events(Response& response);
  void ask(Response& response, std::variant<protocol::Command, HurtRequest> wish);
  void order(const Request& request, Response& response);
  void check(const Request& request, Response& response);
  void hurt(const Request& request, Response& response);

  const PageServerOptions options;
  const LocalTime begin = local_now();
  int port = 0;
  Stage stage;
  std::mutex mutex;
  RateJudge rate{20.0, 10.0};
  std::vector<PageRequest> requests;
  bool closed = false;
  std::string metrics;
  std::mutex checking;  ///< one certificate at a time: it takes a processor
  BoundedServer server;
  std::thread listening;
};

// ------------------------------------------------------------------------------------------------------ who may come
// in

/// Of requests that change something.
bool PageServer::Impl::admits(const Request& request, Response& response) {
  if (!is_same_origin(request.get_header_value("Origin"), request.get_header_value("Host"))) {
    refuse(response, 403, "orders are taken from this server's own page only");
    return false;
  }
  if (!same_token(request.get_header_value("X-Gyre-Token"), options.token)) {
    refuse(response, 401, "orders need the token: open the address that the server printed when it began");
    return false;
  }
  const std::lock_guard<std::mutex> lock(mutex);
  if (rate.admits(local_now())) return true;
  refuse(response, 429, "too many requests; slower");
  return false;
}

/// Otherwise it is answered.
bool PageServer::Impl::may_be_routed(const Request& request, Response& response) const {
  if (!is_own_host(request.get_header_value("Host"), options.hosts)) {
    refuse(response, 403, "open this page by an address of the machine, or name the machine to the server with --host");
    return false;
  }
  if (request.has_header("Content-Encoding")) {  // a few bytes could become more than there is memory
    refuse(response, 415, "send it as it is, not compressed");
    return false;
  }
  if (request.has_header("Range")) {  // a few of them could ask for the same bytes a thousand times
    refuse(response, 416, "ask for the whole of it");
    return false;
  }
  const std::vector<std::string> allowed = allowed_methods(request.path);
  if (allowed.empty()) return true;  // there is nothing, which the router says
  if (std::find(allowed.begin(), allowed.end(), request.method) != allowed.end()) return true;
  response.set_header("Allow", allow_header(request.path));
  refuse(response, 405, refusal_words(405, request.path, options.bounds.request_bytes));
  return false;
}

void PageServer::Impl::route() {
  server.set_pre_routing_handler([this](const Request& request, Response& response) {
    const bool in_order = may_be_routed(request, response);
    // Whoever asks for something with a body that is not read might have written his next request into it.
    const bool has_body = request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
    if (has_body && (!in_order || request.method != "POST")) BoundedServer::close_after_this();
    return in_order ? Handled::Unhandled : Handled::Handled;
  });
  httplib::Headers headers{{"X-Content-Type-Options", "nosniff"},
                           {"X-Frame-Options", "DENY"},
                           {"Referrer-Policy", "no-referrer"},
                           {"Cross-Origin-Resource-Policy", "same-origin"},
                           {"Cache-Control", "no-store"}};
  server.set_default_headers(std::move(headers));
  server.set_error_handler([this](const Request& request, Response& response) {
    if (!response.body.empty()) return;
    refuse(response, response.status, refusal_words(response.status, request.path, options.bounds.request_bytes));
  });
  server.set_exception_handler([](const Request&, Response& response, std::exception_ptr) {  // NOLINT: its signature
    refuse(response, 500, "the server could not work with that");
  });

  server.Get("/", [this](const Request&, Response& response) {
    const PageBundle& page = options.page;
    if (page.html_gzip.empty()) return response.set_content(kNoPage, "text/html; charset=utf-8");
    response.set_header("Content-Encoding", "gzip");
    response.set_header("Content-Security-Policy", std::string(page.policy));
    // Not as content: that is compressed once more for a browser that takes compressed pages.
    const std::string_view html = page.html_gzip;
    response.set_content_provider(html.size(), "text/html; charset=utf-8",
                                  [html](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                    return sink.write(html.data() + offset, length), sink.is_writable();
                                  });
  });
  server.Get("/api/events", [this](const Request&, Response& response) { events(response); });
  server.Get("/api/time", [this](const Request&, Response& response) {
    response.set_content(time_json(seconds(local_now() - begin)), "application/json");
  });
  server.Get("/metrics", [this](const Request&, Response& response) {
    const std::lock_guard<std::mutex> lock(mutex);
    response.set_content(metrics, "text/plain; version=0.0.4");
  });
  server.Post("/api/order", [this](const Request& request, Response& response) { order(request, response); });
  server.Post("/api/check", [this](const Request& request, Response& response) { check(request, response); });
  server.Post("/api/hurt", [this](const Request& request, Response& response) { hurt(request, response); });
}

// ------------------------------------------------------------------------------------------------------ what they get

void PageServer::Impl::events(Response& response) {
  if (!stage.enter(kMostWatchers)) return refuse(response, 503, text("%d browsers look already", kMostWatchers));
  const auto watcher = std::make_shared<Watcher>(stage);
  response.set_chunked_content_provider("text/event-stream", [watcher](std::size_t, httplib::DataSink& sink) {
    const auto news = watcher->stage.next(watcher->cursor, kLook);
    if (!news) {
      sink.done();
      return true;
    }
    std::string words = *news;
    watcher->quiet = words.empty() ? watcher->quiet + kLook : Duration::zero();
    if (watcher->quiet >= kStillThere) {
      words = ": nothing new\n\n";
      watcher->quiet = Duration::zero();
    }
    if (!words.empty()) sink.write(words.data(), words.size());
    return sink.is_writable();
  });
}

void PageServer::Impl::ask(Response& response, std::variant<protocol::Command, HurtRequest> wish) {
  auto promise = std::make_shared<std::promise<Answer>>();
  std::future<Answer> answer = promise->get_future();
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (closed) return refuse(response, 503, kTheServerEnds);
    requests.push_back({std::move(wish), std::move(promise)});
  }
  const LocalTime patient_until = local_now() + kAnswerPatience;
  while (answer.wait_for(kEndIsSeen) != std::future_status::ready) {
    if (local_now() > patient_until) return refuse(response, 504, "no answer came in time");
    const std::lock_guard<std::mutex> lock(mutex);
    if (closed) return refuse(response, 503, kTheServerEnds);
  }
  try {
    response.set_content(answer_json(answer.get()), "application/json");
  } catch (const std::future_error&) {  // nobody is left to keep the promise
    refuse(response, 503, kTheServerEnds);
  }
}

void PageServer::Impl::order(const Request& request, Response& response) {
  if (!admits(request, response)) return;
  if (!options.takes_orders) return refuse(response, 409, "this is a recording: nobody is there to take an order");
  auto command = order_of(request.body);
  if (!command) return refuse(response, 400, command.error().text);
  ask(response, std::move(command).value());
}

void PageServer::Impl::check(const Request& request, Response& response) {
  if (!admits(request, response)) return;
  const std::lock_guard<std::mutex> one_at_a_time(checking);
  const auto verdict = verdict_json(request.body);
  if (!verdict) return refuse(response, 400, verdict.error().text);
  response.set_content(verdict.value(), "application/json");
}

void PageServer::Impl::hurt(const Request& request, Response& response) {
  if (!admits(request, response)) return;
  if (!options.takes_orders) return refuse(response, 409, "this is a recording: nobody is there to be hurt");
  auto wish = hurt_of(request.body);
  if (!wish) return refuse(response, 400, wish.error().text);
  ask(response, std::move(wish).value());
}

// ------------------------------------------------------------------------------------------------------ begin and end

PageServer::PageServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Result<std::unique_ptr<PageServer>> PageServer::open(const PageServerOptions& options) {
  GYRE_ENSURE(!options.token.empty(), "orders need a token");
  auto impl = std::make_unique<Impl>(options);
  httplib::Server& server = impl->server;
  server.set_tcp_nodelay(true);
  // Its own default would let a second server take the same port, and each of them half of the browsers.
  socket_t bound = INVALID_SOCKET;
  server.set_socket_options([&bound](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    bound = socket;  // the last one is the one that could be bound
  });
  impl->route();
  if (options.port == 0) {
    impl->port = server.bind_to_any_port(options.address);
  } else {
    const int first = options.port.value_or(kFirstPort);
    const int last = options.port ? first : kFirstPort + kPortsTried - 1;
    for (int port = first; port <= last && impl->port <= 0; ++port) {
      if (server.bind_to_port(options.address, port)) impl->port = port;
    }
  }
  if (impl->port <= 0) {
    const std::string where = options.port ? text("port %d", *options.port)
                                           : text("any port from %d to %d", kFirstPort, kFirstPort + kPortsTried - 1);
    return Error{"the page cannot be served at " + options.address + ", " + where +
                 ": taken by another server, or no address of this machine; choose with --port and --address"};
  }
  // It lets five wait to be taken in, and browsers come with more connections than that: the others would begin anew
  // after a second.
  ::listen(bound, static_cast<int>(options.bounds.places));
  server.set_socket_options(nullptr);
  impl->listening = std::thread([raw = impl.get()] { raw->server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::yield();  // one that does not run yet cannot be stopped
  return std::unique_ptr<PageServer>(new PageServer(std::move(impl)));
}

PageServer::~PageServer() {
  impl_->stage.close();
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->closed = true;
    impl_->requests.clear();  // breaks the promises
  }
  impl_->server.end();
  impl_->listening.join();
}

std::string PageServer::url(bool with_token) const {
  const std::string& address = impl_->options.address;
  std::string host = address == "0.0.0.0" ? "127.0.0.1" : address == "::" ? "::1" : address;
  if (host.find(':') != std::string::npos) host = "[" + host + "]";  // RFC 3986: or its colons would begin the port
  return "http://" + host + text(":%d/", impl_->port) + (with_token ? "#token=" + impl_->options.token : "");
}

Stage& PageServer::stage() {
  return impl_->stage;
}

std::vector<PageRequest> PageServer::take_requests() {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return std::exchange(impl_->requests, {});
}

void PageServer::set_metrics(const std::string& text) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->metrics = text;
}

}  // namespace gyre::ground
