// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// What a surface of that name is, by a word in it, whatever its case: `floor`, `roof`, `wall`,
/// `rail`, `sleeper`, `post`, `crib`, `rubble`, `beam`, `cable`, `car` or `water`. Rock of kind
/// `kOther` without one.
std::pair<PartKind, Material> surface_named(std::string name);

}  // namespace adit
