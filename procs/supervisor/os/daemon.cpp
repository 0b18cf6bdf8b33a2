// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/daemon.hpp"

#include <cerrno>
#include <csignal>
#include <system_error>

#include <sys/signalfd.h>
#include <unistd.h>

#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {
namespace {

sigset_t reload_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGHUP);
  return signals;
}

}  // namespace

void ReloadSignal::block() {
  const sigset_t signals = reload_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

ReloadSignal::ReloadSignal() {
  const sigset_t signals = reload_signals();
  descriptor_ = FileDescriptor(signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!descriptor_) throw std::system_error(errno, std::generic_category(), "signalfd");
}

bool ReloadSignal::received() const {
  signalfd_siginfo info{};
  return read(descriptor_.get(), &info, sizeof(info)) == sizeof(info);
}

}  // namespace adit
