// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Where a camera stands, as a command line says it: `X,Y,HEADING_DEG`, in metres and degrees in
/// world, for example `308,0,180`. Throws std::invalid_argument, one line, for anything else.
Pose2 parse_view_place(const std::string& text);

}  // namespace adit
