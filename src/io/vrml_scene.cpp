#include "io/vrml_scene.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/labels.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kDeepestNode = 256;

bool is_sign(char c) {
  return c == '{' || c == '}' || c == '[' || c == ']' || c == '(' || c == ')' || c == '|';
}

// VRML treats commas as blanks.
bool is_blank(char c) { return static_cast<unsigned char>(c) <= ' ' || c == ','; }

}  // namespace

const VrmlField& VrmlNode::field(std::string_view field) const {
  static const VrmlField none;
  const auto found = fields.find(field);
  return found == fields.end() ? none : found->second;
}

VrmlScene::VrmlScene(const Source& source) : source_(source), errors_(source) {
  const std::size_t start = source.bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start != std::string_view::npos && source.bytes[start] == '<') {
    read_xml();
    return;
  }
  read_head();
  for (Token token = next(); token.kind != Token::Kind::end; token = next()) {
    if (token.kind != Token::Kind::word) fail(token, "expected a node, found " + in_quotes(token.text));
    if (skip_statement(token.text)) continue;
    if (!begins_node(token)) fail(token, "expected a node, found " + in_quotes(token.text));
    if (const VrmlNode* node = read_node(token)) roots_.push_back(node);
  }
}

void VrmlScene::fail(const VrmlNode& node, const std::string& reason) const {
  errors_.fail_at(node.position, reason);
}

void VrmlScene::fail(const Token& token, const std::string& reason) const {
  if (token.kind == Token::Kind::end)
    errors_.fail_at(token.position, "the file ends inside a node; it is truncated");
  errors_.fail_at(token.position, reason);
}

void VrmlScene::read_head() {
  if (source_.bytes.starts_with("\xEF\xBB\xBF")) position_ = 3;
  const std::string_view text = source_.bytes.substr(position_);
  is_first_version_ = text.starts_with("#VRML V1.0");
  is_x3d_ = text.starts_with("#X3D V");
  if (!is_first_version_ && !is_x3d_ && !text.starts_with("#VRML V2.0"))
    errors_.fail_at(0,
                    "a VRML file begins with '#VRML V1.0 ascii', '#VRML V2.0 utf8' or '#X3D V3.0 utf8'; this "
                    "one does not");
}

void VrmlScene::skip_blanks() {
  const std::string_view all = source_.bytes;
  while (position_ < all.size()) {
    if (all[position_] == '#')
      position_ = std::min(all.find_first_of("\r\n", position_), all.size());
    else if (is_blank(all[position_]))
      ++position_;
    else
      return;
  }
}

