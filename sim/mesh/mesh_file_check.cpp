// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_file_check.hpp"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace adit {
namespace {

// A mesh of as many triangles as a world may have, written as text, is smaller.
constexpr std::uintmax_t kBytesMax = 1'000'000'000;

void check_count(const std::filesystem::path& file, double count, std::uintmax_t bytes) {
  if (count >= 0.0 && count <= static_cast<double>(bytes)) return;
  std::ostringstream what;
  what << file.string() << " is not a mesh: it announces " << count << " elements in " << bytes
       << " bytes";
  throw std::runtime_error(what.str());
}

/// Lines `element NAME COUNT`, in the header.
void check_ply_counts(const std::filesystem::path& file, std::uintmax_t bytes) {
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line) && line.rfind("end_header", 0) != 0;) {
    std::istringstream words(line);
    std::string word;
    std::string name;
    double count = 0.0;
    if (words >> word >> name >> count && word == "element") check_count(file, count, bytes);
  }
}

/// Attributes `count="COUNT"`, anywhere.
void check_dae_counts(const std::filesystem::path& file, std::uintmax_t bytes) {
  constexpr std::string_view kCount = "count=";
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  const std::string text = all.str();
  for (std::size_t at = text.find(kCount); at != std::string::npos; at = text.find(kCount, at)) {
    at += kCount.size() + 1;  // and the quotation mark
    if (at >= text.size()) return;
    double count = 0.0;
    if (std::istringstream(text.substr(at, 30)) >> count) check_count(file, count, bytes);
  }
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
                             " bytes: thin the mesh out");
  }
  const std::string ending = file.extension().string();
  if (ending == ".ply") check_ply_counts(file, bytes);
  if (ending == ".dae") check_dae_counts(file, bytes);
}

}  // namespace adit
