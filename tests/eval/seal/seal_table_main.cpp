// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// seal_table [ATTACKS [SEED]]: attacks on sealed orders; prints how many of each kind were accepted
// as a table in Markdown. Exit code 1 if one was, or a genuine order was rejected.
#include <cstdio>
#include <cstdlib>

#include "tests/support/seals/seal_attacks.hpp"

int main(int argc, char** argv) {
  const std::int64_t attacks = argc > 1 ? std::atoll(argv[1]) : 1'000'000;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const adit::SealAttackCounts counts = adit::attack_seals(attacks, seed);
  std::int64_t accepted = 0;
  std::puts("| order | sent | accepted |\n|---|---|---|");
  for (std::size_t i = 0; i < adit::kSealAttackNames.size(); ++i) {
    std::printf("| %s | %lld | %lld |\n", adit::kSealAttackNames.at(i),
                static_cast<long long>(counts.attempts.at(i)),
                static_cast<long long>(counts.accepted.at(i)));
    accepted += counts.accepted.at(i);
  }
  std::printf("| genuine | %lld | %lld |\n", static_cast<long long>(counts.genuine),
              static_cast<long long>(counts.genuine_accepted));
  std::printf("\nStarts of a sender: %lld, of the receiver: %lld\n",
              static_cast<long long>(counts.sender_starts),
              static_cast<long long>(counts.receiver_starts));
  return accepted == 0 && counts.genuine == counts.genuine_accepted ? EXIT_SUCCESS : EXIT_FAILURE;
}
