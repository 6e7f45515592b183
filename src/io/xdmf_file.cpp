#include "io/xdmf_file.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "io/text_reader.h"

namespace holdfast::io {
namespace {

std::string type_attribute(const XdmfItem& item) {
  const std::string type = item.tag.attribute("NumberType");
  return type.empty() ? item.tag.attribute("DataType") : type;
}

std::string_view name_in(const XdmfItem& item) {
  constexpr const char* kBlank = " \t\r\n";
  const std::size_t begin = item.text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return item.text.substr(begin, item.text.find_last_not_of(kBlank) + 1 - begin);
}

}  // namespace

XdmfFile::XdmfFile(const Source& source) : source_(source), xml_(source) { read_grids(); }

// The text after a tag; entities are not decoded, because numbers and names of arrays have none.
std::string_view XdmfFile::text_behind() const {
  const std::size_t begin = xml_.position();
  return source_.bytes.substr(begin, std::min(source_.bytes.find('<', begin), source_.bytes.size()) - begin);
}

void XdmfFile::read_grids() {
  bool is_xdmf = false, ended = false, in_time = false;
  std::vector<XdmfItem>* items = nullptr;
  while (const std::optional<XmlTag> tag = xml_.next()) {
    beat(source_.watch);
    if (tag->name == "Xdmf") {
      is_xdmf = true;
      ended = tag->closing;
    } else if (tag->name == "Grid" && !tag->closing) {
      const std::string kind = lower(tag->attribute("GridType"));
      if (kind == "collection" || kind == "tree") {
        in_time = in_time || lower(tag->attribute("CollectionType")) == "temporal";
        continue;
      }
      grids_.push_back({*tag, {}, {}, {}, {}, {}, false});
    } else if (grids_.empty()) {
      continue;
    } else if (tag->name == "Topology" && !tag->closing) {
      grids_.back().topology = *tag;
      items = &grids_.back().cells;
    } else if (tag->name == "Geometry" && !tag->closing) {
      grids_.back().geometry = *tag;
      items = &grids_.back().points;
    } else if (tag->name == "Attribute" && !tag->closing) {
      grids_.back().attributes.push_back({*tag, {}});
      items = &grids_.back().attributes.back().items;
    } else if (tag->name == "Topology" || tag->name == "Geometry" || tag->name == "Attribute") {
      items = nullptr;
    } else if (tag->name == "DataItem" && !tag->closing && items != nullptr) {
      items->push_back({*tag, text_behind()});
    } else if (tag->name == "include" || tag->name == "xi:include") {
      if (tag->attribute("xpointer").find("Topology") != std::string::npos)
        grids_.back().takes_topology = true;
    } else if (tag->name == "map" && !tag->closing) {
      read_name(*tag);
    }
  }
  if (!is_xdmf) throw FileError(source_.path, "", "not an XDMF file: it has no Xdmf element");
  if (!ended) throw FileError(source_.path, "", "the file does not end with </Xdmf>; it is truncated");
  std::erase_if(grids_, [](const XdmfGrid& grid) { return !grid.topology && !grid.takes_topology; });
  if (in_time && grids_.size() > 1) {
    left_out_ = grids_.size() - 1;
    grids_.resize(1);
  }
}

/// Reads the name of an id in meshio's form: <map key="inlet" dim="2">3</map>.
void XdmfFile::read_name(const XmlTag& tag) {
  const std::string key = tag.attribute("key");
  if (key == kSurfaceBeside) {
    surface_is_beside_ = true;
    return;
  }
  std::array<std::int64_t, 2> pair{};
  const auto integer = [](std::string_view text, std::int64_t& value) {
    return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
  };
  if (integer(text_behind(), pair[0]) && integer(tag.attribute("dim"), pair[1])) names_.add(key, pair);
}

/// The file of an HDF5 item, which stays open, and the array in it.
std::pair<const Hdf5File*, Hdf5File::Object> XdmfFile::array_of(const XdmfItem& item) const {
  const std::string_view text = name_in(item);
  if (text.empty()) xml_.fail(item.tag, "the item names no array");
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0) xml_.fail(item.tag, "FILE.h5:/ARRAY is expected");
  const std::string name = unescaped(text.substr(0, colon));
  auto found = heavy_.find(name);
  if (found == heavy_.end()) {
    const std::filesystem::path path = source_.path.parent_path() / name;
    auto heavy = std::make_unique<Heavy>(path, source_.watch);
    found = heavy_.emplace(name, std::move(heavy)).first;
  }
  const Hdf5File& file = found->second->file;
  const std::optional<Hdf5File::Object> array = file.find(file.root(), text.substr(colon + 1));
  if (!array) xml_.fail(item.tag, "there is no array " + in_quotes(text.substr(colon + 1)) + " in " + name);
  return {&file, *array};
}

// The file that an item's text names, relative to this one.
std::filesystem::path XdmfFile::path_of(const XdmfItem& item) const {
  const std::string_view name = name_in(item);
  if (name.empty()) xml_.fail(item.tag, "the item names no file");
  return source_.path.parent_path() / unescaped(name);
}

