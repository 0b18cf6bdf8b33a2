// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/watchdog.hpp"

#include <array>
#include <atomic>
#include <charconv>
#include <csignal>

#include <sys/time.h>
#include <unistd.h>

// Defined only with the address sanitizer. NOLINTNEXTLINE: the sanitizer chooses the name.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*)());

namespace adit::fuzz {
namespace {

int limit_seconds = 5;

std::atomic<std::int64_t> current{-1};
std::atomic<std::int64_t> calls{0};

/// Counts the seconds on the present case, of the computer or of the process.
struct Seconds {
  std::int64_t last_calls = -1;
  int on_case = 0;

  /// Another second; returns how many there were without progress.
  int count() {
    on_case = calls == last_calls ? on_case + 1 : 0;
    last_calls = calls;
    return on_case;
  }
};
Seconds of_process;
Seconds of_computer;
// Beside other programs a process gets a part of a core: only one that is blocked takes this long.
constexpr int kBlockedFactor = 30;

std::string_view command_line;

void print_line(std::string_view text) { (void)!write(STDERR_FILENO, text.data(), text.size()); }

// Async-signal-safe: called by signal handlers.
void print_case() {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), current.load()).ptr;
  print_line("\nrepeat with: ");
  print_line(command_line);
  print_line(" --cases 1 --from ");
  print_line({digits.data(), static_cast<std::size_t>(end - digits.data())});
  print_line("\n");
}

void on_crash(int signal) {
  print_case();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void on_second(int signal) {
  const bool too_long = signal == SIGPROF ? of_process.count() >= limit_seconds
                                          : of_computer.count() >= kBlockedFactor * limit_seconds;
  if (!too_long) return;
  print_line("a case exceeds the time limit");
  print_case();
  _exit(1);
}

}  // namespace

void start_watchdog(std::string_view command, int limit_s) {
  limit_seconds = limit_s;
  command_line = command;
  if (__sanitizer_set_death_callback) {
    __sanitizer_set_death_callback(print_case);
  } else {
    std::signal(SIGSEGV, on_crash);
  }
  std::signal(SIGABRT, on_crash);
  std::signal(SIGALRM, on_second);
  std::signal(SIGPROF, on_second);
  const itimerval each_second{{1, 0}, {1, 0}};
  setitimer(ITIMER_REAL, &each_second, nullptr);
  setitimer(ITIMER_PROF, &each_second, nullptr);
}

void watch(std::int64_t number) {
  current = number;
  ++calls;
}

}  // namespace adit::fuzz
