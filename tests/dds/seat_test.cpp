// One process per seat, and a clear word about who has it.

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "common/dds/node.hpp"
#include "common/dds/seat_lock.hpp"
#include "tests/dds/free_domain.hpp"

namespace gyre {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A child process that has a seat until it is destroyed.
class SittingChild {
 public:
  SittingChild(int domain, int participant) {
    int ready[2];
    int leave[2];
    EXPECT_EQ(::pipe(ready), 0);
    EXPECT_EQ(::pipe(leave), 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(leave[1]);
      const auto lock = dds::SeatLock::take(domain, participant);
      const char answer = lock.ok() ? '1' : '0';
      char end = 0;
      // Returns when the parent closes its end, or ends.
      if (::write(ready[1], &answer, 1) != 1 || ::read(leave[0], &end, 1) != 0) ::_exit(1);
      ::_exit(0);
    }
    char answer = '0';
    EXPECT_EQ(::read(ready[0], &answer, 1), 1);
    EXPECT_EQ(answer, '1');
    for (const int end : {ready[0], ready[1], leave[0]}) ::close(end);
    leave_ = leave[1];
  }
  ~SittingChild() {
    ::close(leave_);
    ::waitpid(pid_, nullptr, 0);
  }
  SittingChild(const SittingChild&) = delete;
  SittingChild& operator=(const SittingChild&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
  int leave_ = -1;
};

TEST(Seat, IsForOneNodeAndTheErrorNamesIt) {
  dds::NodeOptions options;
  const auto first = tests::open_coordinator(options);
  ASSERT_TRUE(first);
  const auto second = dds::Node::open(options);
  ASSERT_FALSE(second);
  const std::string holder = "pid " + std::to_string(::getpid()) + " (dds_seat_test)";
  EXPECT_TRUE(contains(second.error().text, holder)) << second.error().text;
  EXPECT_TRUE(contains(second.error().text, "the coordinator of domain " + std::to_string(options.domain)));
  EXPECT_TRUE(contains(second.error().text, "--domain")) << "the cure";
  EXPECT_EQ(dds::seat_holder(options.seat, options.domain).holder, holder);
}

TEST(Seat, OfAnotherProcessIsNamedAndFreeWhenItEnds) {
  dds::NodeOptions options;
  tests::open_coordinator(options).reset();
  options.seat = {std::nullopt, CarrierId{5}};
  {
    const SittingChild child(options.domain, 8);  // 3 + carrier
    const auto node = dds::Node::open(options);
    ASSERT_FALSE(node);
    const std::string holder = "pid " + std::to_string(child.pid()) + " (dds_seat_test)";
    EXPECT_TRUE(contains(node.error().text, holder)) << node.error().text;
    EXPECT_TRUE(contains(node.error().text, "the agent of carrier 5")) << node.error().text;
    EXPECT_TRUE(dds::seat_holder(options.seat, options.domain).taken);
  }
  EXPECT_FALSE(dds::seat_holder(options.seat, options.domain).taken);
  EXPECT_TRUE(dds::Node::open(options).ok());
}

TEST(Seat, IsFreeAgainWhenItsNodeGoes) {
  dds::NodeOptions options;
  tests::open_coordinator(options).reset();
  EXPECT_FALSE(dds::seat_holder(options.seat, options.domain).taken);
  EXPECT_TRUE(dds::Node::open(options).ok());
}

TEST(Seat, OnAnotherDomainOrAtAnotherIdIsAnotherSeat) {
  // Locks alone, at ids and domains that no node has: Fast DDS takes a participant id only once per process.
  const auto lock = dds::SeatLock::take(dds::kMaxDomain + 1, 0);
  ASSERT_TRUE(lock);
  EXPECT_FALSE(dds::SeatLock::take(dds::kMaxDomain + 1, 0));
  EXPECT_TRUE(dds::SeatLock::take(dds::kMaxDomain + 2, 0));
  EXPECT_TRUE(dds::SeatLock::take(dds::kMaxDomain + 1, 1));
}

TEST(Seat, VisitorsSitBesideEachOther) {
  dds::NodeOptions options;
  const auto coordinator = tests::open_coordinator(options);
  const auto first = tests::open(options, {});
  const auto second = tests::open(options, {});
  EXPECT_TRUE(first && second);
}

constexpr Duration kSoon = std::chrono::milliseconds(50);
constexpr Duration kPatience = std::chrono::seconds(5);

TEST(SeatCall, IsAnsweredByTheMainLoopAndOnlyByIt) {
  const int domain = dds::kMaxDomain + 1;
  EXPECT_FALSE(dds::ask_seat(domain, 0, kSoon)) << "nobody there";
  const auto lock = dds::SeatLock::take(domain, 0);
  ASSERT_TRUE(lock);
  const auto unanswered = dds::ask_seat(domain, 0, kSoon);
  ASSERT_TRUE(unanswered) << "somebody there";
  EXPECT_FALSE(unanswered->answer) << "whose loop does not turn";
  EXPECT_FALSE(unanswered->elsewhere);
  EXPECT_EQ(unanswered->owner, dds::seat_owner(domain, 0));

  std::optional<dds::SeatCall> call;
  std::atomic<bool> over{false};
  std::thread caller([&] {
    call = dds::ask_seat(domain, 0, kPatience);
    over = true;
  });
  while (!over) {
    lock.value().answer({"agent 3", "its vehicle is silent"});
    std::this_thread::yield();
  }
  caller.join();
  ASSERT_TRUE(call && call->answer);
  EXPECT_EQ(call->answer->process, "agent 3");
  EXPECT_EQ(call->answer->complaint, "its vehicle is silent");
}

TEST(SeatCall, ReachesHubsAndAgentsAndNoVisitor) {
  dds::NodeOptions options;
  const auto coordinator = tests::open_coordinator(options);
  const auto agent = tests::open(options, {std::nullopt, kMaxCarrierId});
  const auto visitor = tests::open(options, {});
  ASSERT_TRUE(coordinator && agent && visitor);
  const auto calls = dds::ask_all_seats(options.domain, kSoon);
  ASSERT_EQ(calls.size(), 2U);
  for (const dds::SeatCall& call : calls) EXPECT_FALSE(call.answer);
}

TEST(SeatCall, OfACrowdBlocksNobody) {
  const int domain = dds::kMaxDomain + 1;
  const auto lock = dds::SeatLock::take(domain, 0);
  ASSERT_TRUE(lock);
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(dds::seat_owner(domain, 0)) << "who leaves without an answer";
  for (int i = 0; i < 200; ++i) lock.value().answer({"agent 3", ""});
  std::thread answering([&] {
    for (int i = 0; i < 2000; ++i) {
      lock.value().answer({"agent 3", ""});
      std::this_thread::yield();
    }
  });
  EXPECT_TRUE(dds::ask_seat(domain, 0, kPatience)) << "the next is heard";
  answering.join();
}

TEST(Seat, ThatDoesNotExistIsRefused) {
  dds::NodeOptions options;
  for (const CarrierId carrier : {CarrierId{0}, kMaxCarrierId + 1}) {
    options.seat = {std::nullopt, carrier};
    const auto node = dds::Node::open(options);
    ASSERT_FALSE(node);
    EXPECT_TRUE(contains(node.error().text, "1 to 100")) << node.error().text;
  }
}

TEST(Node, RefusesADomainOutOfRangeAnAddressThatIsNoneAndOneThatIsNotHere) {
  dds::NodeOptions options;
  options.domain = dds::kMaxDomain + 1;
  EXPECT_TRUE(contains(dds::Node::open(options).error().text, "0 to 100"));
  tests::open_coordinator(options).reset();
  options.interface = "nosuch0";
  EXPECT_TRUE(contains(dds::Node::open(options).error().text, "--interface"));
  EXPECT_TRUE(contains(dds::Node::open(options).error().text, "\"nosuch0\""));
  options.interface = "192.0.2.1";  // reserved for documentation
  EXPECT_TRUE(contains(dds::Node::open(options).error().text, "no network interface"));
  options.interface = "127.0.0.1";
  options.peers = {"127.0.0.1", "hub.example"};
  EXPECT_TRUE(contains(dds::Node::open(options).error().text, "\"hub.example\""));
}

TEST(Node, SaysWhenAnotherProgramHasItsPort) {
  dds::NodeOptions options;
  tests::open_coordinator(options).reset();
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * options.domain + 11));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int stranger = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(::bind(stranger, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const auto node = dds::Node::open(options);
  ::close(stranger);
  ASSERT_FALSE(node);
  EXPECT_TRUE(contains(node.error().text, "UDP port " + std::to_string(ntohs(address.sin_port)))) << node.error().text;
}

}  // namespace
}  // namespace gyre
