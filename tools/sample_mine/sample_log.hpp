// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "tools/sample_mine/sample_run.hpp"

namespace adit {

/// Writes what is left of a run, as an LCM log of this project (.lcmlog) or as CARMEN text (.log),
/// by the extension of the path. Both poses of a CARMEN line are the odometry: the truth has no
/// place in a log. `progress` is called with the share that is done. Throws std::runtime_error
/// where the file cannot be written or has another extension.
void write_sample_log(
    SampleRun& run, const std::filesystem::path& path,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace adit
