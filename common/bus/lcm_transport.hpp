// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace adit {

/// What LCM's sockets ask the kernel to hold for them: a few messages of 1 MB.
constexpr std::int64_t kReceiveBufferBytes = 4 << 20;

/// The URL with what is not said filled in: an empty one as LCM does it, from LCM_DEFAULT_URL or
/// with its default, and for multicast the size of the receive buffer. Without that size LCM takes
/// net.core.rmem_default, however large net.core.rmem_max may be.
std::string complete_lcm_url(std::string url);

/// One line: why there is no LCM on the URL (empty: the default) and what to do about it.
std::string lcm_failure_reason(const std::string& url);

/// One line with a remedy where the kernel would lose large messages: its receive buffers are
/// small. Nothing where it would not, or where the URL is not multicast.
std::optional<std::string> receive_buffer_advice(const std::string& url);

/// Whether a table as in /proc/net/route leads multicast (224.0.0.0/4) anywhere.
bool has_multicast_route(std::string_view proc_net_route);

}  // namespace adit
