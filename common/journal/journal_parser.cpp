// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/journal/journal_parser.hpp"

#include <algorithm>

namespace adit {
namespace {

using Bytes = std::span<const std::uint8_t>;
using journal_format::kHeadBytes;
using journal_format::kMagic;

/// Whether as much of the magic is there as there are bytes.
bool begins_as_a_record(Bytes bytes) {
  const std::size_t length = std::min(bytes.size(), kMagic.size());
  return std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length),
                    kMagic.begin());
}

/// Whether these are the bytes of one record up to where it ends too early.
bool is_torn(Bytes bytes) {
  if (bytes.size() < kHeadBytes) return begins_as_a_record(bytes);
  return journal_format::size(bytes).value_or(0) > bytes.size();
}

}  // namespace

std::optional<JournalRecord> JournalParser::next() {
  if (position_ == bytes_.size()) return std::nullopt;
  const std::size_t start = find_record(position_);
  if (start == bytes_.size()) {
    pass_over_the_tail();
    return std::nullopt;
  }
  if (start > position_) {
    ++health_.corrupt_stretches;
    health_.corrupt_bytes += start - position_;
  }
  ++health_.records;
  const Bytes rest = bytes_.subspan(start);
  position_ = start + journal_format::size(rest).value_or(0);
  return journal_format::read(rest);
}

/// Where the first record begins that is whole and sound; the end where there is none.
std::size_t JournalParser::find_record(std::size_t from) const {
  auto at = bytes_.begin() + static_cast<std::ptrdiff_t>(from);
  while (true) {
    at = std::search(at, bytes_.end(), kMagic.begin(), kMagic.end());
    const auto start = static_cast<std::size_t>(at - bytes_.begin());
    if (at == bytes_.end() || journal_format::read(bytes_.subspan(start))) return start;
    ++at;
  }
}

void JournalParser::pass_over_the_tail() {
  const Bytes tail = bytes_.subspan(position_);
  position_ = bytes_.size();
  if (is_torn(tail)) {
    health_.torn_bytes = tail.size();
  } else {
    ++health_.corrupt_stretches;
    health_.corrupt_bytes += tail.size();
  }
}

bool may_be_journal(std::span<const std::uint8_t> bytes) {
  return begins_as_a_record(bytes) ||
         std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}

}  // namespace adit
