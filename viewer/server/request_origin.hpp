// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// Whether the name of the Host header leads to this computer without a name server: localhost, an
/// IP address, or the name of this computer. A page of another site that has its name point here
/// (DNS rebinding) is told by it.
bool is_own_host(std::string_view host_header);

/// Whether a page from `origin` (the Origin header; empty: not a browser) may open a WebSocket on
/// the host that it names in the Host header: the page of this server itself, or one of
/// `allowed`, e.g. https://app.foxglove.dev.
bool is_allowed_origin(std::string_view origin, std::string_view host_header,
                       const std::vector<std::string>& allowed);

}  // namespace adit
