// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_file_check.hpp"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

// Larger than the text form of a mesh with the maximum number of triangles.
constexpr std::uintmax_t kBytesMax = 1'000'000'000;

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + " is not a mesh: " + why);
}

void check_count(const std::filesystem::path& file, double count, std::uintmax_t bytes) {
  if (count >= 0.0 && count <= static_cast<double>(bytes)) return;
  reject(file,
         "it announces " + number_text(count) + " elements in " + std::to_string(bytes) + " bytes");
}

bool is_other_ply_keyword(const std::string& word) {
  return word == "ply" || word == "format" || word == "comment" || word == "obj_info" ||
         word == "property";
}

/// Checks lines `element NAME COUNT` in the header and its end; without an end, Assimp 5.2 loops
/// endlessly.
void check_ply_header(const std::filesystem::path& file, std::uintmax_t bytes) {
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    std::string name;
    double count = -1.0;
    words >> word;
    if (word == "end_header") return;
    if (word == "element" && words >> name >> count) {
      check_count(file, count, bytes);
    } else if (!is_other_ply_keyword(word)) {
      reject(file, "its header has a line that is not valid in a PLY file");
    }
  }
  reject(file, "its header has no end");
}

/// Checks attributes `count="COUNT"` anywhere in the file.
void check_dae_counts(const std::filesystem::path& file, const std::string& text) {
  constexpr std::string_view kCount = "count=";
  for (std::size_t at = text.find(kCount); at != std::string::npos; at = text.find(kCount, at)) {
    at += kCount.size() + 1;  // and the quotation mark
    if (at >= text.size()) return;
    double count = 0.0;
    if (std::istringstream(text.substr(at, 30)) >> count) check_count(file, count, text.size());
  }
}

/// Checks elements <p>: Assimp 5.2 loops endlessly on an index that is not a number.
void check_dae_indices(const std::filesystem::path& file, const std::string& text) {
  constexpr std::string_view kIndices = "<p>";
  for (std::size_t at = text.find(kIndices); at != std::string::npos;
       at = text.find(kIndices, at)) {
    at = text.find_first_not_of("0123456789 \t\r\n", at + kIndices.size());
    if (at == std::string::npos || text[at] != '<') {
      reject(file, "an index in it is not a number");
    }
  }
}

void check_dae(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  const std::string text = all.str();
  check_dae_counts(file, text);
  check_dae_indices(file, text);
}

}  // namespace

void check_mesh_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw std::runtime_error("there is no mesh file " + file.string());
  }
  const std::uintmax_t bytes = std::filesystem::file_size(file);
  if (bytes == 0) throw std::runtime_error(file.string() + " is empty");
  if (bytes > kBytesMax) {
    throw std::runtime_error(file.string() + " has more than " + std::to_string(kBytesMax) +
                             " bytes: simplify the mesh");
  }
  const std::string ending = file.extension().string();
  if (ending == ".ply") check_ply_header(file, bytes);
  if (ending == ".dae") check_dae(file);
}

}  // namespace adit
