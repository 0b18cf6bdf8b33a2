// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

/// Which laser of the body a scan is from.
enum class LaserId { kFront, kRear };

}  // namespace adit
