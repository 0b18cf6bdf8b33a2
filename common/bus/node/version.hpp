// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace adit {

/// The version of the project, e.g. "0.1.0".
std::string version();

}  // namespace adit
