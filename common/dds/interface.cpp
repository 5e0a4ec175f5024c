#include "common/dds/interface.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <unistd.h>

#include <array>
#include <memory>

namespace gyre::dds {

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1;
}

Result<std::string> interface_address(const std::string& name_or_address) {
  if (is_ipv4(name_or_address)) return name_or_address;
  ifaddrs* first = nullptr;
  ::getifaddrs(&first);
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, [](ifaddrs* list) { ::freeifaddrs(list); });
  std::string known;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr, text.data(), text.size());
    if (name_or_address == entry->ifa_name) return std::string(text.data());
    known += std::string(known.empty() ? "" : ", ") + entry->ifa_name + " (" + text.data() + ")";
  }
  return Error{"\"" + name_or_address +
               "\" is neither an IPv4 address nor a network interface with one; this machine has " +
               (known.empty() ? "none" : known)};
}

std::string address_of_this_process(const std::string& interface_address) {
  std::array<char, 256> host{};  // cut short and without an end, where a name is longer
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  return interface_address + " (" + host.data() + ", pid " + std::to_string(::getpid()) + ")";
}

}  // namespace gyre::dds
