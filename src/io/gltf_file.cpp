// A glTF file as its JSON and its arrays of numbers.
#include "io/gltf_file.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "io/base64.h"
#include "io/byte_reader.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::string_view kInText = "data:";  ///< start of the URI of an embedded buffer
constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

struct Component {
  std::uint64_t code;
  std::size_t bytes;
  double (*load)(const char*);
  double largest;  ///< the value that stands for 1 if normalized
};

template <typename T>
double loaded(const char* bytes) {
  return static_cast<double>(load<T>(bytes, std::endian::little));
}
constexpr Component kComponents[] = {
    {5120, 1, loaded<std::int8_t>, 127},          {5121, 1, loaded<std::uint8_t>, 255},
    {5122, 2, loaded<std::int16_t>, 32767},       {5123, 2, loaded<std::uint16_t>, 65535},
    {5125, 4, loaded<std::uint32_t>, 4294967295}, {5126, 4, loaded<float>, 1}};

/// Decodes the percent escapes of a URI.
std::string unescaped_uri(const std::string& uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const char* const digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      result += static_cast<char>(static_cast<unsigned char>(code));
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

}  // namespace

GltfFile::GltfFile(const Source& source) : source_(source), json_end_(source.bytes.size()) {
  if (source.bytes.empty()) throw FileError(source.path, "", "the file is empty");
  if (source.bytes.starts_with(kMagic)) read_chunks();
  root_ = read_json(source_, json_begin_, json_end_);
  if (!root_.is_object()) fail(root_, "not a glTF file: it is no JSON object");
  const Json* const asset = member(root_, "asset");
  const Json* const version = asset == nullptr ? nullptr : member(*asset, "version");
  if (version == nullptr) fail(root_, "not a glTF file: it has no asset with a version");
  if (!shown(*version).starts_with("2."))
    fail(*version, "glTF of version " + in_quotes(shown(*version)) + " is not read; save it as 2.0");
}

/// Reads the binary form: a header, JSON, and a buffer.
void GltfFile::read_chunks() {
  ByteReader bytes(source_, std::endian::little, kMagic.size());
  const auto version = bytes.read<std::uint32_t>();
  if (version != 2)
    bytes.fail("binary glTF of version " + std::to_string(version) + " is not read; save it as 2.0");
  const std::size_t length = bytes.read<std::uint32_t>();
  if (length > source_.bytes.size())
    bytes.fail("the file is " + std::to_string(source_.bytes.size()) + " bytes long and should have " +
               std::to_string(length) + "; it is truncated");
  behind_ = source_.bytes.size() - std::max(length, bytes.position());
  bool has_json = false;
  while (bytes.position() + 8 <= length) {
    const std::size_t size = bytes.read<std::uint32_t>();
    const auto type = bytes.read<std::uint32_t>();
    const std::size_t begin = bytes.position();
    const std::string_view chunk = bytes.take(size);
    if (!has_json) {
      if (type != kJsonChunk) bytes.fail("the first chunk is not JSON");
      has_json = true;
      json_begin_ = begin;
      json_end_ = begin + size;
    } else if (type == kBinaryChunk && !chunk_) {
      chunk_ = chunk;
    }
  }
  if (!has_json) bytes.fail("the file has no JSON; it is truncated");
}

std::span<const Json> GltfFile::list(const Json& object, std::string_view key) const {
  const Json* const found = member(object, key);
  if (found == nullptr) return {};
  if (!found->is_array()) fail(*found, "expected an array");
  return found->get_ref<const Json::array_t&>();
}

std::optional<std::size_t> GltfFile::number(const Json& object, std::string_view key) const {
  const Json* const found = member(object, key);
  if (found == nullptr) return std::nullopt;
  const std::uint64_t value = found->is_number_unsigned() ? found->get<std::uint64_t>() : kNone;
  // In a browser, sizes have 32 bits.
  if (value > std::numeric_limits<std::uint32_t>::max() * std::uint64_t{1024} ||
      !std::in_range<std::size_t>(value))
    fail(*found, in_quotes(key) + " is no count or index: " + in_quotes(shown(*found)));
  return static_cast<std::size_t>(value);
}

std::optional<std::size_t> GltfFile::entry(const Json& object, std::string_view key,
                                           std::string_view array) const {
  const Json* const found = member(object, key);
  if (found == nullptr) return std::nullopt;
  return entry_of(*found, array);
}

