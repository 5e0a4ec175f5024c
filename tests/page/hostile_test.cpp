// What somebody can do to the page's server who means no good, or is broken: waste his own connection.

#include <fstream>
#include <random>

#include "tests/page/served.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using test::Connection;
using test::kToken;
using test::PageServerTest;
using test::Reply;
using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;
using testing::Not;

class HostileTest : public PageServerTest {
 protected:
  void TearDown() override {
    ASSERT_TRUE(server_);
    EXPECT_EQ(ask(get("/api/time")).status, 200) << "it is still there";
  }
  /// How much the server takes of something that does not end.
  std::size_t taken_of_endless(const std::string& begin, const std::string& more) {
    constexpr std::size_t kEnough = std::size_t{64} << 20;
    Connection connection = connect();
    std::size_t taken = connection.send(begin);
    while (taken < kEnough) {
      const std::size_t now = connection.send(more);
      taken += now;
      if (now < more.size()) break;
    }
    return taken;
  }
  /// Of this process, in bytes; a sanitizer's own memory says nothing.
  static std::size_t resident() {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
    return 0;
#endif
    std::ifstream file("/proc/self/statm");
    std::size_t all = 0, here = 0;
    file >> all >> here;
    return here * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  }
  static constexpr std::size_t kBetween = std::size_t{16} << 20;  ///< what two kernels may keep of it, and more
};

