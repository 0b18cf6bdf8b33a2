// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/journal/journal.hpp"

namespace adit {

/// 3D scans on the disk until somebody has them: all may be cut off between the moment at which one
/// is announced and that at which it is kept by who makes a map of it. Some 0.5 MB each.
class CloudJournal {
 public:
  /// Where nobody says that he has any, this many are kept at most; then it begins anew.
  static constexpr std::size_t kMax = 64;

  /// Opens or creates it. Throws std::runtime_error where the file is no journal or cannot be used.
  explicit CloudJournal(const std::filesystem::path& path);

  /// What was there when it was opened, in the order in which it came; one that is not whole is
  /// left out. Once.
  std::vector<Cloud> take_restored() { return std::exchange(restored_, {}); }

  /// Returns when the disk has it. Throws std::runtime_error where it cannot.
  void keep(const Cloud& cloud);

  /// Somebody has those of these times (Cloud::utime). Forgets all once nobody lacks one.
  void let_go(std::span<const std::int64_t> have_utime);

 private:
  std::vector<Cloud> restored_;
  Journal journal_;
  std::size_t clouds_ = 0;                  ///< that are in it
  std::vector<std::int64_t> lacked_utime_;  ///< of those that nobody has
};

}  // namespace adit
