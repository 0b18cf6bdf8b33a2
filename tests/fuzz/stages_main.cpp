// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// fuzz_stages --cases N --seed S: sends mutated messages of every type to all stages of a mission
// in this process, amid its own messages. An exception past a node or in a handler, a crash, a
// message that takes too long, a command beyond the limits of the vehicle, or a stage that does not
// resume its output fails the run. The cases of a mission depend on those before them; the printed
// command repeats a mission from its beginning.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sim/live/world_choice.hpp"
#include "tests/fuzz/fuzzed_mission.hpp"
#include "tests/fuzz/watchdog.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit::fuzz {
namespace {

constexpr std::int64_t kCasesPerMission = 20'480;  // a multiple of a burst
constexpr int kLimitSeconds =
    60;  // of a message, with sanitizers: a search for a path takes longest
constexpr std::int64_t kCasesPerCheck = 10'240;

struct Options {
  std::int64_t cases = 100'000;
  std::int64_t from = 0;
  std::uint64_t seed = 1;
};

using Counts = std::map<std::string, ChannelCounts, std::less<>>;

struct Outcome {
  Counts counts;
  std::int64_t failures = 0;
  std::int64_t missions = 0;
};

/// `from`: first case of the mission.
void report(std::int64_t from, const std::string& failure, Outcome& outcome) {
  std::fprintf(stderr, "FAILED: --from %lld: %s\n", static_cast<long long>(from), failure.c_str());
  ++outcome.failures;
}

void add(const Counts& counts, Counts& sum) {
  for (const auto& [channel, added] : counts) {
    ChannelCounts& total = sum[channel];
    total.sent += added.sent;
    total.subscriptions = added.subscriptions;
    total.rejected += added.rejected;
    total.max_ms = std::max(total.max_ms, added.max_ms);
  }
}

/// One mission, until `cases` or its end. Returns the number of cases.
std::int64_t run_mission(const Site& site, std::int64_t first, std::int64_t cases,
                         const Options& options, Outcome& outcome) {
  const test::ScratchFolder folder;
  std::int64_t done = 0;
  FuzzedMission mission(site, folder.path(),
                        options.seed * 0x100000001B3U + static_cast<std::uint64_t>(first),
                        [&] { watch(first + done); });
  std::int64_t checked = 0;
  while (done < cases && !mission.is_over()) {
    done += mission.step();
    if (done < checked + kCasesPerCheck) continue;
    checked = done;
    if (mission.is_over()) break;
    for (const std::string& wrong : mission.recover()) {
      if (!mission.is_over()) report(first, wrong, outcome);
    }
  }
  add(mission.counts(), outcome.counts);
  for (const std::string& failure : mission.failures()) report(first, failure, outcome);
  ++outcome.missions;
  return done;
}

void print(const Outcome& outcome) {
  std::printf("%-20s %9s %13s %9s %9s\n", "channel", "sent", "subscriptions", "rejected",
              "max [ms]");
  for (const auto& [channel, counts] : outcome.counts) {
    std::printf("%-20s %9lld %13lld %9lld %9.1f\n", channel.c_str(),
                static_cast<long long>(counts.sent), static_cast<long long>(counts.subscriptions),
                static_cast<long long>(counts.rejected), counts.max_ms);
  }
}

int run(const Options& options) {
  WorldChoice choice;
  choice.name = "straight";
  const Site site(build_world(describe(choice)));
  Outcome outcome;
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t end = options.from + options.cases;
  // A mission ends at the next multiple, or before; what it is sent depends on its first case only.
  std::int64_t number = options.from;
  while (number < end) {
    const std::int64_t mission_end =
        std::min(end, number - number % kCasesPerMission + kCasesPerMission);
    number += run_mission(site, number, mission_end - number, options, outcome);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  print(outcome);
  std::printf("%lld messages in %lld missions, %.1f s\n", static_cast<long long>(options.cases),
              static_cast<long long>(outcome.missions), taken.count());
  return outcome.failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit::fuzz

int main(int argc, char** argv) {
  adit::fuzz::Options options;
  CLI::App app("Sends mutated messages to all stages of a mission.");
  app.add_option("--cases", options.cases, "Number of messages")->capture_default_str();
  app.add_option("--from", options.from, "Number of the first message")->capture_default_str();
  app.add_option("--seed", options.seed, "Random seed")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::string command = std::string(argv[0]) + " --seed " + std::to_string(options.seed);
  adit::fuzz::start_watchdog(command, adit::fuzz::kLimitSeconds);
  return adit::fuzz::run(options);
}
