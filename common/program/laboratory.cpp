#include "common/program/laboratory.hpp"

#include <utility>

#include "common/base/log.hpp"
#include "common/dds/clock.hpp"

namespace gyre::program {

struct Laboratory::Bench {
  explicit Bench(const std::string& process) : judge(process) {}

  dds::Inbox<AskedPush> asked{64};
  protocol::DisturbanceJudge judge;
};

Laboratory::Laboratory(dds::Node& node, const std::string& process, bool listens) : node_(node) {
  if (!listens) return;
  bench_ = std::make_shared<Bench>(process);
  node.read<protocol::Disturbance>([bench = bench_](protocol::Disturbance disturbance, LocalTime arrived) {
    bench->asked.push({arrived, std::move(disturbance)});
  });
  log_warning("laboratory: this process can be disturbed by anybody on its domain");
}

std::vector<AskedPush> Laboratory::perform() {
  std::vector<AskedPush> pushes;
  if (!bench_) return pushes;
  const auto perform = [&](const protocol::Disturbing& what, LocalTime arrived) {
    log(what.notices);
    if (what.share) node_.lose_packets(*what.share);
    if (what.shift) dds::shift_clock(*what.shift);
    if (what.push) pushes.push_back({arrived, *what.push});
  };
  perform(bench_->judge.at(dds::now()), dds::now());
  for (const AskedPush& asked : bench_->asked.wait_until(dds::now())) {
    perform(bench_->judge.take(dds::now(), asked.push), asked.arrived);
  }
  return pushes;
}

std::uint64_t Laboratory::nonsense() const {
  return bench_ ? bench_->judge.nonsense() : 0;
}

}  // namespace gyre::program
