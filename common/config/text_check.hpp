// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace adit {

/// Where the first byte is that no YAML file has (YAML 1.2, 5.1): a control character, or one that
/// is no UTF-8. Nothing where all is text.
std::optional<std::size_t> find_non_text_byte(std::string_view bytes);

}  // namespace adit
