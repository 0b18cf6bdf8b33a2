// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/view/view_options.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Draws a mine on one sheet, as PNG: its plan with the roof lifted off, a section along a drift,
/// and what a person sees who stands in it. The same mine and options give the same bytes on the
/// same system (fonts are the system's). Throws std::runtime_error where the file cannot be
/// written.
void write_view(const Site& site, const std::filesystem::path& png,
                const ViewOptions& options = {});

}  // namespace adit
