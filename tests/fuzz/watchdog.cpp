// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/watchdog.hpp"

#include <array>
#include <atomic>
#include <charconv>
#include <csignal>

#include <sys/time.h>
#include <unistd.h>

// There with the address sanitizer only. NOLINTNEXTLINE: the name is not ours.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*)());

namespace adit::fuzz {
namespace {

constexpr int kLimitSeconds = 5;

std::atomic<std::int64_t> current{-1};
std::int64_t seen = -1;
int seconds_seen = 0;
std::string_view command_line;

void say(std::string_view text) { (void)!write(STDERR_FILENO, text.data(), text.size()); }

// Only what a signal handler may do.
void name_the_case() {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), current.load()).ptr;
  say("\nagain by: ");
  say(command_line);
  say(" --cases 1 --from ");
  say({digits.data(), static_cast<std::size_t>(end - digits.data())});
  say("\n");
}

void on_crash(int signal) {
  name_the_case();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void on_second(int) {
  seconds_seen = current == seen ? seconds_seen + 1 : 0;
  seen = current;
  if (seconds_seen < kLimitSeconds) return;
  say("a case takes too long");
  name_the_case();
  _exit(1);
}

}  // namespace

void start_watchdog(std::string_view command) {
  command_line = command;
  if (__sanitizer_set_death_callback) {
    __sanitizer_set_death_callback(name_the_case);
  } else {
    std::signal(SIGSEGV, on_crash);
  }
  std::signal(SIGABRT, on_crash);
  std::signal(SIGALRM, on_second);
  const itimerval each_second{{1, 0}, {1, 0}};
  setitimer(ITIMER_REAL, &each_second, nullptr);
}

void watch(std::int64_t number) { current = number; }

}  // namespace adit::fuzz
