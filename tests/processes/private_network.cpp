#include "tests/processes/private_network.hpp"

#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "tests/processes/hindrance.hpp"

namespace gyre::test {
namespace {

/// What nft says to a ruleset, or to a question; absent when it failed.
std::optional<std::string> nft(const std::string& arguments, const std::string& reason_file = "/dev/null") {
  const std::string command = "PATH=\"$PATH:/usr/sbin:/sbin\" nft " + arguments + " 2>" + reason_file;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string said;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) said += buffer;
  if (::pclose(pipe) != 0) return std::nullopt;
  return said;
}

std::string port_set(const std::vector<std::uint16_t>& ports) {
  std::string listed;
  for (const std::uint16_t port : ports) listed += (listed.empty() ? "{ " : ", ") + std::to_string(port);
  return listed + " }";
}

/// Dropped as it comes in: a packet dropped on its way out would be told to the sender, which no radio does.
std::string table(const std::vector<std::uint16_t>& spared, const std::string& dropping) {
  std::string rules;
  if (!spared.empty()) {
    rules += " udp sport " + port_set(spared) + " accept; udp dport " + port_set(spared) + " accept;";
  }
  return "add table inet faults; delete table inet faults; "
         "table inet faults { chain input { type filter hook input priority 0;" +
         rules + dropping + " }; }";
}

std::string ruleset(int percent, const std::vector<std::uint16_t>& spared) {
  // "below 100 of 100" is refused as a comparison that is always true.
  const std::string dice = percent < 100 ? " numgen random mod 100 < " + std::to_string(percent) : "";
  return table(spared, " meta l4proto udp" + dice + " counter drop;");
}

bool apply(const std::string& rules) {
  const auto begin = std::chrono::steady_clock::now();
  const bool done = nft("'" + rules + "'").has_value();
  Hindrance::took(std::chrono::steady_clock::now() - begin);
  return done;
}

bool raise_loopback() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  request.ifr_flags = IFF_UP | IFF_RUNNING;
  const bool raised = ::ioctl(socket, SIOCSIFFLAGS, &request) == 0;
  ::close(socket);
  return raised;
}

}  // namespace

Result<PrivateNetwork> PrivateNetwork::enter() {
  if (::unshare(CLONE_NEWNET) != 0) {
    return Error{std::string("cannot make a network namespace (") + std::strerror(errno) +
                 "): run as root, with CAP_SYS_ADMIN and CAP_NET_ADMIN in a container"};
  }
  if (!raise_loopback()) return Error{std::string("cannot raise the loopback: ") + std::strerror(errno)};
  if (!nft("--version")) return Error{"nft is missing: apt-get install nftables (deploy/install test does)"};
  if (!apply(ruleset(0, {}))) {
    return Error{"nft cannot drop packets here: the kernel needs nf_tables with numgen; try `modprobe nft_numgen`"};
  }
  return PrivateNetwork{};
}

void PrivateNetwork::lose(int percent, const std::vector<std::uint16_t>& spared) {
  GYRE_ENSURE(apply(ruleset(percent, spared)), "nft takes the ruleset that it took at the start");
}

void PrivateNetwork::cut(const std::vector<std::uint16_t>& ports, const std::vector<std::uint16_t>& spared) {
  const std::string these = port_set(ports);
  const std::string dropping = " udp sport " + these + " counter drop; udp dport " + these + " counter drop;";
  GYRE_ENSURE(apply(table(spared, dropping)), "nft takes a ruleset like the one that it took at the start");
}

std::uint64_t PrivateNetwork::lost() const {
  const std::string rules = nft("list table inet faults").value_or("");
  const std::string before = "counter packets ";
  std::uint64_t lost = 0;
  for (std::size_t at = rules.find(before); at != std::string::npos; at = rules.find(before, at + 1)) {
    lost += std::stoull(rules.substr(at + before.size()));
  }
  return lost;
}

std::vector<std::uint16_t> udp_ports(pid_t pid) {
  const std::string process = "/proc/" + std::to_string(pid);
  std::set<std::string> inodes;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(process + "/fd", failure)) {
    const std::string target = std::filesystem::read_symlink(entry.path(), failure);
    if (target.rfind("socket:[", 0) == 0) inodes.insert(target.substr(8, target.size() - 9));
  }
  // proc(5): sl local_address rem_address st tx:rx tr:when retrnsmt uid timeout inode, and addresses as "hex:hex"
  std::vector<std::uint16_t> ports;
  std::ifstream table(process + "/net/udp");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string field;
    std::string local;
    for (int number = 0; number < 10 && fields >> field; ++number) {
      if (number == 1) local = field;
    }
    if (inodes.count(field) == 0) continue;
    ports.push_back(static_cast<std::uint16_t>(std::stoul(local.substr(local.find(':') + 1), nullptr, 16)));
  }
  return ports;
}

}  // namespace gyre::test
