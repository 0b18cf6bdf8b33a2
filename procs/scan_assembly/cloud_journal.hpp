// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "common/journal/journal.hpp"
#include "common/types/cloud.hpp"

namespace adit {

/// The newest 3D scans, for those who missed one: who keeps them may just have been started again,
/// and a message may have been lost. Some MB.
class CloudBuffer {
 public:
  static constexpr std::size_t kMax = 8;
  /// One that was sent so shortly ago may be on its way, or may just be handled.
  static constexpr std::int64_t kResendDelayUs = 3'000'000;

  /// In order of time; `utime` is the bus time at which it was sent.
  void add(const Cloud& cloud, std::int64_t utime);

  /// The newest that was sent long enough ago by `utime` and that the other asks for; nullptr where
  /// there is none.
  [[nodiscard]] const Cloud* find_missing(const CloudRequest& request, std::int64_t utime) const;

 private:
  struct Sent {
    std::int64_t utime = 0;
    Cloud cloud;
  };

  std::deque<Sent> sent_;
};

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
  void store(const Cloud& cloud);

  /// Somebody has those of these times (Cloud::utime). Forgets all once nobody lacks one.
  void acknowledge(std::span<const std::int64_t> received_utime);

 private:
  std::vector<Cloud> restored_;
  Journal journal_;
  std::size_t clouds_ = 0;                          ///< that are in it
  std::vector<std::int64_t> unacknowledged_utime_;  ///< of those that nobody has
};

}  // namespace adit