/// Values of a raw file, from the byte Seek on.
template <typename T>
std::vector<T> XdmfFile::raw_values_of(const XdmfItem& item, std::uint64_t count) const {
  const std::string packed = lower(item.tag.attribute("Compression"));
  if (!packed.empty() && packed != "raw")
    xml_.fail(item.tag, "values packed by " + in_quotes(packed) + " are not read");
  const VtkType type = raw_type_of(item);
  const std::endian order = lower(item.tag.attribute("Endian")) == "big"      ? std::endian::big
                            : lower(item.tag.attribute("Endian")) == "little" ? std::endian::little
                                                                              : std::endian::native;
  const std::uint64_t begin = item.tag.attribute("Seek").empty() ? 0 : xml_.number(item.tag, "Seek");
  const std::filesystem::path path = path_of(item);
  const FileBytes file(path, source_.watch);
  const std::string_view bytes = file.view();
  if (begin > bytes.size() || count > (bytes.size() - begin) / size_of(type))
    throw FileError(path, "",
                    "has " + std::to_string(bytes.size()) + " bytes, too few for " + std::to_string(count) +
                        " values of " + std::to_string(size_of(type)) + " bytes from byte " +
                        std::to_string(begin) + " on");
  const auto from = static_cast<std::size_t>(begin), length = static_cast<std::size_t>(count) * size_of(type);
  return binary_values<T>(type, bytes.substr(from, length), order, source_.watch,
                          [&](const std::string& reason) { xml_.fail(item.tag, reason); });
}

/// The type of a value from NumberType (also DataType in XDMF 2) and Precision.
VtkType XdmfFile::raw_type_of(const XdmfItem& item) const {
  struct Known {
    std::string_view name, precision;
    VtkType type;
  };
  static constexpr Known kKnown[] = {
      {"float", "4", VtkType::float32}, {"float", "8", VtkType::float64}, {"int", "1", VtkType::int8},
      {"int", "2", VtkType::int16},     {"int", "4", VtkType::int32},     {"int", "8", VtkType::int64},
      {"uint", "1", VtkType::uint8},    {"uint", "2", VtkType::uint16},   {"uint", "4", VtkType::uint32},
      {"uint", "8", VtkType::uint64},   {"short", "2", VtkType::int16},   {"ushort", "2", VtkType::uint16},
      {"char", "1", VtkType::int8},     {"uchar", "1", VtkType::uint8}};
  std::string name = lower(type_attribute(item)), precision = item.tag.attribute("Precision");
  if (name.empty()) name = "float";
  if (precision.empty()) precision = name.ends_with("char") ? "1" : name.ends_with("short") ? "2" : "4";
  for (const Known& known : kKnown)
    if (known.name == name && known.precision == precision) return known.type;
  xml_.fail(item.tag, "values of the type " + in_quotes(name) + " of " + precision + " bytes are not read");
}

std::uint64_t XdmfFile::dimensions_of(const XdmfItem& item) const {
  std::uint64_t count = 1;
  const std::string text = item.tag.attribute("Dimensions");
  std::size_t numbers = 0;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    if (*at == ' ') {
      ++at;
      continue;
    }
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (value != 0 && count > std::uint64_t{1} << 40) ||
        value > std::uint64_t{1} << 40 || (value != 0 && count > (std::uint64_t{1} << 62) / value))
      xml_.fail(item.tag, "the attribute Dimensions is no list of counts: " + in_quotes(text));
    count *= value;
    ++numbers;
    at = stop;
  }
  if (numbers == 0) xml_.fail(item.tag, "the item has no Dimensions");
  return count;
}

template <typename T>
std::vector<T> XdmfFile::values_of(const std::vector<XdmfItem>& items, const XmlTag& of) const {
  const auto real = std::find_if(items.begin(), items.end(), [](const XdmfItem& item) {
    const std::string kind = lower(item.tag.attribute("ItemType"));
    return kind.empty() || kind == "uniform";
  });
  if (real == items.end()) xml_.fail(of, "there are no values in it that can be read");
  const std::uint64_t count = dimensions_of(*real);
  const std::string format = lower(real->tag.attribute("Format"));
  std::vector<T> values;
  if (format == "hdf" || format == "hdf5") {
    const auto [file, array] = array_of(*real);
    if constexpr (std::is_same_v<T, double>)
      values = file->reals(array);
    else
      values = file->integers(array);
  } else if (format == "xml" || format.empty()) {
    TextReader text({source_.path,
                     source_.bytes.substr(0, static_cast<std::size_t>(real->text.data() + real->text.size() -
                                                                      source_.bytes.data())),
                     source_.finite, source_.watch},
                    '\0');
    text.seek(static_cast<std::size_t>(real->text.data() - source_.bytes.data()));
    while (!text.at_end()) {
      if constexpr (std::is_same_v<T, double>)
        values.push_back(text.real("a number"));
      else
        values.push_back(text.integer("an integer"));
    }
  } else if (format == "binary") {
    values = raw_values_of<T>(*real, count);
  } else {
    xml_.fail(real->tag,
              "values of the format " + in_quotes(format) + " are not read; HDF, XML and Binary are");
  }
  if (values.size() != count)
    xml_.fail(real->tag, "there are " + std::to_string(values.size()) + " values, but Dimensions say " +
                             std::to_string(count));
  return values;
}

bool XdmfFile::holds_integers(const XdmfItem& item) const {
  std::string type = type_attribute(item);
  if (type.empty() && lower(item.tag.attribute("Format")) == "hdf") {
    const auto [file, array] = array_of(item);
    return file->holds_integers(array);
  }
  type = lower(type);
  return type.find("int") != std::string::npos || type == "char" || type == "uchar";
}

template std::vector<double> XdmfFile::values_of(const std::vector<XdmfItem>&, const XmlTag&) const;
template std::vector<std::int64_t> XdmfFile::values_of(const std::vector<XdmfItem>&, const XmlTag&) const;

}  // namespace holdfast::io
