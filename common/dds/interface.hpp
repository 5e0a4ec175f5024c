#pragma once
// Network interfaces and the addresses of machines.
//
// Machines are given as numbers, never as names: a flight does not wait for a name server. An interface of this machine
// may be given by its name, because its address may be nobody's to know in advance (a container's eth0, a radio's wlan0
// with DHCP).

#include <string>

#include "common/base/result.hpp"

namespace gyre::dds {

[[nodiscard]] bool is_ipv4(const std::string& text);

/// The IPv4 address of an interface of this machine, given by that address or by its name ("eth0"). An address is
/// taken as it is. The error lists the interfaces there are.
[[nodiscard]] Result<std::string> interface_address(const std::string& name_or_address);

/// Where this process is, for people who look for it: "10.0.0.3 (vehicle-3, pid 4711)".
[[nodiscard]] std::string address_of_this_process(const std::string& interface_address);

}  // namespace gyre::dds
