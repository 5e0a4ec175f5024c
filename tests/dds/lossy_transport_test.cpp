// Packets lost on purpose: how many, each for itself, and none where nobody asked for it.

#include "common/dds/lossy_transport.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "common/dds/transport_stack.hpp"

namespace gyre {
namespace {

namespace fast = dds::fast;

constexpr std::uint64_t kSeed = 7;

/// Five deviations of what chance does to a share of `count` throws.
double by_chance(double share, int count) {
  return 5.0 * std::sqrt(share * (1.0 - share) / count);
}

class Receiver final : public fast::TransportReceiver {
 public:
  void OnDataReceived(const fast::rtps::octet* /*data*/, std::uint32_t size, const fast::rtps::Locator_t& /*local*/,
                      const fast::rtps::Locator_t& /*remote*/) override {
    ++received;
    bytes = size;
  }
  int received = 0;
  std::uint32_t bytes = 0;
};

class Loss : public testing::Test {
 protected:
  Loss() {
    for (int port = 1; port <= kDestinations; ++port) to_.push_back(fast::udp_locator("127.0.0.1", port));
  }

  /// Sends one datagram to every destination; whether each was sent to.
  std::vector<bool> send() {
    std::vector<bool> reached(kDestinations, false);
    fast::Sender below([&](auto&& /*datagram*/, std::uint32_t bytes, fast::LocatorsIterator* begin,
                           fast::LocatorsIterator* end, const auto& /*timeout*/) {
      EXPECT_EQ(bytes, kBytes);
      for (fast::LocatorsIterator& to = *begin; to != *end; ++to) reached.at((*to).port - 1) = true;
      ++calls_;
      return true;
    });
    fast::Locators begin(to_.begin());
    fast::Locators end(to_.end());
    EXPECT_TRUE(transport_.send(&below, {}, kBytes, &begin, &end, {})) << "to the sender, what is lost is sent";
    return reached;
  }

  static constexpr int kDestinations = 4;
  static constexpr std::uint32_t kBytes = 100;
  std::shared_ptr<dds::PacketLoss> loss_ = std::make_shared<dds::PacketLoss>(kSeed);
  dds::LossyTransportDescriptor descriptor_{std::make_shared<fast::UdpTransport>(), loss_};
  dds::LossyTransport transport_{descriptor_, loss_};
  fast::LocatorList to_;
  int calls_ = 0;
};

TEST_F(Loss, IsNoneUntilAskedForAndAfterItIsOver) {
  const auto expect_whole = [&] {
    Receiver receiver;
    for (int i = 0; i < 1000; ++i) {
      EXPECT_EQ(send(), std::vector<bool>(kDestinations, true));
      transport_.receive(&receiver, nullptr, kBytes, {}, {});
    }
    EXPECT_EQ(receiver.received, 1000);
    EXPECT_EQ(receiver.bytes, kBytes);
  };
  expect_whole();
  loss_->set_share(1.0);
  EXPECT_EQ(send(), std::vector<bool>(kDestinations, false));
  loss_->set_share(0.0);
  expect_whole();
}

TEST_F(Loss, IsOfTheShareAskedForInAndOut) {
  constexpr int kCount = 20000;
  for (const double share : {0.01, 0.3, 0.9}) {
    loss_->set_share(share);
    int sent = 0;
    Receiver receiver;
    for (int i = 0; i < kCount; ++i) {
      for (const bool reached : send()) sent += reached ? 1 : 0;
      transport_.receive(&receiver, nullptr, kBytes, {}, {});
    }
    EXPECT_NEAR(1.0 - static_cast<double>(sent) / kDestinations / kCount, share,
                by_chance(share, kDestinations * kCount));
    EXPECT_NEAR(1.0 - static_cast<double>(receiver.received) / kCount, share, by_chance(share, kCount));
  }
}

// One throw for all would lose a beacon for the whole swarm, or for nobody.
TEST_F(Loss, OfOneDestinationSaysNothingOfTheOthers) {
  constexpr int kCount = 20000;
  loss_->set_share(0.5);
  int alike = 0;
  int after_a_loss = 0;
  int losses = 0;
  bool before = true;
  for (int i = 0; i < kCount; ++i) {
    const std::vector<bool> reached = send();
    alike += reached[0] == reached[1] ? 1 : 0;
    if (!before) {
      ++losses;
      after_a_loss += reached[0] ? 0 : 1;
    }
    before = reached[0];
  }
  EXPECT_NEAR(static_cast<double>(alike) / kCount, 0.5, by_chance(0.5, kCount));
  EXPECT_NEAR(static_cast<double>(after_a_loss) / losses, 0.5, by_chance(0.5, losses)) << "nor of the next packet";
}

TEST_F(Loss, OfEverythingSendsNothing) {
  loss_->set_share(1.0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(send(), std::vector<bool>(kDestinations, false));
  EXPECT_EQ(calls_, 0);
}

TEST(PacketLoss, IsTheSameForASeedAndAnotherForAnother) {
  const auto draw = [](std::uint64_t seed) {
    dds::PacketLoss loss(seed);
    loss.set_share(0.5);
    std::vector<bool> lost(64);
    for (std::size_t i = 0; i < lost.size(); ++i) lost[i] = loss.loses_next();
    return lost;
  };
  EXPECT_EQ(draw(1), draw(1));
  EXPECT_NE(draw(1), draw(2));
}

// Fast DDS receives in one thread per port, and every writer sends in its own.
TEST(PacketLoss, MayBeAskedByManyThreadsAtOnce) {
  constexpr int kThreads = 4;
  constexpr int kEach = 20000;
  dds::PacketLoss loss(kSeed);
  loss.set_share(0.3);
  std::atomic<int> lost{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&] {
      for (int j = 0; j < kEach; ++j) lost += loss.loses_next() ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_NEAR(static_cast<double>(lost) / (kThreads * kEach), 0.3, by_chance(0.3, kThreads * kEach));
}

TEST(TransportStack, IsUdpAloneOutsideALaboratory) {
  fast::api::TransportConfigQos transport;
  dds::stack_transports(transport, {"127.0.0.1", 4, nullptr});
  ASSERT_EQ(transport.user_transports.size(), 1U);
  EXPECT_FALSE(transport.use_builtin_transports);
  const auto* udp = dynamic_cast<const fast::UdpTransport*>(transport.user_transports.front().get());
  ASSERT_TRUE(udp);
  EXPECT_EQ(udp->interfaceWhiteList, std::vector<std::string>{"127.0.0.1"});
  EXPECT_EQ(udp->maxInitialPeersRange, 4U);
}

TEST(TransportStack, HasTheLossAroundWhateverIsThere) {
  const auto loss = std::make_shared<dds::PacketLoss>(kSeed);
  fast::api::TransportConfigQos transport;
  transport.user_transports.resize(2, std::make_shared<fast::UdpTransport>());
  dds::stack_transports(transport, {"127.0.0.1", 4, loss});
  ASSERT_EQ(transport.user_transports.size(), 2U) << "a profile's transports stay";
  for (const auto& stack : transport.user_transports) {
    EXPECT_TRUE(dynamic_cast<const dds::LossyTransportDescriptor*>(stack.get()));
  }
  fast::api::TransportConfigQos ours;
  dds::stack_transports(ours, {"127.0.0.1", 4, loss});
  ASSERT_TRUE(dynamic_cast<const dds::LossyTransportDescriptor*>(ours.user_transports.front().get()));
  EXPECT_EQ(ours.user_transports.front()->max_initial_peers_range(), 4U) << "the star finds its peers as before";
}

}  // namespace
}  // namespace gyre
