// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iostream>
#include <stdexcept>
#include <string>

#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"

namespace adit {

/// Prints failed requirements on standard error and counts them.
class Requirements {
 public:
  void operator()(bool holds, const std::string& requirement) {
    if (holds) return;
    std::cerr << "requirement failed: " << requirement << "\n";
    ++failures_;
  }
  [[nodiscard]] bool all_met() const { return failures_ == 0; }
  [[nodiscard]] int exit_code() const { return all_met() ? 0 : 1; }

 private:
  int failures_ = 0;
};

/// Decodes a message of a log. Throws std::runtime_error for a message that stages reject.
template <class Msg>
auto value_of(const LogEventView& event) {
  const auto message = decode<Msg>(event.data);
  if (!message) throw std::runtime_error("malformed message");
  const auto value = from_message(*message);
  if (!value) throw std::runtime_error("invalid message");
  return *value;
}

}  // namespace adit
