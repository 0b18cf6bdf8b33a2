// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/text_file.hpp"

#include <fstream>
#include <stdexcept>

namespace adit {

void write_text(const std::string& text, const std::filesystem::path& path) {
  std::ofstream out(path);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace adit
