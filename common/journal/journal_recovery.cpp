// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/journal/journal_recovery.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace adit {
namespace {

using Found = JournalScan::Found;

auto identity_of(const Found& record) { return std::tuple(record.sequence(), record.checksum); }

bool is_next(const Found& before, const Found& record) {
  return before.sequence() + 1 == record.sequence() && before.checksum == record.place->previous;
}

/// The different records of all copies, by sequence.
std::vector<Found> distinct_records(std::span<const JournalScan> copies) {
  std::vector<Found> all;
  for (const JournalScan& copy : copies)
    all.insert(all.end(), copy.records.begin(), copy.records.end());
  const auto is_less = [](const Found& a, const Found& b) {
    return identity_of(a) < identity_of(b);
  };
  const auto is_same = [](const Found& a, const Found& b) {
    return identity_of(a) == identity_of(b);
  };
  std::stable_sort(all.begin(), all.end(), is_less);
  all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  return all;
}

/// For each record, in order of sequence, the number of records in its chain of checksums.
std::vector<std::size_t> chain_lengths(const std::vector<Found>& records) {
  std::vector<std::size_t> chain_of;  // by record
  std::vector<std::size_t> lengths;   // by chain
  std::size_t same = 0;               // the first record with the sequence of the present one
  std::size_t before = 0;             // and with the sequence before
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i > 0 && records[i].sequence() != records[i - 1].sequence()) {
      before = same;
      same = i;
    }
    std::size_t chain = lengths.size();
    for (std::size_t k = before; k < same; ++k) {
      if (is_next(records[k], records[i])) chain = chain_of[k];
    }
    if (chain == lengths.size()) lengths.push_back(0);
    ++lengths[chain];
    chain_of.push_back(chain);
  }
  std::vector<std::size_t> result;
  result.reserve(records.size());
  for (const std::size_t chain : chain_of) result.push_back(lengths[chain]);
  return result;
}

/// One record for each sequence: that in the longest chain.
std::vector<Found> chosen_records(const std::vector<Found>& records) {
  const std::vector<std::size_t> lengths = chain_lengths(records);
  std::vector<Found> chosen;
  std::size_t chosen_length = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const bool is_rival = !chosen.empty() && chosen.back().sequence() == records[i].sequence();
    if (is_rival && lengths[i] <= chosen_length) continue;
    if (is_rival) chosen.pop_back();
    chosen.push_back(records[i]);
    chosen_length = lengths[i];
  }
  return chosen;
}

std::size_t count_missing(const std::vector<Found>& records) {
  std::size_t missing = 0;
  std::size_t expected = 0;
  for (const Found& record : records) {
    missing += record.sequence() - expected;
    expected = std::size_t{record.sequence()} + 1;
  }
  return missing;
}

bool ends_with(const JournalScan& copy, const Found& last) {
  return !copy.end_is_corrupt() && !copy.records.empty() &&
         copy.records.back().sequence() == last.sequence();
}

/// Compares one copy with the joined records and counts its damage.
class CopyDamage {
 public:
  CopyDamage(const std::vector<Found>& joined, JournalHealth& health)
      : joined_(joined), health_(health) {}

  void count(const JournalScan& copy) {
    health_.corrupt_regions += copy.corrupt.size();
    health_.truncated_bytes += copy.truncated_bytes;
    for (const JournalRegion& region : copy.corrupt) {
      health_.corrupt_bytes += region.bytes;
      first_ = std::min(first_, region.offset);
    }
    count_records(copy);
  }

  [[nodiscard]] std::size_t first() const {
    return first_ == std::numeric_limits<std::size_t>::max() ? 0 : first_;
  }

 private:
  void count_records(const JournalScan& copy) {
    std::vector<Found> sorted = copy.records;
    const auto is_less = [](const Found& a, const Found& b) {
      return identity_of(a) < identity_of(b);
    };
    std::stable_sort(sorted.begin(), sorted.end(), is_less);
    std::size_t lacking = 0;  // in a row, at the end of the joined records so far
    for (const Found& record : joined_) {
      const bool has = std::binary_search(sorted.begin(), sorted.end(), record, is_less);
      if (has) health_.recovered += lacking;
      lacking = has ? 0 : lacking + 1;
    }
    (copy.end_is_corrupt() ? health_.recovered : health_.behind) += lacking;
    std::size_t expected = 0;
    for (const Found& record : copy.records) {
      const bool in_order = record.sequence() >= expected &&
                            std::binary_search(joined_.begin(), joined_.end(), record, is_less);
      if (in_order) {
        expected = std::size_t{record.sequence()} + 1;
      } else {
        ++health_.misplaced;
        first_ = std::min(first_, record.offset);
      }
    }
  }

  const std::vector<Found>& joined_;
  JournalHealth& health_;
  std::size_t first_ = std::numeric_limits<std::size_t>::max();
};

std::string counted(std::size_t n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace

JournalContents join_copies(std::span<const JournalScan> copies) {
  JournalContents contents;
  contents.records = chosen_records(distinct_records(copies));
  JournalHealth& health = contents.health;
  health.records = contents.records.size();
  health.missing = count_missing(contents.records);
  CopyDamage damage(contents.records, health);
  for (const JournalScan& copy : copies) damage.count(copy);
  health.first_damage = damage.first();
  const bool end_is_certain = std::any_of(copies.begin(), copies.end(), [&](const auto& copy) {
    return !contents.records.empty() && ends_with(copy, contents.records.back());
  });
  health.end_missing = !end_is_certain && std::any_of(copies.begin(), copies.end(), [](auto& copy) {
    return copy.end_is_corrupt();
  });
  return contents;
}

std::string text_of(const JournalHealth& health) {
  std::vector<std::string> parts;
  if (health.corrupt_regions > 0) {
    parts.push_back(fmt::format("{} damaged ({}, the first at byte {})",
                                counted(health.corrupt_regions, "place"),
                                counted(health.corrupt_bytes, "byte"), health.first_damage));
  }
  if (health.misplaced > 0) {
    parts.push_back(counted(health.misplaced, "record") + " duplicated, out of order or foreign");
  }
  if (health.recovered > 0) {
    parts.push_back(counted(health.recovered, "record") + " taken from the other copy");
  }
  if (health.missing > 0) parts.push_back(counted(health.missing, "record") + " lost");
  if (health.end_missing) parts.emplace_back("an unknown number of records at the end lost");
  if (health.behind > 0) {
    parts.push_back("one copy ended " + counted(health.behind, "record") + " before the other");
  }
  if (health.truncated_bytes > 0) {
    parts.push_back(fmt::format("the last record was incomplete ({})",
                                counted(health.truncated_bytes, "byte")));
  }
  if (health.is_damaged() && !health.has_loss()) parts.emplace_back("nothing lost");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace adit
