// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_file.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "common/config/nearest_name.hpp"
#include "common/config/text_check.hpp"

namespace adit {
namespace {

/// Records the line at which a document begins and ignores its content.
class DocumentStart final : public YAML::EventHandler {
 public:
  [[nodiscard]] int line() const { return line_; }

  void OnDocumentStart(const YAML::Mark& mark) override { line_ = mark.line + 1; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {}
  void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/,
                       YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value /*style*/) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {}
  void OnMapEnd() override {}

 private:
  int line_ = 0;
};

/// The line, from 1, at which a second YAML document begins, if there is one. Parses no further:
/// yaml-cpp 0.7 finds an unlimited number of documents in a text such as ",m". Throws as yaml-cpp
/// does.
std::optional<int> second_document_line(const std::string& text) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  DocumentStart start;
  if (!parser.HandleNextDocument(start) || !parser.HandleNextDocument(start)) return std::nullopt;
  return start.line();
}

constexpr int kDepthMax = 16;  // sections nest a few levels; an alias may contain itself

/// Converts the YAML library's tree to ConfigNode.
class TreeBuilder {
 public:
  explicit TreeBuilder(const std::string& name) : name_(name) {}

  [[nodiscard]] ConfigNode build(const YAML::Node& yaml, int depth = 0) const {
    ConfigNode node;
    node.line = yaml.Mark().line + 1;
    if (depth > kDepthMax) fail(node.line, "nested too deeply");
    if (yaml.IsScalar()) {
      node.kind = ConfigNode::Kind::kScalar;
      node.text = yaml.Scalar();
      node.quoted = yaml.Tag() == "!";
    } else if (yaml.IsSequence()) {
      node.kind = ConfigNode::Kind::kList;
      for (const auto& item : yaml) node.children.push_back(build(item, depth + 1));
    } else if (yaml.IsMap()) {
      node.kind = ConfigNode::Kind::kMap;
      for (const auto& entry : yaml) add_entry(node, entry.first, entry.second, depth);
    }
    return node;
  }

  [[noreturn]] void fail(int line, const std::string& reason) const {
    throw ConfigError(name_ + ":" + std::to_string(line) + ": " + reason);
  }

 private:
  void add_entry(ConfigNode& map, const YAML::Node& key, const YAML::Node& value, int depth) const {
    const int line = key.Mark().line + 1;
    if (!key.IsScalar()) fail(line, "a key must be a scalar");
    if (const ConfigNode* first = map.find(key.Scalar())) {
      fail(line,
           "duplicate key '" + key.Scalar() + "'; first on line " + std::to_string(first->line));
    }
    ConfigNode child = build(value, depth + 1);
    child.key = key.Scalar();
    child.line = line;
    map.children.push_back(std::move(child));
  }

  const std::string& name_;
};

/// yaml-cpp 0.7 does not terminate on some binary input.
void require_text(const std::string& text, const TreeBuilder& builder) {
  const auto at = find_non_text_byte(text);
  if (!at) return;
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(*at);
  builder.fail(static_cast<int>(std::count(text.begin(), end, '\n')) + 1, "not a text file");
}

ConfigNode build_root(const std::string& text, const std::string& name) {
  const TreeBuilder builder(name);
  require_text(text, builder);
  try {
    if (const auto line = second_document_line(text)) builder.fail(*line, "a second document");
    const YAML::Node document = YAML::Load(text);
    return document.IsNull() ? ConfigNode{} : builder.build(document);
  } catch (const YAML::Exception& error) {
    builder.fail(error.mark.line + 1, error.msg);
  }
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view name) const {
  if (kind != Kind::kMap) return nullptr;
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const ConfigNode& child) { return child.key == name; });
  return found != children.end() ? &*found : nullptr;
}

ConfigFile ConfigFile::load(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  if (!in || std::filesystem::is_directory(path) || (in.peek() != EOF && !(text << in.rdbuf()))) {
    throw ConfigError("cannot read " + path.string());
  }
  return parse(text.str(), path.string());
}

ConfigFile ConfigFile::parse(const std::string& text, std::string name) {
  ConfigFile file;
  file.root_ = build_root(text, name);
  file.name_ = std::move(name);
  if (file.root_.kind == ConfigNode::Kind::kScalar || file.root_.kind == ConfigNode::Kind::kList) {
    throw ConfigError(file.name_ + ":" + std::to_string(file.root_.line) +
                      ": the file must be a map of sections, 'name:' with keys below it");
  }
  return file;
}

void ConfigFile::require_known_sections(const std::vector<std::string>& known) const {
  for (const ConfigNode& section : root_.children) {
    if (std::find(known.begin(), known.end(), section.key) == known.end()) {
      throw_unknown_key(name_, section, "section '" + section.key + "'", known);
    }
  }
}

void throw_unknown_key(const std::string& file, const ConfigNode& node, const std::string& what,
                       const std::vector<std::string>& known) {
  std::string message = file + ":" + std::to_string(node.line) + ": unknown " + what;
  const std::string nearest = nearest_name(node.key, known);
  if (!nearest.empty()) {
    message += "; did you mean '" + nearest + "'?";
  } else {
    message += known.empty() ? "; no key is valid here" : "; valid keys:";
    for (std::size_t i = 0; i < known.size(); ++i) message += (i > 0 ? ", " : " ") + known[i];
  }
  throw ConfigError(message);
}

}  // namespace adit
