#include "ground/page/page.hpp"

#include <random>
#include <utility>

#include "common/base/text.hpp"
#include "common/dds/clock.hpp"
#include "ground/page/core/door.hpp"

namespace gyre::ground {
namespace {

std::uint64_t fresh_number() {
  std::random_device source;
  return (static_cast<std::uint64_t>(source()) << 32) | source();
}

std::string fresh_token() {
  return text("%016llx%016llx", static_cast<unsigned long long>(fresh_number()),
              static_cast<unsigned long long>(fresh_number()));
}

}  // namespace

std::vector<program::Option> page_options(PageOptions& options) {
  return {
      {"--address", &options.address,
       "where to serve the page (else 127.0.0.1); 0.0.0.0: to every network this machine is in"},
      {"--port", &options.port, "its port (else the first free one from 8480 on); 0: any", program::Bounds{0, 65535}},
      {"--token", &options.token, "what orders have to show (else a new one, in the address that is printed)"},
      {"--host", &options.hosts, "a name by which browsers call this machine, beside its addresses"}};
}

std::optional<std::string> objection(const PageOptions& options) {
  if (!options.token || is_token(*options.token)) return std::nullopt;
  return "--token: it stands in an address, so it has 1 to 128 letters, digits, or - . _ ~, and nothing else; without "
         "--token one is made";
}

Page::Page(std::unique_ptr<PageServer> server, const PageOwner& owner, dds::Node* node, const SwarmView& view)
    : server_(std::move(server)),
      feed_(view, server_->stage(), owner, dds::now()),
      owns_processes_(owner.owns_processes),
      commands_(node ? node->writer<protocol::Command>() : dds::Writer<protocol::Command>()) {}

Result<std::unique_ptr<Page>> Page::open(const PageOptions& options, const PageOwner& asked, dds::Node* node,
                                         const SwarmView& view) {
  if (const auto why = objection(options)) return Error{*why};
  PageServerOptions served;
  served.address = options.address.value_or(served.address);
  served.port = options.port;
  served.token = options.token ? *options.token : fresh_token();
  served.hosts = options.hosts;
  served.takes_orders = asked.takes_orders;
  auto server = PageServer::open(served);
  if (!server) return server.error();
  PageOwner owner = asked;
  owner.server = text("%016llx", static_cast<unsigned long long>(fresh_number()));
  return std::unique_ptr<Page>(new Page(std::move(server).value(), owner, node, view));
}

void Page::hear(LocalTime now, const SwarmMessage& message) {
  feed_.hear(now, message);
  if (const auto* reply = std::get_if<protocol::CommandReply>(&message)) desk_.see(*reply);
}

void Page::step(LocalTime now, const std::vector<OwnProcess>& own) {
  for (PageRequest& request : server_->take_requests()) {
    if (auto* command = std::get_if<protocol::Command>(&request.wish)) {
      command->id = fresh_number();
      waiting_[command->id] = std::move(request.answer);
      desk_.ask(now, *command);
    } else if (owns_processes_) {
      hurts_.push_back({std::get<HurtRequest>(request.wish), std::move(request.answer)});
    } else {
      request.answer->set_value({false, "this server did not start these processes, so it does not hurt them"});
    }
  }
  const OrderDesk::Outputs out = desk_.step(now, commands_.readers() > 0);
  for (const protocol::Command& command : out.send) commands_.write(command);
  for (const OrderAnswer& answer : out.answers) {
    const auto waiting = waiting_.find(answer.command);
    if (waiting == waiting_.end()) continue;
    if (answer.reply) {
      waiting->second->set_value({answer.reply->done, answer.reply->text});
    } else {
      waiting->second->set_value({false, answer.found ? "the coordinator did not answer in time"
                                                      : "no coordinator was found: is one running on this domain?"});
    }
    waiting_.erase(waiting);
  }
  feed_.step(now, own);
  if (auto metrics = feed_.take_metrics()) server_->set_metrics(*metrics);
}

std::vector<HurtTask> Page::take_hurts() {
  return std::exchange(hurts_, {});
}

}  // namespace gyre::ground
