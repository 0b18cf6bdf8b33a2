// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/transport_check.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <sstream>

#include "common/bus/lcm_url.hpp"

namespace adit {
namespace {

bool is_multicast(const std::string& url) { return url.empty() || url.starts_with("udpm:"); }

std::string contents(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string why_no_lcm(const std::string& url) {
  const std::string what = "no LCM on " + (url.empty() ? "the default URL" : url) + ": ";
  if (is_multicast(url) && !routes_multicast(contents("/proc/net/route"))) {
    return what +
           "no route for multicast, try: "
           "sudo ip link set lo up; sudo ip route add 224.0.0.0/4 dev lo";
  }
  return what + "check the URL, it looks like udpm://239.255.76.67:7667?ttl=0";
}

std::optional<std::string> buffer_advice(const std::string& url) {
  constexpr const char* kPath = "/proc/sys/net/core/rmem_max";
  std::int64_t bytes = 0;
  if (!is_multicast(url) || !(std::ifstream(kPath) >> bytes) || bytes >= kReceiveBufferBytes) {
    return std::nullopt;
  }
  return "receive buffers of " + std::to_string(bytes) +
         " bytes lose large messages, try: sudo sysctl -w net.core.rmem_max=" +
         std::to_string(kReceiveBufferBytes) + " (to stay: deploy/sysctl/60-adit-lcm.conf)";
}

bool routes_multicast(std::string_view proc_net_route) {
  std::istringstream lines{std::string(proc_net_route)};
  std::string line;
  std::getline(lines, line);  // the headings
  while (std::getline(lines, line)) {
    std::istringstream columns(line);
    std::string interface;
    std::string destination;
    columns >> interface >> destination;
    // Little-endian hexadecimal: 224.0.0.0 or a group in it, or the default route.
    if (destination == "00000000" || (destination.size() == 8 && destination[6] == 'E'))
      return true;
  }
  return false;
}

}  // namespace adit
