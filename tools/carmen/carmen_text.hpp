// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/carmen/carmen_line.hpp"

namespace adit {

/// A scan as a FLASER line, without the end of the line. Ranges are written to the centimetre,
/// which is what planar lasers resolve; the angles are not written, and are the reader's half
/// circle.
std::string flaser_line(const CarmenScan& scan);

}  // namespace adit
