#include "io/xdmf_file.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "io/text_reader.h"

namespace holdfast::io {

XdmfFile::XdmfFile(const Source& source) : source_(source), xml_(source) { read_grids(); }

// The text behind a tag; entities are left as they are, which numbers and names of arrays do not have.
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

/// A name of an id, as meshio has them: <map key="inlet" dim="2">3</map>.
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
  std::string_view text = item.text;
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) xml_.fail(item.tag, "the item names no array");
  text = text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
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
  } else {
    xml_.fail(real->tag, "values of the format " + in_quotes(format) + " are not read; HDF and XML are");
  }
  if (values.size() != count)
    xml_.fail(real->tag, "there are " + std::to_string(values.size()) + " values, but Dimensions say " +
                             std::to_string(count));
  return values;
}

bool XdmfFile::holds_integers(const XdmfItem& item) const {
  std::string type = item.tag.attribute("NumberType");
  if (type.empty()) type = item.tag.attribute("DataType");
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
