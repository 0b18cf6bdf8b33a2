// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/process_faults.hpp"

#include <algorithm>
#include <csignal>
#include <iterator>

#include "sim/live/fault_text.hpp"
#include "sim/live/processes.hpp"

namespace adit {
namespace {

std::string harm(const FaultDescription& fault) {
  const std::string executable = "adit-" + fault.target;
  const int sent = signal_siblings(executable, fault.kind == "kill" ? SIGKILL : SIGSTOP);
  return fault.kind + " " + executable + ": " +
         (sent == 0 ? "none runs that was started beside this program"
                    : std::to_string(sent) + (sent == 1 ? " process" : " processes"));
}

}  // namespace

ProcessFaults::ProcessFaults(const std::vector<FaultDescription>& faults) {
  std::ranges::copy_if(faults, std::back_inserter(faults_), is_of_process);
  std::ranges::stable_sort(faults_, {}, &FaultDescription::at_s);
}

std::vector<ProcessFaults::Harm> ProcessFaults::advance(double elapsed_s) {
  std::vector<Harm> done;
  for (; next_ < faults_.size() && faults_[next_].at_s <= elapsed_s; ++next_) {
    done.push_back({faults_[next_].target, harm(faults_[next_])});
  }
  return done;
}

}  // namespace adit
