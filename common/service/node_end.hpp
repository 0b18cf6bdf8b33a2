// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace adit {

/// A node must not continue, whatever its messages: one line that says why. Thrown by a handler or
/// a timer it ends the process (exit code 2), unlike a failure on a message.
class NodeEnd : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace adit
