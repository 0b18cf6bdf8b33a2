// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// Sends a request to the supervisor of this computer and hands on its answer as it comes, until
/// its end. Throws std::runtime_error where no supervisor listens, or with what it says against it.
void request_from_supervisor(const std::filesystem::path& socket,
                             const std::vector<std::string>& words,
                             const std::function<void(std::string_view)>& take);

/// The same for an answer that has an end.
std::string request_from_supervisor(const std::filesystem::path& socket,
                                    const std::vector<std::string>& words);

}  // namespace adit
