// The page of real flights, as a browser sees it: what is shown, what is ordered, what is hurt, and who comes back.

#include <gmock/gmock.h>

#include "tests/page/event_stream.hpp"
#include "tests/processes/launched.hpp"

namespace gyre::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kFlight_s = 60.0;  // a bound, not a measure

class PageTest : public ProgramsTest {
 protected:
  struct Address {
    int port = 0;
    std::string token;
  };
  /// As it is printed for a person to open.
  static Address address_of(Launched& server) {
    if (!server.says_within(kFlight_s, "#token=")) {
      ADD_FAILURE() << "no address: " << server.said();
      return {};
    }
    const std::string said = server.said();
    const std::size_t port = said.find("http://127.0.0.1:") + 17, token = said.find("#token=") + 7;
    return {std::stoi(said.substr(port)), said.substr(token, said.find_first_of(" \n", token) - token)};
  }
  static json ask(const Address& there, const std::string& target, const json& wish) {
    Connection connection(there.port);
    const std::string body = wish.dump();
    connection.send("POST " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(there.port) +
                    "\r\nX-Gyre-Token: " + there.token +
                    "\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    EXPECT_TRUE(connection.reads_the_end());
    const std::size_t begin = connection.got().find("\r\n\r\n");
    return begin == std::string::npos ? json() : json::parse(connection.got().substr(begin + 4), nullptr, false);
  }
  static json process(const json& status, const std::string& name) {
    for (const json& one : status["processes"]) {
      if (one["name"] == name) return one;
    }
    return {{"name", name}, {"state", "no line"}, {"pid", 0}};
  }
  static auto paced(double low, double high) {
    return [=](const json& frame) { return frame["pace"] >= low && frame["pace"] <= high; };
  }
  static std::string domain_of(const Launched& flight) {
    const std::string said = flight.said();
    const std::size_t at = said.find("on domain ");
    return at == std::string::npos ? "0" : std::to_string(std::stoi(said.substr(at + 10)));
  }
};

TEST_F(PageTest, AFlightIsShownOrderedHurtAndEnded) {
  Launched flight = gyre({"fly", quick_mission(), "--page", "--port", "0"});
  const Address page = address_of(flight);
  EventStream stream(page.port);
  const auto hello = stream.until("hello", [](const json&) { return true; });
  ASSERT_TRUE(hello) << flight.said();
  EXPECT_EQ((*hello)["owns_processes"], true);
  const auto mission = stream.until("mission", [](const json& m) { return m["complete"] == true; });
  ASSERT_TRUE(mission) << flight.said();
  EXPECT_EQ((*mission)["name"], "quick");
  EXPECT_EQ((*mission)["carriers"].size(), 4U);
  const auto flying = stream.until("frame", paced(1.0, 1.0));
  ASSERT_TRUE(flying) << flight.said();
  EXPECT_EQ((*flying)["carriers"].size(), 4U);
  EXPECT_GT((*flying)["carriers"][0]["tension_n"], 0.0);

  const json slower = ask(page, "/api/order", {{"kind", "PACE"}, {"pace", 0.5}});
  EXPECT_EQ(slower["done"], true) << slower;
  EXPECT_TRUE(stream.until("frame", paced(0.49, 0.51))) << flight.said();

  for (const json& wish : {json{{"kind", "PUSH"}, {"force_w_n", {0.0, 0.0, 1000.0}}, {"duration_s", 0.5}},
                           json{{"kind", "SHIFT_CLOCK"}, {"process", "agent 2"}, {"amount", -100.0}},
                           json{{"kind", "CONTINUE"}, {"process", "agent 2"}}}) {
    const json refused = ask(page, "/api/hurt", wish);
    EXPECT_EQ(refused["done"], false) << refused << ": what its process would refuse, or does as it is";
  }
  const json killed = ask(page, "/api/hurt", {{"kind", "KILL"}, {"process", "agent 2"}});
  EXPECT_EQ(killed["done"], true) << killed;
  const auto ended = stream.until("status", [&](const json& s) { return process(s, "agent 2")["state"] == "ended"; });
  ASSERT_TRUE(ended) << flight.said();
  EXPECT_EQ(process(*ended, "agent 2")["pid"], 0);
  EXPECT_EQ(process(*ended, "agent 2")["well"], false);
  EXPECT_TRUE(stream.until("status", [](const json& s) {
    return s["complaint"].get<std::string>().find("carrier 2 is silent") != std::string::npos;
  })) << "it is missed";
  const json again = ask(page, "/api/hurt", {{"kind", "RESTART"}, {"process", "agent 2"}});
  EXPECT_EQ(again["done"], true) << again;
  const auto back = stream.until("status", [&](const json& s) {
    return process(s, "agent 2")["state"] == "flying" && process(s, "agent 2")["well"] == true && s["calm"] == true;
  });
  ASSERT_TRUE(back) << flight.said();
  EXPECT_GT(process(*back, "agent 2")["pid"], 0);
  const double moved_m = std::stod((*back)["hurt"]["moved_max_m"].dump());
  std::printf("an agent killed at half the pace and started anew: the load moved by %.4f mm\n",
              1e3 * (*back)["displacement_max_m"].get<double>());
  EXPECT_LT(moved_m, 0.001);
  EXPECT_LT((*back)["displacement_max_m"], 0.001);

  flight.send(SIGINT);
  EXPECT_EQ(flight.end_within(kFlight_s).exit_code, 0) << flight.said();
  for (const char* words : {"by hand: asked to pace 0.5", "by hand: agent 2 was killed",
                            "by hand: agent 2 was started anew", "no verdict"}) {
    EXPECT_THAT(flight.said(), HasSubstr(words));
  }
}

TEST_F(PageTest, AServerThatIsKilledAndStartedAgainIsFoundAgain) {
  Launched flight = gyre({"fly", quick_mission(), "--duration", "60"});
  ASSERT_TRUE(flight.says_within(kFlight_s, "on domain ")) << flight.said();
  const std::string domain = domain_of(flight);
  const auto connected = [](const json& s) { return s["connected"] == true; };
  json first_hello;
  Address first;
  {
    Launched server = gyre({"serve", "--domain", domain, "--port", "0"});
    first = address_of(server);
    EventStream stream(first.port);
    first_hello = stream.until("hello", [](const json&) { return true; }).value_or(json());
    EXPECT_TRUE(stream.until("status", connected)) << server.said();
    const json hurt = ask(first, "/api/hurt", {{"kind", "KILL"}, {"process", "agent 2"}});
    EXPECT_EQ(hurt["done"], false) << "it did not start these processes";
    server.send(SIGKILL);
    server.end_within(5.0);
    while (stream.next()) {
    }
  }
  Launched server = gyre({"serve", "--domain", domain, "--port", std::to_string(first.port), "--token", "a-token"});
  EXPECT_EQ(address_of(server).port, first.port);
  EventStream stream(first.port);
  const auto hello = stream.until("hello", [](const json&) { return true; });
  ASSERT_TRUE(hello) << server.said();
  EXPECT_NE((*hello)["server"], first_hello["server"]) << "what was shown before is forgotten";
  EXPECT_TRUE(stream.until("status", connected)) << server.said();
  EXPECT_TRUE(stream.until("mission", [](const json& m) { return m["complete"] == true; })) << server.said();

  Launched second = gyre({"serve", "--domain", domain, "--port", std::to_string(first.port)});
  EXPECT_EQ(second.end_within(20.0).exit_code, 1);
  EXPECT_THAT(second.said(), HasSubstr("port " + std::to_string(first.port)));
  EXPECT_THAT(second.said(), HasSubstr("--port"));
  EXPECT_TRUE(stream.until("frame", [](const json&) { return true; })) << "the first does not notice";

  server.send(SIGTERM);
  EXPECT_EQ(server.end_within(10.0).exit_code, 0) << server.said();
  flight.send(SIGTERM);
  EXPECT_EQ(flight.end_within(kFlight_s).exit_code, 0) << flight.said();
}

}  // namespace
}  // namespace gyre::test