VrmlScene::Token VrmlScene::next() {
  beat(source_.watch);
  skip_blanks();
  const std::string_view all = source_.bytes;
  const std::size_t start = position_;
  if (start == all.size()) return {Token::Kind::end, {}, start};
  const char first = all[start];
  if (first == '"') {
    for (++position_; position_ < all.size() && all[position_] != '"'; ++position_)
      if (all[position_] == '\\') ++position_;
    if (position_ >= all.size()) errors_.fail_at(start, "a text that does not end; the file is truncated");
    ++position_;
    return {Token::Kind::text, all.substr(start + 1, position_ - start - 2), start};
  }
  if (is_sign(first)) return ++position_, Token{Token::Kind::sign, all.substr(start, 1), start};
  while (position_ < all.size() && !is_blank(all[position_]) && !is_sign(all[position_]) &&
         all[position_] != '"' && all[position_] != '#')
    ++position_;
  const bool is_number = (first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.';
  return {is_number ? Token::Kind::number : Token::Kind::word, all.substr(start, position_ - start), start};
}

VrmlScene::Token VrmlScene::peek() {
  const std::size_t here = position_;
  const Token token = next();
  position_ = here;
  return token;
}

VrmlScene::Token VrmlScene::expect(std::string_view what) {
  const Token token = next();
  if (token.kind != Token::Kind::word)
    fail(token, "expected " + std::string(what) + ", found " + in_quotes(token.text));
  return token;
}

double VrmlScene::number(const Token& token) const {
  if (token.text.starts_with("0x")) return 0;  // of a picture
  double value = 0;
  const char* const end = token.text.data() + token.text.size();
  const auto [behind, error] = parse_real(token.text.data(), end, value);
  if (error != std::errc() || behind != end) fail(token, in_quotes(token.text) + " is no number");
  return value;
}

void VrmlScene::skip_to_end() {
  for (std::size_t open = 1; open > 0;) {
    const Token token = next();
    if (token.kind == Token::Kind::end) fail(token, {});
    if (token.kind != Token::Kind::sign) continue;
    if (token.text == "{" || token.text == "[") ++open;
    if (token.text == "}" || token.text == "]") --open;
  }
}

/// Skips a statement of X3D that is no node, or a field that a node declares (ISO/IEC 19776-2, 4.2): so many
/// words follow its keyword.
bool VrmlScene::skip_x3d_statement(std::string_view word) {
  struct Statement {
    std::string_view keyword;
    std::size_t words;
  };
  static constexpr Statement kStatements[] = {
      {"PROFILE", 1}, {"COMPONENT", 1}, {"META", 2},       {"UNIT", 3},        {"EXPORT", 1},
      {"IMPORT", 1},  {"inputOnly", 2}, {"outputOnly", 2}, {"inputOutput", 2}, {"initializeOnly", 2}};
  const auto found = std::find_if(std::begin(kStatements), std::end(kStatements),
                                  [&](const Statement& s) { return s.keyword == word; });
  if (!is_x3d_ || found == std::end(kStatements)) return false;
  for (std::size_t i = 0; i < found->words; ++i)
    if (const Token token = next(); token.kind == Token::Kind::end || token.kind == Token::Kind::sign)
      fail(token, "expected what belongs to " + in_quotes(word) + ", found " + in_quotes(token.text));
  if (const Token as = peek(); (word == "EXPORT" || word == "IMPORT") && as.text == "AS") {
    next();
    static_cast<void>(expect("a name"));
  }
  if (word == "inputOutput" || word == "initializeOnly") {
    VrmlField value;
    read_value(value);
  }
  return true;
}

/// Skips a statement that is no node: prototypes, which are not read, and event routes.
bool VrmlScene::skip_statement(std::string_view word) {
  if (skip_x3d_statement(word)) return true;
  if (word == "ROUTE") {
    for (const char* what : {"what a route begins with", "TO", "what a route leads to"})
      static_cast<void>(expect(what));
    return true;
  }
  if (word != "PROTO" && word != "EXTERNPROTO") return false;
  static_cast<void>(expect("the name of a kind of node"));
  for (const char* open : {"[", word == "PROTO" ? "{" : ""}) {
    if (*open == '\0') break;
    const Token token = next();
    if (token.text != open || token.kind != Token::Kind::sign)
      fail(token, std::string("expected '") + open + "', found " + in_quotes(token.text));
    skip_to_end();
  }
  if (word == "EXTERNPROTO") {
    VrmlField names;
    read_value(names);
  }
  return true;
}

bool VrmlScene::begins_node(const Token& token) {
  return token.text == "DEF" || token.text == "USE" || token.text == "NULL" || peek().text == "{";
}

/// Returns null for NULL. `first` is DEF, USE, NULL or a type.
const VrmlNode* VrmlScene::read_node(const Token& first) {
  if (first.text == "NULL") return nullptr;
  if (first.text == "USE") {
    const Token name = expect("a name");
    const auto found = named_.find(name.text);
    if (found == named_.end()) fail(name, "no node before this one is named " + in_quotes(name.text));
    return found->second;
  }
  if (first.text != "DEF") return read_body(first, {});
  const Token name = expect("a name");
  const VrmlNode* node = read_body(expect("the type of a node"), std::string(name.text));
  named_[std::string(name.text)] = node;
  return node;
}

const VrmlNode* VrmlScene::read_body(const Token& type, std::string name) {
  if (const Token open = next(); open.text != "{" || open.kind != Token::Kind::sign)
    fail(open, "expected '{' after " + in_quotes(type.text) + ", found " + in_quotes(open.text));
  if (++depth_ > kDeepestNode) fail(type, "nodes stand more than " + std::to_string(kDeepestNode) + " deep");
  VrmlNode node;
  node.type = type.text;
  node.name = std::move(name);
  node.position = type.position;
  if (type.text == "Script") {
    skip_to_end();
  } else {
    for (Token token = next(); token.text != "}" || token.kind != Token::Kind::sign; token = next()) {
      if (token.kind != Token::Kind::word)
        fail(token, "expected a field of " + in_quotes(type.text) + ", found " + in_quotes(token.text));
      if (skip_statement(token.text)) continue;
      if (begins_node(token)) {
        if (const VrmlNode* child = read_node(token)) node.children.push_back(child);
      } else {
        read_value(node.fields[std::string(token.text)]);
      }
    }
  }
  --depth_;
  if (is_x3d_) turn_into_vrml(node);
  return &nodes_.emplace_back(std::move(node));
}

/// X3D calls the nodes of all groups children.
void VrmlScene::turn_into_vrml(VrmlNode& node) {
  node.type = type_in_x3d(node.type);
  for (const auto& [type, usual] : {std::pair("Switch", "choice"), std::pair("LOD", "level")})
    if (node.type == type && node.fields.contains("children"))
      node.fields[usual] = std::move(node.fields["children"]);
  close(node);
}

void VrmlScene::read_value(VrmlField& field) {
  field = {};
  const Token token = peek();
  if (token.kind == Token::Kind::sign && token.text == "[") {
    next();
    for (Token item = next(); item.text != "]" || item.kind != Token::Kind::sign; item = next())
      read_item(field, item);
  } else if (token.kind == Token::Kind::sign && token.text == "(") {  // flags of version 1.0
    for (Token item = next(); item.text != ")"; item = next())
      if (item.kind == Token::Kind::end) fail(item, {});
  } else if (token.kind == Token::Kind::number) {
    while (peek().kind == Token::Kind::number) field.numbers.push_back(number(next()));
  } else if (token.kind == Token::Kind::word || token.kind == Token::Kind::text) {
    read_item(field, next());
    if (token.text == "IS") static_cast<void>(expect("a field"));
  } else {
    fail(token, "expected a value, found " + in_quotes(token.text));
  }
}

void VrmlScene::read_item(VrmlField& field, const Token& token) {
  if (token.kind == Token::Kind::number) {
    field.numbers.push_back(number(token));
  } else if (token.kind == Token::Kind::word && begins_node(token)) {
    field.nodes.push_back(read_node(token));
  } else if (token.kind == Token::Kind::word || token.kind == Token::Kind::text) {
    field.word = token.text;
  } else {
    fail(token, "expected a value, found " + in_quotes(token.text));
  }
}

}  // namespace holdfast::io
