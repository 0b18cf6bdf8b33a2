// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace adit {

/// On which line a second YAML document begins, from 1 on, if one does. Looks no further, since
/// yaml-cpp 0.7 finds documents without end in a text such as ",m". Throws as yaml-cpp does.
std::optional<int> second_document_line(const std::string& text);

}  // namespace adit
