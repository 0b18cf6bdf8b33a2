// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/request_origin.hpp"

#include <algorithm>
#include <array>

#include <arpa/inet.h>
#include <unistd.h>

namespace adit {
namespace {

/// The host of "host", "host:port", "[::1]" or "[::1]:port".
std::string host_of(std::string_view header) {
  if (header.starts_with('[')) {
    const std::size_t end = header.find(']');
    return std::string(header.substr(1, end == std::string_view::npos ? end : end - 1));
  }
  return std::string(header.substr(0, header.find(':')));
}

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

std::string own_name() {
  constexpr std::size_t kLengthMax = 256;
  std::array<char, kLengthMax> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.data();
}

}  // namespace

bool is_own_host(std::string_view host_header) {
  const std::string host = host_of(host_header);
  return host == "localhost" || is_address(host) || (!host.empty() && host == own_name());
}

bool is_allowed_origin(std::string_view origin, std::string_view host_header,
                       const std::vector<std::string>& allowed) {
  if (origin.empty()) return true;
  const auto is_same = [&](std::string_view scheme) {
    return origin.starts_with(scheme) && origin.substr(scheme.size()) == host_header;
  };
  if (is_own_host(host_header) && (is_same("http://") || is_same("https://"))) return true;
  return std::find(allowed.begin(), allowed.end(), origin) != allowed.end();
}

}  // namespace adit
