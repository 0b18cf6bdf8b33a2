// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/parser.hpp"

#include <fstream>
#include <iterator>

#include "common/config/config_file.hpp"
#include "common/config/text_check.hpp"
#include "common/process_list/check.hpp"
#include "common/process_list/command_parser.hpp"
#include "common/process_list/names.hpp"
#include "common/process_list/script_parser.hpp"

namespace adit {
namespace {

using Kind = ListToken::Kind;

std::string parse_group_name(TokenStream& tokens, const std::string& outer) {
  const ListToken name = tokens.expect(Kind::kString, "the name of the group in quotes");
  require_name(tokens, name);
  std::string group = outer.empty() ? name.text : outer + "/" + name.text;
  require_names(tokens, name.place, group);
  return group;
}

void parse_group(TokenStream& tokens, const std::string& outer, ProcessList& list) {
  const std::string group = parse_group_name(tokens, outer);
  tokens.expect(Kind::kOpen, "'{'");
  while (!tokens.take_if(Kind::kClose)) {
    if (tokens.next().kind != Kind::kWord) tokens.fail_next("cmd, group or '}'");
    if (tokens.expect_one_of(Kind::kWord, {"cmd", "group"}) == "cmd") {
      list.commands.push_back(parse_listed_command(tokens, group));
    } else {
      parse_group(tokens, group, list);
    }
  }
}

void parse_item(TokenStream& tokens, ProcessList& list) {
  const std::string what = tokens.expect_one_of(Kind::kWord, {"cmd", "group", "script"});
  if (what == "cmd") {
    list.commands.push_back(parse_listed_command(tokens, ""));
  } else if (what == "group") {
    parse_group(tokens, "", list);
  } else {
    list.scripts.push_back(parse_process_script(tokens));
  }
}

/// Also of strings within: what is no text would go onto terminals and other computers.
void require_text(std::string_view text, const std::string& name) {
  const auto place = first_that_is_no_text(text);
  if (!place) return;
  throw ConfigError(name + ": byte " + std::to_string(*place) + " is no text");
}

}  // namespace

ProcessList parse_process_list(std::string_view text, const std::string& name) {
  require_text(text, name);
  ProcessList list;
  TokenStream tokens(text, name);
  while (tokens.next().kind != Kind::kEndOfFile) parse_item(tokens, list);
  if (const std::string wrong = what_is_wrong(list); !wrong.empty()) {
    throw ConfigError(name + ": " + wrong);
  }
  return list;
}

ProcessList read_process_list(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) throw ConfigError(path.string() + ": cannot be read");
  return parse_process_list(text, path.string());
}

}  // namespace adit
