// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/journal/journal.hpp"
#include "common/types/cloud.hpp"

namespace adit {

/// The newest 3D scans, in memory, for resends: a receiver may have been restarted, and messages
/// may be lost. A few MB.
class CloudBuffer {
 public:
  static constexpr std::size_t kMax = 8;
  /// A cloud is not resent within this time: it may be in transit or being processed.
  static constexpr std::int64_t kResendDelayUs = 3'000'000;

  /// In order of time; `utime` is the bus time of the transmission.
  void add(const Cloud& cloud, std::int64_t utime);

  /// The newest cloud that the requester is missing and whose resend delay has passed at `utime`;
  /// nullptr if there is none.
  [[nodiscard]] const Cloud* find_missing(const CloudRequest& request, std::int64_t utime) const;

 private:
  struct Sent {
    std::int64_t utime = 0;
    Cloud cloud;
  };

  std::deque<Sent> sent_;
};

/// Stores 3D scans on disk until a receiver acknowledges them: power may be lost after a scan is
/// published and before the volume map has stored it. About 0.5 MB for each scan.
class CloudJournal {
 public:
  /// Maximum number of scans; without acknowledgements the journal is cleared then.
  static constexpr std::size_t kMax = 64;

  /// Opens or creates the file. Throws std::runtime_error if it is no journal or cannot be used.
  explicit CloudJournal(const std::filesystem::path& path);

  /// The scans of the file at its opening, in the order of storage, without incomplete ones. Can be
  /// called once.
  std::vector<Cloud> take_restored() { return std::exchange(restored_, {}); }

  /// What to tell a person if the file was damaged when it was opened, in one line; empty if not.
  [[nodiscard]] const std::string& damage() const { return journal_.damage(); }
  /// That of Journal.
  [[nodiscard]] const std::string& failure() const { return journal_.failure(); }

  /// Returns when the scan is on disk. Throws std::runtime_error if that fails.
  void store(const Cloud& cloud);

  /// A receiver has stored the scans of these times (Cloud::utime). The journal is cleared when all
  /// scans are acknowledged.
  void acknowledge(std::span<const std::int64_t> received_utime);

 private:
  std::vector<Cloud> restored_;
  Journal journal_;
  std::size_t clouds_ = 0;                          ///< number of clouds in the file
  std::vector<std::int64_t> unacknowledged_utime_;  ///< Cloud::utime
};

}  // namespace adit
