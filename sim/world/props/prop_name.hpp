// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace adit {

/// Which prop it is, as the world file has it: `props.posts[2]`.
inline std::string prop_name(const std::string& list, std::size_t index) {
  return "props." + list + "[" + std::to_string(index) + "]";
}

}  // namespace adit
