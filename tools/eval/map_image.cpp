// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/map_image.hpp"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Keys = std::map<std::string, std::string>;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), reason));
}

/// Lines `key: value`; the YAML file has no nesting.
Keys read_keys(const std::filesystem::path& path) {
  std::istringstream in(read_text_file(path));
  Keys keys;
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) keys[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return keys;
}

/// `count` numbers, separated by blanks, commas and brackets.
std::vector<double> numbers(const std::filesystem::path& path, const Keys& keys,
                            const std::string& key, std::size_t count) {
  const auto found = keys.find(key);
  if (found == keys.end()) fail(path, fmt::format("has no {}", key));
  std::string text = found->second;
  for (char& c : text) {
    if (c == '[' || c == ']' || c == ',') c = ' ';
  }
  std::istringstream stream(text);
  std::vector<double> values{std::istream_iterator<double>(stream), {}};
  if (values.size() != count) {
    fail(path, fmt::format("cannot use {} as {}", quote(found->second), key));
  }
  return values;
}

struct GreyImage {
  int width = 0;
  int height = 0;
  std::string rows;  // from the top
};

/// Next number of a PGM header. A comment extends from # to the end of the line.
int next_number(std::istream& in) {
  while ((in >> std::ws).peek() == '#')
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  int number = 0;
  in >> number;
  return number;
}

GreyImage read_pgm(const std::filesystem::path& path) {
  std::istringstream in(read_text_file(path));
  std::string magic;
  in >> magic;
  GreyImage image;
  image.width = next_number(in);
  image.height = next_number(in);
  const int white = next_number(in);
  if (!in || magic != "P5" || white != 255 || image.width < 1 || image.height < 1) {
    fail(path, "is not a binary PGM of 8 bits");
  }
  in.get();
  image.rows.assign(std::istreambuf_iterator<char>(in), {});
  const std::size_t needed =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.rows.size() != needed)
    fail(path, "has a different number of pixels than its header says");
  return image;
}

}  // namespace

std::vector<Eigen::Vector2d> read_occupied_cells(const std::filesystem::path& yaml) {
  const Keys keys = read_keys(yaml);
  if (!keys.contains("image")) fail(yaml, "has no image");
  const double resolution = numbers(yaml, keys, "resolution", 1)[0];
  if (!(resolution > 0.0)) fail(yaml, "has a resolution that is not positive");
  const std::vector<double> origin = numbers(yaml, keys, "origin", 3);
  const Pose2 T_map_image{origin[0], origin[1], origin[2]};
  const bool negate = numbers(yaml, keys, "negate", 1)[0] != 0.0;
  const double threshold = numbers(yaml, keys, "occupied_thresh", 1)[0];
  const GreyImage image = read_pgm(yaml.parent_path() / keys.at("image"));

  std::vector<Eigen::Vector2d> occupied;
  for (std::size_t i = 0; i < image.rows.size(); ++i) {
    const double grey = static_cast<unsigned char>(image.rows[i]) / 255.0;
    if ((negate ? grey : 1.0 - grey) <= threshold) continue;
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t column = i % width;
    const std::size_t row = i / width;
    const Eigen::Vector2d cell(static_cast<double>(column),
                               image.height - 1 - static_cast<double>(row));
    occupied.emplace_back(T_map_image * (resolution * (cell + Eigen::Vector2d(0.5, 0.5))));
  }
  return occupied;
}

}  // namespace adit
