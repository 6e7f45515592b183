// The nodes of a VRML file in versions 1.0 and 2.0 (ISO/IEC 14772-1, VRML97): nodes of any type, parsed by
// their braces and fields. X3D, in XML and in VRML's syntax, is read as the nodes of VRML97 that it stands
// for.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_reader.h"

namespace holdfast::io {

class XmlReader;
struct VrmlNode;
struct XmlTag;

struct VrmlField {
  std::vector<double> numbers;
  std::vector<const VrmlNode*> nodes;  ///< nullptr for NULL
  std::string word;                    ///< the last other value: TRUE, an enumerator, a text
};

struct VrmlNode {
  std::string type, name;  ///< `name`: given by DEF
  std::size_t position = 0;
  std::map<std::string, VrmlField, std::less<>> fields;
  std::vector<const VrmlNode*> children;  ///< in version 1.0: nodes inside the node

  /// An empty field if there is none with this name.
  [[nodiscard]] const VrmlField& field(std::string_view field) const;
};

class VrmlScene {
 public:
  /// Parses the whole file. Throws FileError.
  explicit VrmlScene(const Source& source);

  [[nodiscard]] bool is_first_version() const { return is_first_version_; }
  [[nodiscard]] const std::vector<const VrmlNode*>& roots() const { return roots_; }
  /// Throws a FileError for the line of a node.
  [[noreturn]] void fail(const VrmlNode& node, const std::string& reason) const;

 private:
  struct Token {
    enum class Kind { end, word, number, text, sign } kind;
    std::string_view text;
    std::size_t position;
  };

  void read_head();
  /// The scene of an X3D file (vrml_x3d.cpp).
  void read_xml();
  VrmlNode* open_node(const XmlReader& xml, const XmlTag& tag, VrmlNode* around);
  /// The kind of node as which a kind of X3D is read.
  [[nodiscard]] static std::string type_in_x3d(const std::string& name);
  static void read_numbers(const XmlReader& xml, const XmlTag& tag, std::string_view text, VrmlField& field);
  void close(VrmlNode& node);
  void turn_into_vrml(VrmlNode& node);
  void skip_blanks();
  Token next();
  [[nodiscard]] Token peek();
  Token expect(std::string_view what);
  [[nodiscard]] double number(const Token& token) const;
  /// To be called after the opening bracket or brace.
  void skip_to_end();
  bool skip_x3d_statement(std::string_view word);
  bool skip_statement(std::string_view word);
  [[nodiscard]] const VrmlNode* read_node(const Token& first);
  [[nodiscard]] const VrmlNode* read_body(const Token& type, std::string name);
  void read_value(VrmlField& field);
  void read_item(VrmlField& field, const Token& token);
  [[nodiscard]] bool begins_node(const Token& token);
  [[noreturn]] void fail(const Token& token, const std::string& reason) const;

  Source source_;
  TextReader errors_;
  std::size_t position_ = 0, depth_ = 0;
  bool is_first_version_ = false, is_x3d_ = false;
  std::deque<VrmlNode> nodes_;
  std::map<std::string, const VrmlNode*, std::less<>> named_;
  std::vector<const VrmlNode*> roots_;
};

}  // namespace holdfast::io
