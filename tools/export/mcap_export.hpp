// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viewer/scene/scene_parameters.hpp"

namespace adit {

struct McapExport {
  std::uint64_t messages = 0;
  std::size_t topics = 0;
  std::vector<std::string> warnings;  ///< skipped parts of the logs, one sentence each
};

/// Writes the topics of the viewer (viewer/README.md), as they are when the logs of one mission are
/// played, to an MCAP file for Foxglove, Lichtblick and the command mcap. Of a topic of large
/// messages (map, volume) those of which 100 kB per second remain, and the last one. The logs may
/// be in any order. The same logs give the same bytes. Throws std::runtime_error if a log cannot be
/// read or has no message for the viewer, or if the file cannot be written; then there is no file.
McapExport export_mcap(const std::vector<std::filesystem::path>& logs,
                       const std::filesystem::path& file, const SceneParameters& parameters,
                       const std::function<void(double)>& progress);

}  // namespace adit
