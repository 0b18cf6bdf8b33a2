// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/mesh/child_process.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Serialisation of a mesh between two processes of one program.
Bytes to_bytes(const TriangleMesh& mesh);
/// For the output of to_bytes() only; the input is not validated.
TriangleMesh mesh_from_bytes(const Bytes& bytes);

}  // namespace adit
