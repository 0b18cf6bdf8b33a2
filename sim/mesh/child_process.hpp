// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

namespace adit {

using Bytes = std::vector<std::uint8_t>;

/// The child did not come to its end; says why.
class ChildProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What `work` returns, done in a process of its own, so that a library which a damaged file leads
/// astray takes nothing with it. What `work` throws is thrown here as std::runtime_error with the
/// same text. Throws ChildProcessError where it crashes, or needs more than `seconds` of processor
/// time. To be called while the process has one thread.
Bytes run_in_child_process(const std::function<Bytes()>& work, int seconds);

}  // namespace adit
