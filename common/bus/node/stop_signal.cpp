// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/stop_signal.hpp"

#include <cerrno>
#include <ctime>
#include <system_error>

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace adit {
namespace {

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

StopSignal::StopSignal() {
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, &previous_);
  descriptor_ = signalfd(-1, &signals, SFD_CLOEXEC);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
}

StopSignal::~StopSignal() {
  // Consume pending signals, which would otherwise kill the process once unblocked.
  const sigset_t signals = stop_signals();
  const timespec no_wait{};
  while (sigtimedwait(&signals, nullptr, &no_wait) > 0) {
  }
  close(descriptor_);
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

bool StopSignal::received() const {
  pollfd poll_descriptor{descriptor_, POLLIN, 0};
  return poll(&poll_descriptor, 1, 0) > 0;
}

}  // namespace adit
