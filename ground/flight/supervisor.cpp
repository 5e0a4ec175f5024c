#include "ground/flight/supervisor.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>
#include <utility>

namespace gyre::ground {

Result<pid_t> Supervisor::start(const Program& program) {
  GYRE_ENSURE(find(program.name) == nullptr, "process names are unique");
  Result<ChildProcess> process = ChildProcess::start(program.command, log_path(program.name));
  if (!process) return Error{program.name + ": " + process.error().text};
  members_.push_back({program.name, std::move(process).value()});
  return members_.back().process.pid();
}

Result<pid_t> Supervisor::restart(const Program& program) {
  const auto old =
      std::find_if(members_.begin(), members_.end(), [&](const Member& member) { return member.name == program.name; });
  if (old != members_.end()) members_.erase(old);  // kills it and waits
  Result<ChildProcess> process = ChildProcess::start(program.command, log_path(program.name), LogFile::kGoesOn);
  if (!process) return Error{program.name + ": " + process.error().text};
  members_.push_back({program.name, std::move(process).value()});
  return members_.back().process.pid();
}

std::optional<pid_t> Supervisor::pid(const std::string& name) {
  Member* const member = find(name);
  if (!member || member->process.ended()) return std::nullopt;
  return member->process.pid();
}

std::vector<Supervisor::Ended> Supervisor::collect() {
  std::vector<Ended> news;
  for (Member& member : members_) {
    if (member.reported) continue;
    if (const auto end = member.process.ended()) {
      member.reported = true;
      news.push_back({member.name, *end});
    }
  }
  return news;
}

void Supervisor::send(const std::string& name, int signal) {
  if (Member* const member = find(name)) member->process.send(signal);
}

std::vector<std::string> Supervisor::stop(const StopPatience& patience) {
  const auto begin = std::chrono::steady_clock::now();
  const auto all_gone_within = [&](double limit_s) {
    const auto gone = [](Member& member) { return member.process.ended().has_value(); };
    while (!std::all_of(members_.begin(), members_.end(), gone)) {
      if (std::chrono::steady_clock::now() - begin > std::chrono::duration<double>(limit_s)) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  };
  send_all(SIGTERM);
  send_all(SIGCONT);  // one that was stopped would not hear it
  if (!all_gone_within(patience.ask_again_s)) send_all(SIGTERM);
  std::vector<std::string> stubborn;
  if (!all_gone_within(patience.kill_s)) {
    for (Member& member : members_) {
      if (!member.process.ended()) stubborn.push_back(member.name);
    }
  }
  members_.clear();  // kills and waits
  return stubborn;
}

std::string Supervisor::log_path(const std::string& name) const {
  std::string file = name;
  std::replace(file.begin(), file.end(), ' ', '-');
  return log_directory_ + "/" + file + ".log";
}

std::string Supervisor::log_tail(const std::string& name, std::size_t lines) const {
  std::ifstream file(log_path(name));
  std::deque<std::string> last;
  for (std::string line; std::getline(file, line);) {
    if (last.size() == lines) last.pop_front();
    last.push_back(line);
  }
  std::string tail;
  for (const std::string& line : last) tail += line + "\n";
  return tail;
}

Supervisor::Member* Supervisor::find(const std::string& name) {
  const auto found =
      std::find_if(members_.begin(), members_.end(), [&](const Member& member) { return member.name == name; });
  return found == members_.end() ? nullptr : &*found;
}

void Supervisor::send_all(int signal) {
  for (Member& member : members_) member.process.send(signal);
}

}  // namespace gyre::ground
