// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace adit::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// A parser of external bytes, with valid inputs to mutate.
struct Target {
  std::string name;
  std::vector<Bytes> samples;  ///< valid inputs

  /// Parses any bytes. Must not throw. Returns the reason for rejection, or an empty text.
  std::function<std::string_view(std::span<const std::uint8_t>)> process;
};

// Groups of targets. Add new groups to `all_targets` in targets.cpp.

std::vector<Target> message_targets();
Target compressed_log_target();
Target log_target();
Target carmen_target();
Target journal_target();
Target octree_target();
Target process_list_target();
std::vector<Target> world_targets();
std::vector<Target> cloud_targets();
std::vector<Target> viewer_targets();
std::vector<Target> driver_targets();
std::vector<Target> bag_targets();

/// All targets of all groups.
std::vector<Target> all_targets();

}  // namespace adit::fuzz
