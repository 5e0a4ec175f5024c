#pragma once
// The page for a main loop: told what is heard, it shows it, and says what persons ask for.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/dds/node.hpp"
#include "common/program/command_line.hpp"
#include "ground/page/page_feed.hpp"
#include "ground/page/page_server.hpp"
#include "ground/swarm/core/order_desk.hpp"

namespace gyre::ground {

/// Where it is served, from the command line.
struct PageOptions {
  std::optional<std::string> address;  ///< absent: of this machine only
  std::optional<int> port;
  std::optional<std::string> token;  ///< absent: one is made
  std::vector<std::string> hosts;

  /// Whether any of them was given.
  [[nodiscard]] bool any() const { return address || port || token || !hosts.empty(); }
};

/// What is wrong with them, and what would be right.
[[nodiscard]] std::optional<std::string> objection(const PageOptions& options);

/// --address, --port, --token, --host.
[[nodiscard]] std::vector<program::Option> page_options(PageOptions& options);

/// Who asked for it waits for the answer.
struct HurtTask {
  HurtRequest wish;
  std::shared_ptr<std::promise<Answer>> answer;
};

class Page {
 public:
  /// `node`, over which orders go (nullptr: there is nobody to give them to), and `view` outlive it. Errors: an
  /// objection to the options, or as PageServer::open.
  [[nodiscard]] static Result<std::unique_ptr<Page>> open(const PageOptions& options, const PageOwner& owner,
                                                          dds::Node* node, const SwarmView& view);

  /// After every message that the view believed.
  void hear(LocalTime now, const SwarmMessage& message);
  /// As often as the loop turns, at least at every frame.
  void step(LocalTime now, const std::vector<OwnProcess>& own = {});
  /// What somebody wants done to the processes; nobody's own are nobody's to hurt.
  [[nodiscard]] std::vector<HurtTask> take_hurts();

  [[nodiscard]] PageFeed& feed() { return feed_; }
  [[nodiscard]] std::string url() const { return server_->url(); }

 private:
  Page(std::unique_ptr<PageServer> server, const PageOwner& owner, dds::Node* node, const SwarmView& view);

  std::unique_ptr<PageServer> server_;
  PageFeed feed_;
  bool owns_processes_;
  dds::Writer<protocol::Command> commands_;
  OrderDesk desk_;
  std::map<std::uint64_t, std::shared_ptr<std::promise<Answer>>> waiting_;  ///< by the command's id
  std::vector<HurtTask> hurts_;
};

}  // namespace gyre::ground
