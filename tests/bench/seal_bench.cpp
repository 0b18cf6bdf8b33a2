// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Time to seal and to check one message of so many bytes: DRIVE_COMMAND has 40, PATH some thousand,
// the largest datagram 60 kB.
#include <vector>

#include <benchmark/benchmark.h>

#include "common/seal/seal_receiver.hpp"
#include "common/seal/seal_sender.hpp"

namespace adit {
namespace {

std::vector<std::uint8_t> message_of(const benchmark::State& state) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(state.range(0)), 0x5A);
}

void seal_message(benchmark::State& state) {
  SealSender sender(SealKey::random());
  const auto message = message_of(state);
  std::int64_t us = 1;
  for (auto _ : state) benchmark::DoNotOptimize(sender.seal("DRIVE_COMMAND", message, ++us));
}

/// Sealing included, as each message is accepted only once.
void seal_and_check_message(benchmark::State& state) {
  const SealKey key = SealKey::random();
  SealSender sender(key);
  SealReceiver receiver(key);
  std::int64_t us = 1;
  const SealNonce nonce = *receiver.take_challenge(us);
  const std::vector<std::uint8_t> content(nonce.begin(), nonce.end());
  receiver.add_answer("SEAL_ANSWER", sender.seal("SEAL_ANSWER", content, us), nonce, us);
  const auto message = message_of(state);
  for (auto _ : state) {
    ++us;
    const auto sealed = sender.seal("DRIVE_COMMAND", message, us);
    if (!receiver.check("DRIVE_COMMAND", sealed, us).empty()) state.SkipWithError("rejected");
    if (us % 1'000'000 != 0) continue;
    const SealNonce next = receiver.take_challenge(us).value_or(nonce);
    receiver.add_answer("SEAL_ANSWER", sender.seal("SEAL_ANSWER", content, us), next, us);
  }
}

void reject_message(benchmark::State& state) {
  SealSender stranger(SealKey::random());
  SealReceiver receiver(SealKey::random());
  const auto sealed = stranger.seal("DRIVE_COMMAND", message_of(state), 1);
  for (auto _ : state) benchmark::DoNotOptimize(receiver.check("DRIVE_COMMAND", sealed, 1));
}

BENCHMARK(seal_message)->Arg(40)->Arg(4000)->Arg(60'000);
BENCHMARK(seal_and_check_message)->Arg(40)->Arg(4000)->Arg(60'000);
BENCHMARK(reject_message)->Arg(40)->Arg(4000)->Arg(60'000);

}  // namespace
}  // namespace adit
