// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// Sends a request to the supervisor of this computer and passes its response to `take` as it
/// arrives, until the connection closes. Throws std::runtime_error if no supervisor listens, or
/// with the error of the response.
void request_from_supervisor(const std::filesystem::path& socket,
                             const std::vector<std::string>& request,
                             const std::function<void(std::string_view)>& take);

/// Returns the complete response; for requests other than "follow".
std::string request_from_supervisor(const std::filesystem::path& socket,
                                    const std::vector<std::string>& request);

}  // namespace adit
