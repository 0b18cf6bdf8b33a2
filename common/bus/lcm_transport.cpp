// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/lcm_transport.hpp"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace adit {

std::string complete_lcm_url(std::string url) {
  const char* const preset = std::getenv("LCM_DEFAULT_URL");
  if (url.empty() && preset != nullptr) url = preset;
  if (url.empty()) url = "udpm://239.255.76.67:7667?ttl=0";
  if (!url.starts_with("udpm:") || url.find("recv_buf_size=") != std::string::npos) return url;
  url += url.find('?') == std::string::npos ? '?' : '&';
  return url + "recv_buf_size=" + std::to_string(kReceiveBufferBytes);
}

namespace {

bool is_multicast(const std::string& url) { return url.empty() || url.starts_with("udpm:"); }

std::string contents(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string lcm_failure_reason(const std::string& url) {
  const std::string what = "cannot open LCM on " + (url.empty() ? "the default URL" : url) + ": ";
  if (is_multicast(url) && !has_multicast_route(contents("/proc/net/route"))) {
    return what +
           "no multicast route, try: "
           "sudo ip link set lo up; sudo ip route add 224.0.0.0/4 dev lo";
  }
  return what + "check the URL, e.g. udpm://239.255.76.67:7667?ttl=0";
}

std::optional<std::string> receive_buffer_advice(const std::string& url) {
  constexpr const char* kPath = "/proc/sys/net/core/rmem_max";
  std::int64_t bytes = 0;
  if (!is_multicast(url) || !(std::ifstream(kPath) >> bytes) || bytes >= kReceiveBufferBytes) {
    return std::nullopt;
  }
  return "receive buffers of " + std::to_string(bytes) +
         " bytes lose large messages, try: sudo sysctl -w net.core.rmem_max=" +
         std::to_string(kReceiveBufferBytes) + " (permanently: deploy/sysctl/60-adit-lcm.conf)";
}

bool has_multicast_route(std::string_view proc_net_route) {
  std::istringstream lines{std::string(proc_net_route)};
  std::string line;
  std::getline(lines, line);  // column headings
  while (std::getline(lines, line)) {
    std::istringstream columns(line);
    std::string interface;
    std::string destination;
    columns >> interface >> destination;
    // Little-endian hexadecimal: 224.0.0.0, a group within it, or the default route.
    if (destination == "00000000" || (destination.size() == 8 && destination[6] == 'E'))
      return true;
  }
  return false;
}

}  // namespace adit
