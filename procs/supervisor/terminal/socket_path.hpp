// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// Where a supervisor of this user listens to `adit ps` and the like: in XDG_RUNTIME_DIR, else in
/// /run/adit for root, else in a folder of the user's own below /tmp.
std::filesystem::path default_socket_path();

}  // namespace adit
