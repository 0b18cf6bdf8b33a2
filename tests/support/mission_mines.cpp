// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/mission_mines.hpp"

#include <array>
#include <cstddef>

namespace adit::test {

WorldChoice mission_mine(int number) {
  constexpr std::array kTopologies{"parallel_entries", "room_and_pillar", "branching", "ring"};
  constexpr std::array kDamages{0.0, 0.25, 0.5, 0.75, 1.0};
  constexpr std::array kLengthsM{40.0, 60.0, 80.0, 100.0, 50.0, 70.0, 90.0};
  const auto n = static_cast<std::size_t>(number);
  WorldChoice choice;
  choice.name = "random";
  choice.seed = number;
  choice.topology = kTopologies[n % kTopologies.size()];
  choice.damage = kDamages[n % kDamages.size()];
  choice.length_m = kLengthsM[n % kLengthsM.size()];
  return choice;
}

}  // namespace adit::test
