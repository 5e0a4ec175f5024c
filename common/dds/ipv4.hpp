#pragma once
// Addresses are given as numbers, never as names: a flight does not wait for a name server.

#include <arpa/inet.h>

#include <string>

namespace gyre::dds {

[[nodiscard]] inline bool is_ipv4(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1;
}

}  // namespace gyre::dds
