// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/skeleton.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace adit {
namespace {

/// Which of the eight neighbours are there, a bit each, counter-clockwise from x.
unsigned neighbours(const CellField<std::uint8_t>& mask, std::size_t at,
                    const std::array<std::ptrdiff_t, 8>& around) {
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) {
    bits |= static_cast<unsigned>(mask[at + static_cast<std::size_t>(around[i])]) << i;
  }
  return bits;
}

/// Guo and Hall's conditions, the neighbours in order of rotation; the second half of an iteration
/// is the first turned by half a turn.
bool may_go(unsigned bits, bool second_half) {
  const auto p = [&](unsigned i) {
    return (bits >> ((i + (second_half ? 4U : 0U)) % 8U) & 1U) != 0;
  };
  int crossings = 0;
  int pairs_1 = 0;
  int pairs_2 = 0;
  for (unsigned i = 0; i < 8; i += 2) {
    crossings += static_cast<int>(!p(i) && (p(i + 1) || p(i + 2)));
    pairs_1 += static_cast<int>(p(i + 7) || p(i));
    pairs_2 += static_cast<int>(p(i) || p(i + 1));
  }
  const int pairs = std::min(pairs_1, pairs_2);
  if (crossings != 1 || pairs < 2 || pairs > 3) return false;
  return !((p(4) || p(5) || !p(7)) && p(6));
}

using Table = std::array<std::array<bool, 256>, 2>;

Table make_table() {
  Table table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    table[0][bits] = may_go(bits, false);
    table[1][bits] = may_go(bits, true);
  }
  return table;
}

}  // namespace

CellField<std::uint8_t> skeleton(const DrivableSpace& space) {
  static const Table kTable = make_table();
  CellField<std::uint8_t> mask(space.known.box());
  const auto around = mask.around();
  for (std::size_t i = 0; i < mask.size(); ++i) {
    mask[i] = static_cast<std::uint8_t>(space.access[i] == Access::kReachable);
  }
  std::vector<std::size_t> rim;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] != 0 && neighbours(mask, i, around) != 255U) rim.push_back(i);
  }
  std::vector<std::size_t> gone;
  CellField<std::uint32_t> queued(space.known.box());
  for (std::uint32_t round = 1; !rim.empty(); ++round) {
    std::vector<std::size_t> next;
    const auto queue = [&](std::size_t cell) {
      if (mask[cell] == 0 || queued[cell] == round) return;
      queued[cell] = round;
      next.push_back(cell);
    };
    for (const auto& may_go_now : kTable) {
      gone.clear();
      for (const std::size_t cell : rim) {
        if (mask[cell] != 0 && may_go_now[neighbours(mask, cell, around)]) gone.push_back(cell);
      }
      for (const std::size_t cell : gone) mask[cell] = 0;
      for (const std::size_t cell : gone) {
        for (const std::ptrdiff_t step : around) queue(cell + static_cast<std::size_t>(step));
      }
    }
    rim = std::move(next);
  }
  return mask;
}

}  // namespace adit
