// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iostream>
#include <stdexcept>
#include <string>

#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"

namespace adit {

/// What does not hold of a run is told on standard error, all of it, and counted.
class Requirements {
 public:
  void operator()(bool holds, const std::string& what) {
    if (holds) return;
    std::cerr << "not so: " << what << "\n";
    ++failures_;
  }
  [[nodiscard]] bool all_met() const { return failures_ == 0; }
  [[nodiscard]] int exit_code() const { return all_met() ? 0 : 1; }

 private:
  int failures_ = 0;
};

/// What a message of a log says. Throws std::runtime_error for one that no stage would take.
template <class Msg>
auto value_of(const LogEventView& event) {
  const auto message = decode<Msg>(event.data);
  if (!message) throw std::runtime_error("a message that does not decode");
  const auto value = from_message(*message);
  if (!value) throw std::runtime_error("a message that is refused");
  return *value;
}

}  // namespace adit
