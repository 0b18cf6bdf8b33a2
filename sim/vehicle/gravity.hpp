// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

inline constexpr double kGravityM_S2 = 9.81;

}  // namespace adit
