// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// Where a supervisor of this user listens to `adit ps` and the like: in XDG_RUNTIME_DIR, else in
/// /run/adit for root, else in a folder of the user's own below /tmp.
std::filesystem::path default_socket_path();

/// Where a terminal of this user finds a supervisor: there, or else, where it may look into it, in
/// /run/adit, which has the one that the system starts.
std::filesystem::path socket_path_to_ask();

}  // namespace adit
