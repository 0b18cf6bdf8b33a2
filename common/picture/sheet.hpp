// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "common/picture/canvas.hpp"

namespace adit {

/// Draws from a place on and says where it ended, downwards [pixels].
using DrawDown = std::function<double(const Canvas& canvas, double left, double top)>;

/// A white sheet of so much width between its margins, as high as what is drawn on it. Draws
/// twice: to see how high that is, and on the sheet. Throws std::runtime_error where the file
/// cannot be written.
void write_sheet(const std::filesystem::path& path, double width, const DrawDown& draw);

}  // namespace adit
