// Parses a JSON text into a tree.
#include "io/json_reader.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "text/parse.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kDeepest = 128;
/// A value takes thirty times the memory of its text; mesh files have far fewer.
constexpr std::size_t kMostValues = std::size_t{1} << 23;

/// A byte for the parser that also watches for cancellation, because the parser checks nothing else in a long
/// string.
struct WatchedByte {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  const char* at;
  Watch* watch;
  const char** reached;  ///< the end of the bytes read

  char operator*() const { return *at; }
  WatchedByte& operator++() {
    beat(watch);
    *reached = ++at;
    return *this;
  }
  bool operator==(const WatchedByte& other) const { return at == other.at; }
  bool operator!=(const WatchedByte& other) const { return at != other.at; }
};

/// Builds the tree within limits. nlohmann's own parser has none, and with a callback takes time quadratic in
/// the number of objects in an array.
class TreeMaker final : public nlohmann::json_sax<Json> {
 public:
  TreeMaker(const Source& source, std::size_t begin, std::size_t end)
      : source_(source), begin_(begin), text_(source.bytes.substr(begin, end - begin)) {}

  Json read() {
    const char* const end = text_.data() + text_.size();
    Json::sax_parse(WatchedByte{text_.data(), source_.watch, &reached_},
                    WatchedByte{end, source_.watch, &reached_}, this);
    // The parser stops at a zero byte.
    if (std::any_of(reached_, end, [](char c) { return c != '\0'; })) fail("expected the end of the text");
    return std::move(root_);
  }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return value == 0 ? put(-0.0) : put(value); }
  bool number_unsigned(std::uint64_t value) override { return put(value); }
  bool number_float(double value, const std::string& spelled) override {
    // In the locale of the calling program, the parser may have read only a part of the number.
    std::string text = spelled;
    const auto is_point = [](char c) {
      return std::string_view("0123456789+-eE").find(c) == std::string::npos;
    };
    std::replace_if(text.begin(), text.end(), is_point, '.');
    parse_double(text.data(), text.data() + text.size(), value);
    return put(value);
  }
  bool string(std::string& value) override { return put(std::move(value)); }
  bool binary(Json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& value) override {
    key_ = std::move(value);
    return true;
  }
  bool parse_error(std::size_t bytes, const std::string&, const nlohmann::detail::exception& error) override {
    constexpr int kOverflow = 406;
    if (error.id == kOverflow) fail_at(bytes, "a number that is beyond those of double precision");
    // The exception's name and the position precede the reason; a token follows it.
    std::string_view reason = error.what();
    if (const auto place = reason.find(": "); place != std::string_view::npos)
      reason.remove_prefix(place + 2);
    fail_at(bytes, std::string(reason.substr(0, reason.find("; last read"))));
  }

 private:
  Json& place() {
    if (open_.empty()) return root_;
    if (open_.back()->is_object()) return (*open_.back())[key_];
    return open_.back()->emplace_back();
  }
  Json& placed(Json&& value) {
    if (++values_ > kMostValues) fail("more than " + std::to_string(kMostValues) + " values");
    return place() = std::move(value);
  }
  bool put(Json&& value) {
    placed(std::move(value));
    return true;
  }
  bool open(Json&& value) {
    if (open_.size() > kDeepest) fail("values in values without end");
    open_.push_back(&placed(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  [[noreturn]] void fail(const std::string& reason) const {
    fail_at(static_cast<std::size_t>(reached_ - text_.data()), reason);
  }
  /// Fails at the last of the first `bytes` bytes of the text.
  [[noreturn]] void fail_at(std::size_t bytes, const std::string& reason) const {
    const std::size_t position = begin_ + std::max<std::size_t>(bytes, 1) - 1;
    const std::string_view before = source_.bytes.substr(0, position);
    const bool has_lines = begin_ == 0 && source_.bytes.find('\n') != std::string_view::npos;
    throw FileError(source_.path,
                    has_lines ? "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n'))
                              : "byte " + std::to_string(position),
                    reason);
  }

  Source source_;
  std::size_t begin_;
  std::string_view text_;
  const char* reached_ = text_.data();
  Json root_;
  std::vector<Json*> open_;  ///< the open arrays and objects, from outside to inside
  std::string key_;
  std::size_t values_ = 0;
};

/// Whether `value` is in `tree`; if so, appends the path to it to `way`.
bool find_way(const Json& tree, const Json& value, std::vector<std::string>& way) {
  if (&tree == &value) return true;
  for (const auto& [key, item] : tree.items()) {
    if (!item.is_structured() && &item != &value) continue;
    way.push_back(key);
    if (find_way(item, value, way)) return true;
    way.pop_back();
  }
  return false;
}

}  // namespace

Json read_json(const Source& source, std::size_t begin, std::size_t end) {
  return TreeMaker(source, begin, end).read();
}

const Json* member(const Json& object, std::string_view key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::string shown(const Json& value) {
  if (value.is_string()) return value.get_ref<const std::string&>();
  return value.is_structured() ? value.type_name() : value.dump();
}

void fail_in_json(const Source& source, const Json& root, const Json& value, const std::string& reason) {
  std::vector<std::string> way;
  Json::json_pointer place;
  if (find_way(root, value, way))
    for (const std::string& key : way) place /= key;
  throw FileError(source.path, place.to_string(), reason);
}

}  // namespace holdfast::io
