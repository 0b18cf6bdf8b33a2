// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/view/view_options.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Draws a mine on one sheet, as PNG: its plan without the roof, a section along a tunnel, and a
/// perspective view. The same mine and options give the same bytes on the same system (fonts are
/// the system's). Throws std::runtime_error if the file cannot be written.
void write_view(const Site& site, const std::filesystem::path& png,
                const ViewOptions& options = {});

}  // namespace adit
