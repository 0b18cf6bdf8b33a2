// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/mesh/child_process.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// A mesh on its way between two processes of one program.
Bytes to_bytes(const TriangleMesh& mesh);
/// Only for what to_bytes has made.
TriangleMesh mesh_from_bytes(const Bytes& bytes);

}  // namespace adit
