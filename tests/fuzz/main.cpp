// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// fuzz_inputs --cases N --seed S: mutates valid messages, logs and lines of text and passes them to
// the parsers of external input. A crash, an exception, a hang or a sanitizer report fails the run,
// and the failing case is printed. Cases depend only on the seed and their number.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/fuzz/mutator.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/watchdog.hpp"

namespace adit::fuzz {
namespace {

struct Options {
  std::int64_t cases = 1'000'000;
  std::int64_t from = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> targets;  ///< names; empty: all
};

struct OutcomeCounts {
  std::int64_t accepted = 0;
  std::int64_t rejected = 0;
  std::map<std::string, std::int64_t, std::less<>> reasons;
};

/// Runs one case. Targets take turns; each case has its own seed.
void run_case(std::int64_t number, const Options& options, const std::vector<Target>& targets,
              std::vector<OutcomeCounts>& all_outcome_counts) {
  const std::size_t which = static_cast<std::size_t>(number) % targets.size();
  const Target& target = targets[which];
  const Target& other_sample = targets[static_cast<std::size_t>(number * 7 + 3) % targets.size()];
  Mutator mutator(options.seed * 0x100000001B3U + static_cast<std::uint64_t>(number));
  const std::string_view reason =
      target.process(mutator.mutate(target.samples, other_sample.samples[0]));
  OutcomeCounts& outcome_counts = all_outcome_counts[which];
  reason.empty() ? ++outcome_counts.accepted : ++outcome_counts.rejected;
  if (!reason.empty()) ++outcome_counts.reasons[std::string(reason)];
}

void print(const std::vector<Target>& targets,
           const std::vector<OutcomeCounts>& all_outcome_counts) {
  std::printf("%-18s %10s %10s\n", "target", "accepted", "rejected");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    std::printf("%-18s %10lld %10lld\n", targets[i].name.c_str(),
                static_cast<long long>(all_outcome_counts[i].accepted),
                static_cast<long long>(all_outcome_counts[i].rejected));
    for (const auto& [reason, count] : all_outcome_counts[i].reasons) {
      std::printf("    %10lld %s\n", static_cast<long long>(count), reason.c_str());
    }
  }
}

/// Checks that every target accepts its unmodified samples. Mutations of a rejected sample would
/// not get past the first check of the parser.
bool samples_are_valid(const std::vector<Target>& targets) {
  bool valid = true;
  for (const Target& target : targets) {
    for (const Bytes& sample : target.samples) {
      const std::string_view reason = target.process(sample);
      if (!reason.empty()) {
        std::fprintf(stderr, "a sample of %s is rejected: %s\n", target.name.c_str(),
                     reason.data());
      }
      valid = valid && reason.empty();
    }
  }
  return valid;
}

std::vector<Target> chosen_targets(const std::vector<std::string>& names) {
  std::vector<Target> targets = all_targets();
  std::erase_if(targets, [&names](const Target& target) {
    return !names.empty() && std::ranges::find(names, target.name) == names.end();
  });
  return targets;
}

int run(const Options& options) {
  const std::vector<Target> targets = chosen_targets(options.targets);
  if (targets.empty()) {
    std::fprintf(stderr, "there is no such target\n");
    return 1;
  }
  if (!samples_are_valid(targets)) return 1;
  std::vector<OutcomeCounts> all_outcome_counts(targets.size());
  const auto start = std::chrono::steady_clock::now();
  for (std::int64_t number = options.from; number < options.from + options.cases; ++number) {
    watch(number);
    run_case(number, options, targets, all_outcome_counts);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  print(targets, all_outcome_counts);
  std::printf("%lld cases in %.1f s, %.0f per second\n", static_cast<long long>(options.cases),
              taken.count(), static_cast<double>(options.cases) / taken.count());
  return 0;
}

}  // namespace
}  // namespace adit::fuzz

int main(int argc, char** argv) {
  adit::fuzz::Options options;
  CLI::App app("Passes mutated inputs to the parsers of external input.");
  app.add_option("--cases", options.cases, "Number of cases")->capture_default_str();
  app.add_option("--from", options.from, "Number of the first case")->capture_default_str();
  app.add_option("--seed", options.seed, "Random seed")->capture_default_str();
  app.add_option("--targets", options.targets, "Only these, by their names in the table");
  CLI11_PARSE(app, argc, argv);
  std::string command = std::string(argv[0]) + " --seed " + std::to_string(options.seed);
  if (!options.targets.empty()) command += " --targets";
  for (const std::string& name : options.targets) command += " " + name;
  adit::fuzz::start_watchdog(command);
  return adit::fuzz::run(options);
}