TEST_F(HostileTest, ABodyThatIsTooLongIsRefusedUnread) {
  serve();
  const std::string head = "POST /api/check HTTP/1.1\r\nHost: " + host() + "\r\nX-Gyre-Token: " + kToken +
                           "\r\nConnection: close\r\nContent-Length: ";
  for (const char* length : {"400000", "4000000000", "18446744073709551615", "99999999999999999999999"}) {
    Connection connection = connect();
    connection.send(head + length + "\r\n\r\n" + std::string(1000, 'x'));
    connection.finish();
    ASSERT_TRUE(connection.reads_the_end());
    EXPECT_THAT(reply_of(connection.got()).status, AnyOf(413, 400, 0)) << length;
  }
  // One who goes on sending still reads why he is not read.
  Connection whole = connect();
  whole.send(head + "400000\r\n\r\n" + std::string(400'000, 'x'));
  ASSERT_TRUE(whole.reads_the_end());
  EXPECT_FALSE(whole.was_reset());
  const Reply reply = reply_of(whole.got());
  EXPECT_EQ(reply.status, 413);
  EXPECT_THAT(words(reply), HasSubstr("a request may have 327680 bytes"));
  EXPECT_LT(taken_of_endless(head + "4000000000\r\n\r\n", std::string(65536, 'x')), kBetween);
}

TEST_F(HostileTest, WhatDoesNotEndIsCutOff) {
  serve();
  const std::string begin = "GET /api/time HTTP/1.1\r\nHost: " + host() + "\r\n";
  std::string headers;
  for (int i = 0; i < 2000; ++i) headers += "X-Padding-" + std::to_string(i) + ": " + std::string(20, 'x') + "\r\n";
  const std::size_t before = resident();
  EXPECT_LT(taken_of_endless(begin, headers), kBetween) << "headers";
  EXPECT_LT(taken_of_endless(begin + "X-Long: ", std::string(65536, 'x')), kBetween) << "a header";
  EXPECT_LT(taken_of_endless("GET /", std::string(65536, 'a')), kBetween) << "a target";
  EXPECT_LT(taken_of_endless("", std::string(65536, 'G')), kBetween) << "a method";
  EXPECT_LT(taken_of_endless("", std::string(65536, '\0')), kBetween) << "nothing at all";
  EXPECT_LT(taken_of_endless("", std::string(65536, '\n')), kBetween) << "empty lines";
  const std::string chunk = "10000\r\n" + std::string(65536, 'x') + "\r\n";
  EXPECT_LT(taken_of_endless("POST /api/check HTTP/1.1\r\nHost: " + host() + "\r\nX-Gyre-Token: " + kToken +
                                 "\r\nTransfer-Encoding: chunked\r\n\r\n",
                             chunk),
            kBetween)
      << "chunks";
  EXPECT_LT(resident(), before + kBetween);
}

TEST_F(HostileTest, ManyRequestsOnOneConnectionAreBounded) {
  auto with = options();
  with.bounds.requests_per_connection = 10;
  serve(with);
  Connection connection = connect();
  std::string requests;
  for (int i = 0; i < 30; ++i) requests += "GET /api/time HTTP/1.1\r\nHost: " + host() + "\r\n\r\n";
  connection.send(requests);
  ASSERT_TRUE(connection.reads_the_end());
  std::size_t replies = 0;
  for (std::size_t at = 0; (at = connection.got().find("HTTP/1.1 200", at)) != std::string::npos; ++at) ++replies;
  EXPECT_LE(replies, 10U);
}

TEST_F(HostileTest, WhoIsSlowIsLeftHoweverSteadyHeIs) {
  auto with = options();
  with.bounds.request_time = milliseconds(200);
  serve(with);
  Connection silent = connect();
  silent.send("GET / HTTP/1.1\r\nHost: ");
  Connection steady = connect();
  steady.send("GET / HTTP/1.1\r\nX-Slow: ");
  int drops = 0;
  while (drops < 2000 && !steady.news(milliseconds(10)) && steady.send("x") == 1) ++drops;
  EXPECT_LT(drops, 2000) << "a byte every hundredth of a second, for ever";
  EXPECT_TRUE(silent.reads_the_end());
  Connection body = connect();
  body.send("POST /api/order HTTP/1.1\r\nHost: " + host() + "\r\nX-Gyre-Token: " + kToken +
            "\r\nContent-Length: 1000\r\n\r\n{");
  EXPECT_TRUE(body.reads_the_end());
}

TEST_F(HostileTest, WhoSaysNothingIsLeft) {
  auto with = options();
  with.bounds.idle_time = milliseconds(50);
  serve(with);
  std::vector<Connection> idle;
  for (int i = 0; i < 50; ++i) idle.push_back(connect());
  for (Connection& connection : idle) EXPECT_TRUE(connection.reads_the_end());
}

TEST_F(HostileTest, WhoTakesAllPlacesAndSaysNothingKeepsNobodyOut) {
  auto with = options();
  with.bounds.request_time = with.bounds.idle_time = std::chrono::hours(1);
  serve(with);
  server_->stage().show(Scene::kHello, "{}");
  Connection watcher = watch();
  std::vector<Connection> half_open;
  for (std::size_t i = 0; i < 2 * with.bounds.places; ++i) {
    half_open.push_back(connect());
    if (i % 2 == 0) half_open.back().send("GET / HTTP/1.1\r\nHost: ");
  }
  EXPECT_EQ(ask(get("/api/time")).status, 200) << "a newcomer";
  server_->stage().show(Scene::kFrame, "{\"f\":1}");
  EXPECT_TRUE(watcher.reads("event: frame")) << "who looks on lets nobody wait";
  EXPECT_TRUE(half_open.front().reads_the_end()) << "who let the server wait for the longest";
  EXPECT_FALSE(half_open.back().news(milliseconds(0))) << "the last one has his place";
}

TEST_F(HostileTest, WhoWaitsForHisAnswerLosesNothingToNewcomers) {
  auto with = options();
  with.bounds.places = 2;
  with.bounds.request_time = with.bounds.idle_time = std::chrono::hours(1);
  serve(with);
  Connection waiting = connect();
  waiting.send(post("/api/order", R"({"kind":"ENGAGE"})"));
  const PageRequest held = next_request();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(ask(get("/api/time")).status, 200);
  held.answer->set_value({true, "the swarm moves"});
  ASSERT_TRUE(waiting.reads_the_end());
  EXPECT_EQ(words(reply_of(waiting.got())), "the swarm moves");
}

/// A page whose name is made to point here could have its own requests written in there, under the name that is ours.
TEST_F(HostileTest, ABodyThatNobodyReadsIsNoRequest) {
  serve();
  const std::string hidden = "GET /metrics HTTP/1.1\r\nHost: " + host() + "\r\n\r\n";
  const std::string length = "Content-Length: " + std::to_string(hidden.size()) + "\r\n\r\n";
  server_->set_metrics("gyre_calm 1\n");
  for (const std::string& request :
       {"POST /api/order HTTP/1.1\r\nHost: evil.example\r\n" + length,
        "GET /nowhere HTTP/1.1\r\nHost: evil.example\r\n" + length,
        "POST /metrics HTTP/1.1\r\nHost: " + host() + "\r\n" + length,
        "GET /api/time HTTP/1.1\r\nHost: " + host() + "\r\n" + length,
        "POST /api/order HTTP/1.1\r\nHost: " + host() + "\r\nRange: bytes=0-1\r\n" + length}) {
    Connection connection = connect();
    connection.send(request + hidden);
    ASSERT_TRUE(connection.reads_the_end()) << request;
    EXPECT_EQ(connection.got().find("gyre_calm"), std::string::npos) << request;
    EXPECT_NE(reply_of(connection.got()).status, 0) << "and he gets his answer: " << request;
  }
}

TEST_F(HostileTest, PathsLeadNowhere) {
  auto with = options();
  with.bounds.idle_time = with.bounds.request_time = milliseconds(100);  // some of them promise more, and send nothing
  serve(with);
  for (const char* target :
       {"/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd", "//etc/passwd",
        "/./../etc/passwd", "/api/events/../../etc/passwd", "/\\..\\..\\etc\\passwd", "/%00", "/%", "/%zz",
        "/index.html", "/api", "/api/", "/api/order", "http://127.0.0.1/etc/passwd", "*", "/api/time%00", "/?/../..",
        "/%c0%ae%c0%ae/etc/passwd"}) {
    const Reply reply = ask(get(target));
    EXPECT_THAT(reply.status, AnyOf(404, 405, 400, 200)) << target;
    if (reply.status == 200) {
      EXPECT_THAT(reply.body, HasSubstr("built without the page")) << target;
    }
    EXPECT_EQ(reply.body.find("root:"), std::string::npos) << target;
  }
  for (const char* method : {"PUT", "DELETE", "PATCH", "TRACE", "CONNECT", "OPTIONS", "PRI", "get"}) {
    const Reply reply = ask(std::string(method) + " / HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n\r\n");
    EXPECT_THAT(reply.status, AnyOf(405, 400)) << method;
    EXPECT_THAT(words(reply), Not(HasSubstr("status"))) << method;
  }
}

TEST_F(HostileTest, AFewBytesDoNotBecomeMany) {
  auto with = options();
  const std::string page(1 << 20, 'p');
  with.page = {page, "default-src 'self'"};
  serve(with);
  const std::size_t before = resident();
  std::string ranges = "Range: bytes=0-";
  while (ranges.size() < 7000) ranges += ",0-";
  const Reply ranged = ask(get("/", ranges + "\r\n"));
  EXPECT_EQ(ranged.status, 416);
  EXPECT_LT(ranged.body.size(), std::size_t{1} << 20);
  for (const char* encoding : {"gzip", "deflate", "br", "identity, gzip"}) {
    const Reply packed =
        ask(post("/api/check", std::string(1000, '\x1f'),
                 std::string("X-Gyre-Token: ") + kToken + "\r\nContent-Encoding: " + encoding + "\r\n"));
    EXPECT_EQ(packed.status, 415) << encoding;
  }
  EXPECT_LT(resident(), before + kBetween);
}

TEST_F(HostileTest, TheHundredAndFirstIsToldThatAHundredLookAlready) {
  serve();
  server_->stage().show(Scene::kHello, "{}");
  std::vector<Connection> watchers;
  for (int i = 0; i < kMostWatchers; ++i) watchers.push_back(watch());
  const Reply one_more = ask(get("/api/events"));
  EXPECT_EQ(one_more.status, 503);
  EXPECT_THAT(words(one_more), HasSubstr("100 browsers look already"));
  EXPECT_EQ(ask(get("/api/time")).status, 200) << "what is short is still answered";
  server_->stage().show(Scene::kFrame, "{\"f\":1}");
  for (Connection& watcher : watchers) EXPECT_TRUE(watcher.reads("event: frame"));
  watchers.pop_back();
  bool admitted = false;
  for (int i = 0; i < 20'000 && !admitted; ++i) {
    server_->stage().show(Scene::kFrame, "{}");  // who is gone is noticed by what cannot be sent
    Connection next = connect();
    next.send(get("/api/events"));
    admitted = next.reads("HTTP/1.1 ") && next.reads("\r\n") && next.got().find(" 200 ") != std::string::npos;
  }
  EXPECT_TRUE(admitted) << "the place of who left";
}

TEST_F(HostileTest, AWatcherThatNeverReadsDelaysNobody) {
  auto with = options();
  with.bounds.write_time = std::chrono::hours(1);
  serve(with);
  server_->stage().show(Scene::kHello, "{}");
  std::vector<Connection> deaf;
  for (int i = 0; i < 10; ++i) deaf.push_back(watch());
  Connection watcher = watch();
  const std::string large(std::size_t{1} << 20, 'x');
  for (int i = 0; i < 40; ++i) {
    server_->stage().show(Scene::kStatus, large + std::to_string(i));
    ASSERT_TRUE(watcher.reads("x" + std::to_string(i) + "\n")) << i;
    watcher.forget();
  }
  EXPECT_EQ(server_->stage().watchers(), 11);
  server_->stage().show(Scene::kStatus, "{\"last\":true}");
  for (Connection& late : deaf) {
    ASSERT_TRUE(late.reads("{\"last\":true}"));
    EXPECT_LT(late.got().size(), 40 * large.size()) << "what is old is not sent to who comes late";
  }
}

TEST_F(HostileTest, AWatcherThatNeverReadsLosesHisPlace) {
  auto with = options();
  with.bounds.write_time = milliseconds(100);
  serve(with);
  server_->stage().show(Scene::kHello, "{}");
  Connection deaf = watch();
  const std::string large(std::size_t{8} << 20, 'x');
  server_->stage().show(Scene::kStatus, large);
  const auto end = std::chrono::steady_clock::now() + Connection::kPatience;
  while (server_->stage().watchers() > 0 && std::chrono::steady_clock::now() < end) {
    server_->stage().show(Scene::kFrame, large);
    (void)ask(get("/api/time"));
  }
  EXPECT_EQ(server_->stage().watchers(), 0);
}

TEST_F(HostileTest, TwoThousandBrokenRequestsBreakNothing) {
  serve();
  server_->stage().show(Scene::kHello, "{}");
  const std::uint32_t seed = std::random_device{}();
  std::printf("seed %u\n", seed);
  std::uint64_t state = seed | 1U;
  const auto draw = [&state](std::size_t below) {  // xorshift64*
    state ^= state >> 12U, state ^= state << 25U, state ^= state >> 27U;
    return static_cast<std::size_t>((state * 0x2545F4914F6CDD1DULL) >> 33U) % below;
  };
  const std::vector<std::string> good{
      get("/"),
      get("/api/time"),
      get("/metrics"),
      get("/api/events"),
      post("/api/order", R"({"kind":"ENGAGE"})", "X-Gyre-Token: wrong\r\nOrigin: http://" + host() + "\r\n"),
      post("/api/check", R"({"mission":"name: \"x\" load { mass_kg: 1 }"})"),
      "POST /api/check HTTP/1.1\r\nHost: " + host() + "\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n",
      "POST /api/check HTTP/1.1\r\nHost: " + host() +
          "\r\nContent-Type: multipart/form-data; boundary=b\r\nContent-Length: 60\r\n\r\n--b\r\nContent-Disposition: "
          "form-data; name=\"a\"\r\n\r\nx\r\n--b--\r\n",
      get("/?a=b&c=%20", "Range: bytes=0-5\r\nExpect: 100-continue\r\nAccept-Encoding: gzip\r\n")};
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good[draw(good.size())];
    for (std::size_t n = draw(12); n > 0 && !bytes.empty(); --n) {
      const std::size_t at = draw(bytes.size());
      switch (draw(6)) {
        case 0:
          bytes[at] = static_cast<char>(draw(256));
          break;
        case 1:
          bytes.erase(at, draw(20));
          break;
        case 2:
          bytes.insert(at, std::string(draw(300), static_cast<char>(draw(256))));
          break;
        case 3:
          bytes.insert(at, bytes.substr(draw(bytes.size()), draw(100)));
          break;
        case 4:
          bytes.insert(at, "\r\n");
          break;
        default:
          bytes.resize(at);
      }
    }
    Connection connection = connect();
    connection.send(bytes);
    connection.finish();
    ASSERT_TRUE(connection.news()) << "neither an answer nor an end, seed " << seed << ", request " << i;
  }
  EXPECT_TRUE(server_->take_requests().empty());
}

}  // namespace
}  // namespace gyre::ground
