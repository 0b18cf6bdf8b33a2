// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/journals/journal_damage.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "common/journal/journal.hpp"

namespace adit::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Action = JournalDamage::Action;
using Field = JournalDamage::Field;

constexpr std::size_t kZeroedMax = 5000;
constexpr unsigned kBothEvery = 6;

template <class Enum>
std::size_t index_of(Enum value) {
  return static_cast<std::size_t>(value);
}

/// 0 to `count` − 1.
std::size_t below(std::size_t count, std::mt19937& random) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

Bytes read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_bytes(const Bytes& bytes, const std::filesystem::path& path) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

struct Range {
  std::size_t offset = 0;
  std::size_t size = 0;
};

/// Of the fields of a record, see common/journal/README.md.
Range range_of(Field field, const JournalScan::Found& record) {
  switch (field) {
    case Field::kHeader:
      return {record.offset, journal_format::kHeaderBytes};
    case Field::kLength:
      return {record.offset + 4, 8};
    case Field::kChecksum:
      return {record.offset + 12, 4};
    case Field::kPayload:
      break;
  }
  return {record.offset + journal_format::kHeaderBytes, record.size - journal_format::kHeaderBytes};
}

std::size_t record_at(JournalDamage::Position position, std::size_t records, std::mt19937& random) {
  const std::size_t few = std::max<std::size_t>(1, records / 20);
  if (position == JournalDamage::Position::kBegin) return below(few, random);
  if (position == JournalDamage::Position::kEnd) return records - 1 - below(few, random);
  return below(records, random);
}

Bytes bytes_of(const JournalScan::Found& record, const Bytes& bytes) {
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(record.offset);
  return {begin, begin + static_cast<std::ptrdiff_t>(record.size)};
}

Bytes swapped(const JournalScan& scan, std::size_t a, std::size_t b, const Bytes& bytes) {
  Bytes result;
  for (std::size_t i = 0; i < scan.records.size(); ++i) {
    const std::size_t taken = i == a ? b : i == b ? a : i;
    const Bytes record = bytes_of(scan.records[taken], bytes);
    result.insert(result.end(), record.begin(), record.end());
  }
  return result;
}

Bytes damaged(const JournalDamage& damage, const Bytes& bytes, std::mt19937& random) {
  const JournalScan scan = scan_journal(bytes);
  if (scan.records.empty()) return bytes;
  const std::size_t hit = record_at(damage.position, scan.records.size(), random);
  const std::size_t other = below(scan.records.size(), random);
  const Range range = range_of(damage.field, scan.records[hit]);
  const std::size_t at = range.offset + below(range.size, random);
  Bytes result = bytes;
  switch (damage.action) {
    case Action::kFlip:
      result[at] ^= static_cast<std::uint8_t>(1U << below(8, random));
      break;
    case Action::kZero: {
      const std::size_t end = std::min(bytes.size(), at + 1 + below(kZeroedMax, random));
      std::fill(result.begin() + static_cast<std::ptrdiff_t>(at),
                result.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{0});
      break;
    }
    case Action::kDuplicate: {
      const Bytes record = bytes_of(scan.records[hit], bytes);
      result.insert(result.begin() + static_cast<std::ptrdiff_t>(scan.records[other].offset),
                    record.begin(), record.end());
      break;
    }
    case Action::kSwap:
      return swapped(scan, hit, other, bytes);
    case Action::kTruncate:
      result.resize(damage.ends_at_record() ? scan.records[hit].offset : at);
      break;
  }
  return result;
}

}  // namespace

JournalDamage random_damage(std::mt19937& random) {
  JournalDamage damage;
  damage.action = Action(below(JournalDamage::kActions.size(), random));
  damage.field = Field(below(JournalDamage::kFields.size(), random));
  damage.position = JournalDamage::Position(below(JournalDamage::kPositions.size(), random));
  damage.files = JournalDamage::Files(below(2, random));
  if (below(kBothEvery, random) == 0) damage.files = JournalDamage::Files::kBoth;
  return damage;
}

std::string text_of(const JournalDamage& damage) {
  constexpr std::array<std::string_view, 3> kFiles = {"the file", "its copy", "both copies"};
  return fmt::format("{} {} at {} of {}", JournalDamage::kActions[index_of(damage.action)],
                     JournalDamage::kFields[index_of(damage.field)],
                     JournalDamage::kPositions[index_of(damage.position)],
                     kFiles[index_of(damage.files)]);
}

bool apply(const JournalDamage& damage, const std::filesystem::path& journal,
           std::mt19937& random) {
  const Bytes bytes = read_bytes(journal);
  const Bytes result = damaged(damage, bytes, random);
  const std::filesystem::path copy = journal_copy(journal);
  if (damage.files != JournalDamage::Files::kCopy) write_bytes(result, journal);
  if (damage.files != JournalDamage::Files::kFirst) write_bytes(result, copy);
  return !bytes.empty();
}

}  // namespace adit::test
