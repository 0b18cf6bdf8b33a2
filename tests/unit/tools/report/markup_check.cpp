// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/tools/report/markup_check.hpp"

#include <map>
#include <optional>
#include <string_view>

namespace adit::test {
namespace {

struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
  bool closes = false;  ///< </name>
  bool empty = false;   ///< <name/>
};

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == ':';
}

/// Reads tags in order. Skips the content of scripts and styles.
class MarkupReader {
 public:
  explicit MarkupReader(std::string_view text) : text_(text) {}

  std::optional<Tag> next(std::vector<std::string>& errors) {
    if (!raw_.empty()) at_ = text_.find("</" + raw_, at_);
    raw_.clear();
    const std::size_t open = text_.find('<', at_);
    const std::size_t stray = text_.find('>', at_);
    if (stray != std::string_view::npos && stray < open) errors.emplace_back("unescaped >");
    if (open == std::string_view::npos) return std::nullopt;
    at_ = open + 1;
    if (text_[at_] == '!' || text_[at_] == '?') {
      at_ = text_.find('>', at_) + 1;
      return next(errors);
    }
    Tag tag;
    tag.closes = take('/');
    tag.name = name();
    if (tag.name.empty()) errors.push_back("unescaped < at " + std::to_string(open));
    while (attribute(tag, errors)) {
    }
    tag.empty = take('/');
    if (!take('>')) errors.push_back("<" + tag.name + " is not terminated");
    if (!tag.closes && (tag.name == "script" || tag.name == "style")) raw_ = tag.name;
    return tag;
  }

 private:
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::string name() {
    const std::size_t from = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    return std::string(text_.substr(from, at_ - from));
  }
  bool attribute(Tag& tag, std::vector<std::string>& errors) {
    if (!take(' ')) return false;
    const std::string key = name();
    std::string value;
    if (take('=')) {
      if (!take('"')) errors.push_back(key + " of " + tag.name + " has no quotes");
      const std::size_t end = text_.find('"', at_);
      value = text_.substr(at_, end - at_);
      at_ = end + 1;
      if (value.find('<') != std::string::npos) errors.push_back("a < in " + key);
    }
    if (!tag.attributes.emplace(key, value).second) errors.push_back("duplicate attribute " + key);
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string raw_;
};

std::vector<Tag> tags_of(const std::string& text, std::vector<std::string>& errors) {
  std::vector<Tag> tags;
  MarkupReader reader(text);
  while (auto tag = reader.next(errors)) tags.push_back(std::move(*tag));
  return tags;
}

void check_order(const std::vector<Tag>& tags, std::vector<std::string>& errors) {
  const std::set<std::string> without_end{"meta", "img", "input", "br", "link"};
  std::vector<std::string> open;
  for (const Tag& tag : tags) {
    if (tag.empty || without_end.contains(tag.name)) continue;
    if (!tag.closes) {
      open.push_back(tag.name);
    } else if (open.empty() || open.back() != tag.name) {
      errors.push_back("</" + tag.name + "> closes " + (open.empty() ? "nothing" : open.back()));
      return;
    } else {
      open.pop_back();
    }
  }
  for (const std::string& name : open) errors.push_back("<" + name + "> is never closed");
}

}  // namespace

std::vector<std::string> markup_errors(const std::string& text) {
  std::vector<std::string> errors;
  const std::vector<Tag> tags = tags_of(text, errors);
  check_order(tags, errors);
  std::set<std::string> ids;
  for (const Tag& tag : tags) {
    const auto id = tag.attributes.find("id");
    if (id != tag.attributes.end() && !ids.insert(id->second).second) {
      errors.push_back("duplicate id " + id->second);
    }
  }
  for (const std::string& link : markup_links(text)) {
    if (link.starts_with('#') && !ids.contains(link.substr(1))) {
      errors.push_back("no target for " + link);
    }
  }
  return errors;
}

std::vector<std::string> markup_links(const std::string& text) {
  std::vector<std::string> ignored;
  std::vector<std::string> links;
  for (const Tag& tag : tags_of(text, ignored)) {
    for (const char* key : {"src", "href"}) {
      const auto link = tag.attributes.find(key);
      if (link != tag.attributes.end()) links.push_back(link->second);
    }
  }
  return links;
}

}  // namespace adit::test
