// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_file.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "common/config/nearest_name.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"
#include "common/text/text_check.hpp"

namespace adit {
namespace {

// The world file of a random mine of 5 km has 0.1 MB and 7,000 keys and values.
constexpr std::size_t kFileBytesMax = std::size_t{4} << 20;
constexpr std::size_t kNodesMax = 200'000;  // keys and values, aliases expanded
constexpr int kDepthMax = 16;               // sections nest a few levels

/// What a node takes, with all nodes below it.
struct Extent {
  std::size_t nodes = 1;
  std::size_t text_bytes = 0;  // of scalars and keys
  int depth = 0;               // levels below it

  void add_child(const Extent& child) {
    nodes += child.nodes;
    text_bytes += child.text_bytes;
    depth = std::max(depth, child.depth + 1);
  }
};

/// Builds the nodes from the events of the YAML parser. An alias is a copy of its anchor; the sum
/// of all copies is bounded before each, because nested aliases grow exponentially.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& name) : name_(name) {}

  [[noreturn]] void fail(int line, const std::string& reason) const {
    throw ConfigError(name_ + ":" + std::to_string(line) + ": " + reason);
  }

  ConfigNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(line_of(mark), "a second document");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    ConfigNode node;
    node.line = line_of(mark);
    finish(std::move(node), {}, anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) fail(line_of(mark), "an alias within its own anchor");
    charge(line_of(mark), found->second.extent);
    place(found->second.node, found->second.extent);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    ConfigNode node;
    node.kind = ConfigNode::Kind::kScalar;
    node.line = line_of(mark);
    node.text = value;
    node.quoted = tag == "!";
    finish(std::move(node), {.text_bytes = value.size()}, anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(ConfigNode::Kind::kList, line_of(mark), anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(ConfigNode::Kind::kMap, line_of(mark), anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or map whose end has not been read.
  struct Level {
    ConfigNode node;
    Extent extent;
    YAML::anchor_t anchor = 0;
    std::optional<ConfigNode> key;                   // of a map, before its value
    std::unordered_map<std::string, int> key_lines;  // of a map: line of each key
  };

  struct Anchored {
    ConfigNode node;
    Extent extent;
  };

  static int line_of(const YAML::Mark& mark) { return mark.line + 1; }

  void charge(int line, const Extent& extent) {
    total_.nodes += extent.nodes;
    total_.text_bytes += extent.text_bytes;
    if (total_.nodes > kNodesMax || total_.text_bytes > kFileBytesMax) {
      fail(line, "too much content: more than " + std::to_string(kNodesMax) +
                     " keys and values or " + std::to_string(kFileBytesMax) +
                     " bytes with all aliases expanded");
    }
    const auto depth = static_cast<int>(levels_.size()) + extent.depth;
    if (depth > kDepthMax) fail(line, "nested too deeply");
  }

  void open(ConfigNode::Kind kind, int line, YAML::anchor_t anchor) {
    charge(line, {});
    Level level;
    level.node.kind = kind;
    level.node.line = line;
    level.anchor = anchor;
    levels_.push_back(std::move(level));
  }

  void close() {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    remember(level.anchor, level.node, level.extent);
    place(std::move(level.node), level.extent);
  }

  /// A scalar or nothing.
  void finish(ConfigNode node, const Extent& extent, YAML::anchor_t anchor) {
    charge(node.line, extent);
    remember(anchor, node, extent);
    place(std::move(node), extent);
  }

  void remember(YAML::anchor_t anchor, const ConfigNode& node, const Extent& extent) {
    if (anchor == 0) return;
    charge(node.line, extent);
    anchors_[anchor] = {node, extent};
  }

  /// Adds a complete node to the list or map that is open.
  void place(ConfigNode node, const Extent& extent) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& level = levels_.back();
    level.extent.add_child(extent);
    if (level.node.kind == ConfigNode::Kind::kList) {
      level.node.children.push_back(std::move(node));
    } else if (!level.key) {
      set_key(level, std::move(node));
    } else {
      node.line = level.key->line;
      node.key = std::move(level.key->text);
      level.key.reset();
      level.node.children.push_back(std::move(node));
    }
  }

  void set_key(Level& level, ConfigNode key) const {
    if (key.kind != ConfigNode::Kind::kScalar) fail(key.line, "a key must be a scalar");
    const auto [first, added] = level.key_lines.emplace(key.text, key.line);
    if (!added) {
      fail(key.line,
           "duplicate key " + quote(key.text) + "; first on line " + std::to_string(first->second));
    }
    level.key = std::move(key);
  }

  const std::string& name_;
  ConfigNode root_;
  std::vector<Level> levels_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  Extent total_{.nodes = 0};
  int documents_ = 0;
};

/// yaml-cpp 0.7 does not terminate on some binary input.
void require_text(const std::string& text, const TreeBuilder& builder) {
  const auto at = find_non_text_byte(text);
  if (!at) return;
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(*at);
  builder.fail(static_cast<int>(std::count(text.begin(), end, '\n')) + 1, "not a text file");
}

ConfigNode build_root(const std::string& text, const std::string& name) {
  TreeBuilder builder(name);
  if (text.size() > kFileBytesMax) {
    throw ConfigError(name + ": larger than " + std::to_string(kFileBytesMax) + " bytes");
  }
  require_text(text, builder);
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    // Two documents at most: yaml-cpp 0.7 finds an unlimited number of them in a text such as ",m".
    if (parser.HandleNextDocument(builder)) parser.HandleNextDocument(builder);
  } catch (const YAML::Exception& error) {
    builder.fail(error.mark.line + 1, error.msg);
  }
  return builder.take_root();
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view name) const {
  if (kind != Kind::kMap) return nullptr;
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const ConfigNode& child) { return child.key == name; });
  return found != children.end() ? &*found : nullptr;
}

ConfigFile ConfigFile::load(const std::filesystem::path& path) {
  std::string text;
  try {
    text = read_text_file(path, kFileBytesMax);
  } catch (const std::runtime_error& error) {
    throw ConfigError(error.what());
  }
  return parse(text, path.string());
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
      throw_unknown_key(name_, section, "section " + quote(section.key), known);
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
