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

/// Something that takes bytes from outside.
struct Target {
  std::string name;
  std::vector<Bytes> samples;  ///< good inputs, to be damaged

  /// Takes any bytes; must not throw. Returns why it refused them, or nothing.
  std::function<std::string_view(std::span<const std::uint8_t>)> process;
};

/// Each group has a file of its own; a new one is added to `all_targets` in targets.cpp.
std::vector<Target> message_targets();
Target log_target();
Target carmen_target();
Target journal_target();
Target octree_target();
Target process_list_target();
std::vector<Target> world_targets();
std::vector<Target> cloud_targets();

std::vector<Target> all_targets();

}  // namespace adit::fuzz
