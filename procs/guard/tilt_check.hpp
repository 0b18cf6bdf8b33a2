// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

namespace adit {

/// Why a body that leans like that is to stand: pitch or roll beyond the limit, as Vehicle counts
/// them.
std::optional<std::string> tilt_reason(const Eigen::Vector3d& up_body, double tilt_max_rad);

}  // namespace adit
