// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/version.hpp"

namespace adit {

std::string version() { return ADIT_VERSION; }

}  // namespace adit
