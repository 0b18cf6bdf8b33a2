// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/process_table.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

using Row = std::vector<std::string>;

// In the order of the columns that the supervisor sends.
enum Column { kName, kDeputy, kGroup, kState, kPid, kCpu, kMemory, kRestarts, kNote, kColumns };

const Row kHeading{"NAME", "COMPUTER", "GROUP", "STATE", "PID", "CPU %", "MB", "RESTARTS", ""};

std::string scaled(const std::string& number, double factor) {
  return fmt::format("{:.1f}", parse_number<double>(number).value_or(0.0) * factor);
}

Row tokens_of(const std::string& line) {
  Row tokens;
  std::istringstream text(line);
  for (std::string token; std::getline(text, token, '\t');) tokens.push_back(token);
  tokens.resize(kColumns);
  return tokens;
}

/// CPU and memory are shown only for running processes.
Row formatted(Row row) {
  const bool running = row[kPid] != "0";
  row[kPid] = running ? row[kPid] : "-";
  row[kCpu] = running ? scaled(row[kCpu], 100.0) : "-";
  row[kMemory] = running ? scaled(row[kMemory], 1e-6) : "-";
  return row;
}

bool is_number_column(std::size_t column) { return column >= kPid && column <= kRestarts; }

std::size_t width_of(const std::vector<Row>& rows, std::size_t column) {
  std::size_t width = 0;
  for (const Row& row : rows) width = std::max(width, row[column].size());
  return width;
}

std::string padded(const std::string& token, std::size_t width, bool right) {
  const std::string blanks(width - token.size(), ' ');
  return right ? blanks + token : token + blanks;
}

}  // namespace

std::string process_table_text(std::string_view rows) {
  std::vector<Row> table;
  std::istringstream lines{std::string(rows)};
  for (std::string line; std::getline(lines, line);) table.push_back(formatted(tokens_of(line)));
  const bool groups = width_of(table, kGroup) > 0;
  table.insert(table.begin(), kHeading);
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < kColumns; ++i) widths.push_back(width_of(table, i));
  std::string text;
  for (const Row& row : table) {
    std::string line;
    for (std::size_t i = 0; i < kColumns; ++i) {
      if (i == kGroup && !groups) continue;
      line += padded(row[i], widths[i], is_number_column(i)) + "  ";
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace adit
