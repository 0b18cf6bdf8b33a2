// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

/// Which laser of the body a scan is from.
enum class LaserId { kFront, kRear };

inline LaserId other(LaserId laser) {
  return laser == LaserId::kFront ? LaserId::kRear : LaserId::kFront;
}

}  // namespace adit
