// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace adit {

/// Number of bytes of the UTF-8 character at the start of `bytes`; 0 if they are not UTF-8 or it is
/// a control character other than tab and line ends.
std::size_t text_character_bytes(std::string_view bytes);

/// Offset of the first byte that is not allowed in YAML (YAML 1.2, 5.1): a control character or
/// invalid UTF-8. Nothing if all bytes are text.
std::optional<std::size_t> find_non_text_byte(std::string_view bytes);

}  // namespace adit