std::size_t GltfFile::entry_of(const Json& value, std::string_view array) const {
  const std::size_t size = list(root_, array).size();
  const std::uint64_t index = value.is_number_unsigned() ? value.get<std::uint64_t>() : kNone;
  if (index >= size)
    fail(value, in_quotes(shown(value)) + " is not the number of any of the " + std::to_string(size) + " " +
                    std::string(array));
  return static_cast<std::size_t>(index);
}

std::optional<std::vector<double>> GltfFile::reals(const Json& object, std::string_view key,
                                                   std::size_t count) const {
  const Json* const found = member(object, key);
  if (found == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const Json& item : list(object, key)) {
    if (!item.is_number()) fail(item, "expected a number");
    values.push_back(item.get<double>());
  }
  if (values.size() != count)
    fail(*found,
         in_quotes(key) + " has " + std::to_string(values.size()) + " numbers, not " + std::to_string(count));
  return values;
}

std::string GltfFile::name(const Json& object) {
  const Json* const found = member(object, "name");
  return found != nullptr && found->is_string() ? found->get<std::string>() : "";
}

bool GltfFile::has_values(std::size_t accessor) const {
  const Json& object = list(root_, "accessors")[accessor];
  return member(object, "bufferView") != nullptr || member(object, "sparse") != nullptr;
}

std::vector<double> GltfFile::values(std::size_t index, std::size_t components) {
  const Json& accessor = list(root_, "accessors")[index];
  const Json* const type = member(accessor, "type");
  const std::string_view wanted = components == 3 ? "VEC3" : "SCALAR";
  if (type == nullptr || *type != wanted)
    fail(accessor, "expected an accessor of the type " + in_quotes(wanted));
  const std::uint64_t code = number(accessor, "componentType").value_or(0);
  const auto component = std::find_if(std::begin(kComponents), std::end(kComponents),
                                      [&](const Component& c) { return c.code == code; });
  if (component == std::end(kComponents))
    fail(accessor, "numbers of the component type " + std::to_string(code) + " are not read");
  const std::size_t count = number(accessor, "count").value_or(0);
  std::vector<double> values;
  if (member(accessor, "bufferView") != nullptr) {
    const std::size_t bytes = components * component->bytes;
    const View from = view(accessor, count, bytes);
    values.reserve(components * count);
    for (std::size_t i = 0; i < count; ++i) {
      beat(source_.watch);
      for (std::size_t k = 0; k < components; ++k)
        values.push_back(component->load(from.bytes.data() + i * from.stride + k * component->bytes));
    }
  } else if (!has_values(index) || count > source_.bytes.size()) {
    // By the format these are zeros, but a few bytes could request any number of them.
    fail(accessor, "the accessor has no values");
  } else {
    values.resize(components * count);
  }
  if (const Json* const sparse = member(accessor, "sparse"))
    read_sparse(accessor, *sparse, count, components, values);
  const Json* const normalized = member(accessor, "normalized");
  if (normalized != nullptr && *normalized == true && component->code != 5126)
    for (double& value : values) value = std::max(value / component->largest, -1.0);
  return values;
}

/// Reads values that replace some of the others.
void GltfFile::read_sparse(const Json& accessor, const Json& sparse, std::size_t count,
                           std::size_t components, std::vector<double>& values) {
  const Json* const places = member(sparse, "indices");
  const Json* const others = member(sparse, "values");
  if (places == nullptr || others == nullptr) fail(sparse, "expected indices and values");
  const auto component_of = [&](const Json& object) {
    const std::uint64_t code = number(object, "componentType").value_or(0);
    const auto found = std::find_if(std::begin(kComponents), std::end(kComponents),
                                    [&](const Component& c) { return c.code == code; });
    if (found == std::end(kComponents)) fail(object, "a component type that is not read");
    return *found;
  };
  const Component place = component_of(*places), component = component_of(accessor);
  const std::size_t size = number(sparse, "count").value_or(0);
  const View from = view(*places, size, place.bytes), to = view(*others, size, components * component.bytes);
  for (std::size_t i = 0; i < size; ++i) {
    const double at = place.load(from.bytes.data() + i * from.stride);
    if (!(at >= 0 && at < static_cast<double>(count))) fail(*places, "an index that is out of range");
    for (std::size_t k = 0; k < components; ++k)
      values[static_cast<std::size_t>(at) * components + k] =
          component.load(to.bytes.data() + i * to.stride + k * component.bytes);
  }
}

