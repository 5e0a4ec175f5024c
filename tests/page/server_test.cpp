// What the page's server gives to whom: the page, the stream, orders and their answers.

#include <future>

#include "tests/page/served.hpp"

namespace gyre::ground {
namespace {

using nlohmann::json;
using test::Connection;
using test::kToken;
using test::PageServerTest;
using test::Reply;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kEngage = R"({"kind":"ENGAGE"})";

using ServerTest = PageServerTest;

// ---------------------------------------------------------------------------------------------------- what is to see

TEST_F(ServerTest, WithoutAPageItSaysHowToGetOne) {
  serve();
  const Reply page = ask(get("/"));
  EXPECT_EQ(page.status, 200);
  EXPECT_THAT(page.body, HasSubstr("deploy/install build"));
}

TEST_F(ServerTest, ThePageIsServedAsItWasBuiltWhateverTheBrowserTakes) {
  auto with = options();
  const std::string bytes = std::string("\x1f\x8b\x08", 3) + std::string(300'000, '\0') + "end";
  with.page = {bytes, "default-src 'self'"};
  serve(with);
  for (const char* takes : {"", "Accept-Encoding: gzip, deflate, br\r\n", "Accept-Encoding: gzip\r\n"}) {
    const Reply page = ask(get("/", takes));
    EXPECT_EQ(page.status, 200);
    EXPECT_TRUE(page.body == bytes) << page.body.size() << " bytes of " << bytes.size();
    EXPECT_THAT(page.head, HasSubstr("Content-Encoding: gzip\r\n"));
    EXPECT_EQ(page.head.find("Content-Encoding"), page.head.rfind("Content-Encoding")) << "once";
    EXPECT_THAT(page.head, HasSubstr("Content-Security-Policy: default-src 'self'\r\n"));
  }
}

TEST_F(ServerTest, NoAnswerMayBeReadByAnotherSiteOrKeptOrFramed) {
  serve();
  for (const char* target : {"/", "/api/time", "/metrics", "/nowhere"}) {
    const Reply reply = ask(get(target, "Origin: http://evil.example\r\n"));
    EXPECT_THAT(reply.head, HasSubstr("X-Content-Type-Options: nosniff\r\n")) << target;
    EXPECT_THAT(reply.head, HasSubstr("X-Frame-Options: DENY\r\n"));
    EXPECT_THAT(reply.head, HasSubstr("Cache-Control: no-store\r\n"));
    EXPECT_THAT(reply.head, HasSubstr("Cross-Origin-Resource-Policy: same-origin\r\n"));
    EXPECT_THAT(reply.head, Not(HasSubstr("Access-Control")));
  }
}

TEST_F(ServerTest, AWatcherGetsWhatIsOnTheStageAndThenWhatIsNew) {
  serve();
  server_->stage().show(Scene::kHello, R"({"server":"a"})");
  server_->stage().show(Scene::kMission, R"({"name":"paper"})");
  server_->stage().show(Scene::kStatus, R"({"calm":true})");
  server_->stage().happen(R"({"number":"1"})");
  Connection watcher = watch();
  ASSERT_TRUE(watcher.reads("event: happening\ndata: {\"number\":\"1\"}\n\n")) << watcher.got();
  EXPECT_THAT(watcher.got(), HasSubstr("Content-Type: text/event-stream\r\n"));
  EXPECT_THAT(watcher.got(), HasSubstr("event: hello\ndata: {\"server\":\"a\"}\n\nevent: mission\ndata: "
                                       "{\"name\":\"paper\"}\n\nevent: status\ndata: {\"calm\":true}\n\n"));
  EXPECT_EQ(server_->stage().watchers(), 1);
  for (int i = 0; i < 100; ++i) {
    const std::string frame = "{\"i\":" + std::to_string(i) + "}";
    server_->stage().show(Scene::kFrame, frame);
    ASSERT_TRUE(watcher.reads("event: frame\ndata: " + frame + "\n\n")) << i;
  }
}

TEST_F(ServerTest, WhatIsNotThereIsSaidInWords) {
  serve();
  const Reply nowhere = ask(get("/nowhere"));
  EXPECT_EQ(nowhere.status, 404);
  EXPECT_THAT(words(nowhere), HasSubstr("nothing at /nowhere: the page is at /"));
  EXPECT_THAT(words(ask(post("/api/nothing", "{}"))), HasSubstr("nothing at /api/nothing"));
}

TEST_F(ServerTest, AMethodThatAPathIsNotForIsToldTheOthers) {
  serve();
  for (const char* target : {"/", "/api/events", "/api/time", "/metrics"}) {
    const Reply reply = ask(post(target, kEngage));
    EXPECT_EQ(reply.status, 405) << target;
    EXPECT_THAT(reply.head, HasSubstr("\r\nAllow: GET, HEAD\r\n")) << target;
    EXPECT_EQ(words(reply), std::string(target) + " is there for GET, HEAD only");
  }
  for (const char* target : {"/api/order", "/api/check", "/api/hurt"}) {
    const Reply reply = ask(get(target));
    EXPECT_EQ(reply.status, 405) << target;
    EXPECT_THAT(reply.head, HasSubstr("\r\nAllow: POST\r\n")) << target;
  }
  Reply head = ask("HEAD /api/time HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.body, "");
}

TEST_F(ServerTest, TellsItsTimeAndItsFigures) {
  serve();
  const double before_s = json::parse(ask(get("/api/time")).body)["server_time_s"];
  const double after_s = json::parse(ask(get("/api/time")).body)["server_time_s"];
  EXPECT_GE(before_s, 0.0);
  EXPECT_GT(after_s, before_s);
  server_->set_metrics("gyre_calm 1\n");
  const Reply metrics = ask(get("/metrics"));
  EXPECT_EQ(metrics.body, "gyre_calm 1\n");
  EXPECT_THAT(metrics.head, HasSubstr("Content-Type: text/plain; version=0.0.4\r\n"));
}

TEST_F(ServerTest, OneConnectionCarriesManyRequests) {
  serve();
  Connection connection = connect();
  for (int i = 0; i < 20; ++i) {
    connection.forget();
    connection.send("GET /api/time HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    ASSERT_TRUE(connection.reads("server_time_s")) << i;
  }
  connection.forget();
  std::string several;
  for (int i = 0; i < 3; ++i) several += "GET /api/time HTTP/1.1\r\nHost: " + host() + "\r\n\r\n";
  connection.send(several + get("/metrics"));
  ASSERT_TRUE(connection.reads_the_end());
  std::size_t replies = 0;
  for (std::size_t at = 0; (at = connection.got().find("HTTP/1.1 200", at)) != std::string::npos; ++at) ++replies;
  EXPECT_EQ(replies, 4U) << "sent at once";
}

// -------------------------------------------------------------------------------------------------------- orders

TEST_F(ServerTest, AnOrderIsHandedOnAndAnswered) {
  serve();
  auto answer =
      std::async(std::launch::async, [&] { return ask(post("/api/order", R"({"kind":"PACE","pace":0.5})")); });
  const PageRequest request = next_request();
  const auto* command = std::get_if<protocol::Command>(&request.wish);
  ASSERT_NE(command, nullptr);
  EXPECT_EQ(command->kind, protocol::CommandKind::kPace);
  EXPECT_EQ(command->pace, 0.5);
  request.answer->set_value({true, "the swarm goes to 50 % of its pace"});
  const Reply reply = answer.get();
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(json::parse(reply.body), (json{{"done", true}, {"text", "the swarm goes to 50 % of its pace"}}));
}

TEST_F(ServerTest, AHurtIsHandedOnAndAnswered) {
  serve();
  auto answer =
      std::async(std::launch::async, [&] { return ask(post("/api/hurt", R"({"kind":"KILL","process":"agent 3"})")); });
  const PageRequest request = next_request();
  ASSERT_TRUE(std::holds_alternative<HurtRequest>(request.wish));
  EXPECT_EQ(std::get<HurtRequest>(request.wish).process, "agent 3");
  request.answer->set_value({false, "agent 3 has ended"});
  EXPECT_EQ(words(answer.get()), "agent 3 has ended");
}

TEST_F(ServerTest, WithoutTheTokenNothingIsAskedFor) {
  serve();
  for (const std::string token : {"", "X-Gyre-Token: \r\n", "X-Gyre-Token: wrong\r\n",
                                  "X-Gyre-Token: 0123456789abcde\r\n", "X-Gyre-Token: 0123456789abcdef0\r\n",
                                  "Authorization: Bearer 0123456789abcdef\r\n", "Cookie: token=0123456789abcdef\r\n"}) {
    for (const char* target : {"/api/order", "/api/check", "/api/hurt"}) {
      const Reply reply = ask(post(target, kEngage, token));
      EXPECT_EQ(reply.status, 401) << target << " " << token;
      EXPECT_THAT(words(reply), HasSubstr("need the token"));
    }
  }
  EXPECT_EQ(ask(post("/api/order?token=0123456789abcdef", kEngage, "")).status, 401) << "an address is written to logs";
  EXPECT_TRUE(server_->take_requests().empty());
}

TEST_F(ServerTest, ForeignPagesGetNothingDone) {
  serve();
  const std::string token = std::string("X-Gyre-Token: ") + kToken + "\r\n";
  const std::vector<std::string> foreign{"http://evil.example", "null", "https://" + host(), "http://127.0.0.1:1"};
  for (const std::string& origin : foreign) {
    const Reply reply = ask(post("/api/order", kEngage, token + "Origin: " + origin + "\r\n"));
    EXPECT_EQ(reply.status, 403) << origin;
    EXPECT_THAT(words(reply), HasSubstr("own page"));
  }
  EXPECT_EQ(ask("OPTIONS /api/order HTTP/1.1\r\nHost: " + host() +
                "\r\nOrigin: http://evil.example\r\nAccess-Control-Request-Method: POST\r\nConnection: close\r\n\r\n")
                .status,
            405)
      << "a browser that asks first is not told that it may";
  EXPECT_TRUE(server_->take_requests().empty());
  auto own = std::async(std::launch::async,
                        [&] { return ask(post("/api/order", kEngage, token + "Origin: http://" + host() + "\r\n")); });
  next_request().answer->set_value({true, "done"});
  EXPECT_EQ(own.get().status, 200);
}

TEST_F(ServerTest, ForeignNamesForThisMachineGetNothingAtAll) {
  auto with = options();
  with.hosts = {"lab.example"};
  serve(with);
  for (const std::string name : {"evil.example", "evil.example:80", "", "localhost.evil.example"}) {
    for (const char* target : {"/", "/api/events", "/api/time", "/metrics", "/nowhere"}) {
      const Reply reply =
          ask(std::string("GET ") + target + " HTTP/1.1\r\nHost: " + name + "\r\nConnection: close\r\n\r\n");
      EXPECT_EQ(reply.status, 403) << name << " " << target;
      EXPECT_THAT(words(reply), HasSubstr("--host"));
    }
  }
  EXPECT_EQ(ask("GET / HTTP/1.1\r\nConnection: close\r\n\r\n").status, 403) << "no name at all";
  for (const char* name : {"localhost", "lab.example:8480", "[::1]:8480", "10.1.2.3"}) {
    EXPECT_EQ(ask(std::string("GET / HTTP/1.1\r\nHost: ") + name + "\r\nConnection: close\r\n\r\n").status, 200)
        << name;
  }
}

TEST_F(ServerTest, BadOrdersAreAnsweredWithTheirFieldAndGoNowhere) {
  serve();
  EXPECT_THAT(words(ask(post("/api/order", R"({"kind":"PACE","pace":7})"))), StartsWith("pace: "));
  EXPECT_EQ(ask(post("/api/order", "{")).status, 400);
  EXPECT_THAT(words(ask(post("/api/hurt", R"({"kind":"KILL"})"))), StartsWith("process: "));
  EXPECT_EQ(ask(post("/api/check", "[]")).status, 400);
  const Reply check = ask(post("/api/check", R"({"mission":"load {"})"));
  EXPECT_EQ(check.status, 200);
  EXPECT_EQ(json::parse(check.body)["readable"], false);
  EXPECT_TRUE(server_->take_requests().empty());
}

TEST_F(ServerTest, ARecordingTakesNoOrders) {
  auto with = options();
  with.takes_orders = false;
  serve(with);
  for (const char* target : {"/api/order", "/api/hurt"}) {
    const Reply reply = ask(post(target, kEngage));
    EXPECT_EQ(reply.status, 409);
    EXPECT_THAT(words(reply), HasSubstr("recording"));
  }
}

TEST_F(ServerTest, WhoAsksTooOftenIsAskedToBeSlower) {
  serve();
  int refused = 0;
  for (int i = 0; i < 200 && refused == 0; ++i) {
    const Reply reply = ask(post("/api/order", "{"));
    if (reply.status != 429) continue;
    ++refused;
    EXPECT_THAT(words(reply), HasSubstr("slower"));
  }
  // Ten a second are let through for ever; two hundred one after the other come faster than that on any machine.
  EXPECT_EQ(refused, 1);
}

// ------------------------------------------------------------------------------------------------- begin and end

TEST_F(ServerTest, APortThatIsTakenIsSaidWithTheCure) {
  serve();
  auto with = options();
  with.port = port_;
  const auto second = PageServer::open(with);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().text, HasSubstr("port " + std::to_string(port_)));
  EXPECT_THAT(second.error().text, HasSubstr("--port"));
  EXPECT_EQ(ask(get("/api/time")).status, 200) << "the first one does not notice";
  with.address = "203.0.113.7";
  EXPECT_FALSE(PageServer::open(with)) << "no address of this machine";
}

TEST_F(ServerTest, WithoutAPortOfItsOwnItTakesTheNextOne) {
  auto with = options();
  with.port.reset();
  std::vector<std::unique_ptr<PageServer>> several;
  std::set<std::string> urls;
  for (int i = 0; i < 3; ++i) {
    auto opened = PageServer::open(with);
    if (!opened) GTEST_SKIP() << "others have the ports: " << opened.error().text;
    several.push_back(std::move(opened).value());
    urls.insert(several.back()->url());
  }
  EXPECT_EQ(urls.size(), 3U);
}

TEST_F(ServerTest, ItsAddressIsForABrowser) {
  auto with = options();
  serve(with);
  EXPECT_EQ(server_->url(), "http://" + host() + "/#token=" + kToken);
  EXPECT_EQ(server_->url(false), "http://" + host() + "/");
  with.address = "0.0.0.0";
  serve(with);
  EXPECT_THAT(server_->url(false), StartsWith("http://127.0.0.1:"));
  with.address = "::1";
  auto six = PageServer::open(with);
  if (!six) GTEST_SKIP() << "no IPv6 here: " << six.error().text;
  EXPECT_THAT(six.value()->url(false), testing::MatchesRegex("http://\\[::1\\]:[0-9]+/"));
}

TEST_F(ServerTest, EndsWhateverItsConnectionsDo) {
  auto with = options();
  const std::chrono::milliseconds ever = std::chrono::hours(1);
  with.bounds.request_time = with.bounds.idle_time = with.bounds.write_time = ever;
  serve(with);
  server_->stage().show(Scene::kHello, "{}");
  Connection watcher = watch(), deaf = watch(), idle = connect(), slow = connect(), kept = connect();
  slow.send("POST /api/order HTTP/1.1\r\nHost: ");
  kept.send("GET /api/time HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
  ASSERT_TRUE(kept.reads("server_time_s"));
  const std::string large(4 << 20, 'x');
  for (int i = 0; i < 8; ++i) {  // more than lies between: the server has to wait for whoever is deaf
    server_->stage().show(Scene::kStatus, large + std::to_string(i));
    ASSERT_TRUE(watcher.reads("x" + std::to_string(i) + "\n"));
    watcher.forget();
  }
  Connection taken = connect(), waiting = connect();
  taken.send(post("/api/order", kEngage));
  const PageRequest held = next_request();  // its promise outlives the server
  waiting.send(post("/api/order", kEngage));
  server_.reset();
  EXPECT_TRUE(watcher.reads_the_end());
  EXPECT_TRUE(idle.reads_the_end());
  EXPECT_TRUE(slow.reads_the_end());
  EXPECT_TRUE(kept.reads_the_end());
  for (Connection* order : {&taken, &waiting}) {
    EXPECT_TRUE(order->reads_the_end());
    const Reply reply = reply_of(order->got());
    if (reply.status == 0) continue;  // it was not read any more
    EXPECT_EQ(reply.status, 503);
    EXPECT_EQ(words(reply), "the server ends");
  }
}

TEST_F(ServerTest, WhoWaitsForAnAnswerWhenItEndsIsToldSo) {
  serve();
  auto waiting = std::async(std::launch::async, [&] { return ask(post("/api/order", kEngage)); });
  const PageRequest held = next_request();
  server_.reset();
  const Reply reply = waiting.get();
  EXPECT_EQ(reply.status, 503);
  EXPECT_EQ(words(reply), "the server ends");
}

}  // namespace
}  // namespace gyre::ground
