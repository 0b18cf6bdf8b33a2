// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_writer.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

/// In YAML's double quotes, which can hold any byte.
std::string quoted_yaml(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string list(const std::vector<double>& values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += (i > 0 ? ", " : "") + number_text(values[i]);
  }
  return text + "]";
}

}  // namespace

ConfigWriter::ConfigWriter(std::string_view section) { open(section); }

void ConfigWriter::operator()(std::string_view key, const bool& value) {
  line(key, value ? "true" : "false", {});
}

void ConfigWriter::operator()(std::string_view key, const int& value, const Bounds& bounds) {
  line(key, std::to_string(value), bounds);
}

void ConfigWriter::operator()(std::string_view key, const double& value, const Bounds& bounds) {
  line(key, number_text(value), bounds);
}

void ConfigWriter::operator()(std::string_view key, const std::string& value) {
  line(key, quoted_yaml(value), {});
}

void ConfigWriter::operator()(std::string_view key, const std::string& value,
                              const OneOf& allowed) {
  text_ += indent() + std::string(key) + ": " + quoted_yaml(value) + "  # " + allowed.text() + "\n";
}

void ConfigWriter::operator()(std::string_view key, const std::vector<double>& values,
                              const Bounds& bounds) {
  line(key, list(values), bounds);
}

void ConfigWriter::operator()(std::string_view key, Pose2& pose) {
  PoseKeys keys{pose};
  (*this)(key, keys);
}

void ConfigWriter::open(std::string_view key) {
  text_ += indent() + std::string(key) + ":\n";
  ++depth_;
}

void ConfigWriter::begin_item() {
  ++depth_;
  at_item_ = true;
}

void ConfigWriter::end_item() {
  at_item_ = false;
  --depth_;
}

/// The indentation of a line; the dash of a list item replaces the last level.
std::string ConfigWriter::indent() {
  if (!std::exchange(at_item_, false)) return std::string(2 * depth_, ' ');
  return std::string(2 * (depth_ - 1), ' ') + "- ";
}

void ConfigWriter::line(std::string_view key, const std::string& value, const Bounds& bounds) {
  text_ += indent() + std::string(key) + ": " + value;
  if (!bounds.is_unbounded()) text_ += "  # " + bounds.text();
  text_ += '\n';
}

}  // namespace adit