/// `count` elements of `bytes` bytes each, in the buffer view that `user` names.
GltfFile::View GltfFile::view(const Json& user, std::size_t count, std::size_t bytes) {
  const std::optional<std::size_t> index = entry(user, "bufferView", "bufferViews");
  if (!index) fail(user, "expected a bufferView");
  const Json& object = list(root_, "bufferViews")[*index];
  const std::optional<std::size_t> of = entry(object, "buffer", "buffers");
  if (!of) fail(object, "the view names no buffer");
  const std::string_view all = buffer(*of);
  const std::size_t offset = number(object, "byteOffset").value_or(0);
  const std::size_t length = number(object, "byteLength").value_or(0);
  if (offset > all.size() || length > all.size() - offset)
    fail(object, "the view ends at byte " + std::to_string(offset + length) + " of buffer " +
                     std::to_string(*of) + ", which has " + std::to_string(all.size()));
  View view{all.substr(offset, length), number(object, "byteStride").value_or(bytes)};
  const std::size_t first = number(user, "byteOffset").value_or(0);
  if (view.stride < bytes) fail(object, "elements that lie in each other");
  if (count > 0 &&
      (first > length || bytes > length - first || (count - 1) > (length - first - bytes) / view.stride))
    fail(user, std::to_string(count) + " elements of " + std::to_string(bytes) +
                   " bytes do not fit into the " + std::to_string(length) + " bytes of their view");
  view.bytes.remove_prefix(std::min(first, length));
  return view;
}

std::string_view GltfFile::buffer(std::size_t b) {
  const Json& object = list(root_, "buffers")[b];
  const Json* const uri = member(object, "uri");
  if (uri == nullptr) {
    if (b != 0 || !chunk_)
      fail(object, "the buffer is not in the file (it may be compressed: save the file without compression)");
    return *chunk_;
  }
  if (!uri->is_string()) fail(*uri, "expected a string");
  if (!uri->get_ref<const std::string&>().starts_with(kInText)) return external(*uri);
  const auto [found, is_new] = decoded_.try_emplace(b);
  if (is_new) found->second = decoded(*uri);
  return found->second;
}

std::string_view GltfFile::external(const Json& uri) {
  const auto named = path_of(uri.get_ref<const std::string&>());
  if (!named) fail(uri, "the buffer " + in_quotes(shown(uri)) + " is no file beside this one");
  const std::filesystem::path& path = *named;
  const auto known = external_.find(path);
  if (known != external_.end()) return known->second->view();
  return external_.emplace(path, std::make_unique<FileBytes>(path, source_.watch)).first->second->view();
}

/// The file that a URI names; nullopt if it is not beside this one.
std::optional<std::filesystem::path> GltfFile::path_of(const std::string& uri) const {
  const std::filesystem::path relative(unescaped_uri(uri));
  if (relative.empty() || uri.starts_with(kInText) || relative.is_absolute() ||
      relative.string().find("://") != std::string::npos)
    return std::nullopt;
  return source_.path.parent_path() / relative;
}

std::vector<std::filesystem::path> GltfFile::files_beside() const {
  std::vector<std::filesystem::path> files;
  for (const Json& buffer : list(root_, "buffers")) {
    const Json* const uri = member(buffer, "uri");
    if (uri == nullptr || !uri->is_string()) continue;
    if (const auto path = path_of(uri->get_ref<const std::string&>())) files.push_back(*path);
  }
  return files;
}

std::size_t GltfFile::bytes() const {
  std::size_t all = source_.bytes.size();
  for (const auto& [path, bytes] : external_) all += bytes->view().size();
  return all;
}

std::string GltfFile::decoded(const Json& uri) const {
  constexpr std::string_view kMark = ";base64,";
  const std::string_view text = uri.get_ref<const std::string&>();
  const std::size_t mark = text.find(kMark);
  if (mark == std::string_view::npos) fail(uri, "a buffer in the text that is not base64");
  std::optional<std::string> bytes = decoded_base64(text.substr(mark + kMark.size()), source_.watch);
  if (!bytes) fail(uri, "a character that is not base64");
  return *std::move(bytes);
}

}  // namespace holdfast::io
