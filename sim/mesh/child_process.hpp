// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

using Bytes = std::vector<std::uint8_t>;

/// The child process did not complete; what() is the reason.
class ChildProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs `work` in a child process and returns its result, so that a library that crashes on a
/// damaged file does not affect this process. An exception of `work` is rethrown as
/// std::runtime_error with the same text. Throws ChildProcessError if the child crashes or needs
/// more than `seconds` of processor time. Must be called while the process has one thread.
Bytes run_in_child_process(const std::function<Bytes()>& work, int seconds);

/// Serialisation of a mesh between two processes of one program.
Bytes to_bytes(const TriangleMesh& mesh);
/// For the output of to_bytes() only; the input is not validated.
TriangleMesh mesh_from_bytes(const Bytes& bytes);

}  // namespace adit
