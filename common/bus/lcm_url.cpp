// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/lcm_url.hpp"

#include <cstdlib>

namespace adit {

std::string complete_lcm_url(std::string url) {
  const char* const preset = std::getenv("LCM_DEFAULT_URL");
  if (url.empty() && preset != nullptr) url = preset;
  if (url.empty()) url = "udpm://239.255.76.67:7667?ttl=0";
  if (!url.starts_with("udpm:") || url.find("recv_buf_size=") != std::string::npos) return url;
  url += url.find('?') == std::string::npos ? '?' : '&';
  return url + "recv_buf_size=" + std::to_string(kReceiveBufferBytes);
}

}  // namespace adit
