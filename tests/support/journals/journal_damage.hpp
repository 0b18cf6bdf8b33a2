// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>

namespace adit::test {

/// Damage of one record of a journal, as a disk or a person may do it.
struct JournalDamage {
  enum class Action { kFlip, kZero, kDuplicate, kSwap, kTruncate };
  enum class Field { kHeader, kLength, kChecksum, kPayload };
  enum class Position { kBegin, kMiddle, kEnd };
  enum class Files {
    kFirst,
    kCopy,
    kBoth,  ///< the same damage in both copies
  };
  static constexpr std::array<std::string_view, 5> kActions = {"flip", "zero", "duplicate", "swap",
                                                               "truncate"};
  static constexpr std::array<std::string_view, 4> kFields = {"header", "length", "checksum",
                                                              "payload"};
  static constexpr std::array<std::string_view, 3> kPositions = {"begin", "middle", "end"};

  Action action = Action::kFlip;
  Field field = Field::kPayload;
  Position position = Position::kMiddle;
  Files files = Files::kFirst;

  /// Whether the file ends between two records, as it did at an earlier time.
  [[nodiscard]] bool ends_at_record() const {
    return action == Action::kTruncate && field == Field::kHeader;
  }
};

/// Each damage as likely as every other one; every sixth hits both copies.
JournalDamage random_damage(std::mt19937& random);

std::string text_of(const JournalDamage& damage);

/// Damages the journal. False if it has no record.
bool apply(const JournalDamage& damage, const std::filesystem::path& journal, std::mt19937& random);

}  // namespace adit::test
