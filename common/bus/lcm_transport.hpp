// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace adit {

/// Receive buffer requested for LCM's sockets: a few messages of 1 MB.
constexpr std::int64_t kReceiveBufferBytes = 4 << 20;

/// The URL with defaults filled in: an empty URL becomes LCM_DEFAULT_URL or LCM's default, as in
/// LCM; a multicast URL gets the size of the receive buffer. Without the size LCM uses
/// net.core.rmem_default, even if net.core.rmem_max is larger.
std::string complete_lcm_url(std::string url);

/// One line: why LCM cannot be opened on the URL (empty: the default), and the remedy.
std::string lcm_failure_reason(const std::string& url);

/// One line with a remedy if the kernel's receive buffers are too small for large messages. Nothing
/// if they are large enough, or if the URL is not multicast.
std::optional<std::string> receive_buffer_advice(const std::string& url);

/// True if a routing table in the format of /proc/net/route has a route for multicast
/// (224.0.0.0/4).
bool has_multicast_route(std::string_view proc_net_route);

}  // namespace adit
