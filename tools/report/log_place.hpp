// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace adit {

/// Puts the logs of a mission into `unfinished` as run.lcmlog, unless the first is run.lcmlog in
/// `folder` already, where a mission has all of its logs: one by a hard link, or a copy where there
/// cannot be one; several one after the other, their events numbered anew. Throws
/// std::runtime_error where it cannot be written.
void place_log(const std::vector<std::filesystem::path>& logs, const std::filesystem::path& folder,
               const std::filesystem::path& unfinished);

}  // namespace adit
