// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace adit {

/// One line: why there is no LCM on the URL (empty: the default) and what to do about it.
std::string why_no_lcm(const std::string& url);

/// One line with a remedy where the kernel would lose large messages: its receive buffers are
/// small. Nothing where it would not, or where the URL is not multicast.
std::optional<std::string> buffer_advice(const std::string& url);

/// Whether a table as in /proc/net/route leads multicast (224.0.0.0/4) anywhere.
bool routes_multicast(std::string_view proc_net_route);

}  // namespace adit
