// As much of HDF5 as meshes need, read from bytes in memory: groups, attributes, and arrays of numbers and
// texts. Nothing in a file is trusted: every address, size and depth is checked against the bytes there are.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Whether bytes begin as those of HDF5 do.
[[nodiscard]] bool is_hdf5(std::string_view bytes);

/// What values are, and how they lie in the file.
struct Hdf5Datatype {
  enum class Kind { integer, real, text };
  Kind kind = Kind::integer;
  std::size_t size = 0;  ///< bytes of a value
  bool big_endian = false, is_signed = true;
};

/// Messages of an object's header, by their type (HDF5 file format specification, IV.A.2).
struct Hdf5Message {
  std::uint16_t type;
  std::size_t at;  ///< offset of its data in the file
  std::size_t size;
};

/// A file. An object is named by the address of its header. All functions throw FileError with the byte where
/// the file is damaged, or holds what is not read.
class Hdf5File {
 public:
  using Object = std::uint64_t;

  explicit Hdf5File(const Source& source);

  [[nodiscard]] Object root() const { return root_; }
  /// What a group holds by name; empty for an array.
  [[nodiscard]] std::map<std::string, Object> links(Object group) const;
  /// What a path such as "/Mesh/points" leads to, from a group.
  [[nodiscard]] std::optional<Object> find(Object from, std::string_view path) const;

  /// How many values an array has in each direction, slowest first.
  [[nodiscard]] std::vector<std::uint64_t> shape(Object array) const;
  [[nodiscard]] bool holds_integers(Object array) const;
  /// The values of an array of numbers, of any type. Integers beyond 64 bits, and reals that are none in an
  /// array of integers, are refused.
  [[nodiscard]] std::vector<double> reals(Object array) const;
  [[nodiscard]] std::vector<std::int64_t> integers(Object array) const;
  /// Texts: of fixed length, or arrays of bytes; without zeros and blanks at their ends.
  [[nodiscard]] std::vector<std::string> texts(Object array) const;

  /// The first value of an attribute, if there is one of this name and kind.
  [[nodiscard]] std::optional<std::int64_t> integer_attribute(Object object, std::string_view name) const;
  [[nodiscard]] std::optional<std::string> text_attribute(Object object, std::string_view name) const;

  [[noreturn]] void fail(std::uint64_t at, const std::string& reason) const;
  [[nodiscard]] const Source& source() const { return source_; }

 private:
  struct Filter {
    std::uint16_t id;
    std::uint32_t parameter;
  };
  /// Of an array or attribute: its values' type, shape and bytes.
  struct Values {
    Hdf5Datatype type;
    std::vector<std::uint64_t> shape;
    std::uint64_t count = 1;
    std::string owned;       ///< unpacked bytes
    std::string_view bytes;  ///< those, or bytes of the file
  };
  struct Chunks;

  template <typename T>
  [[nodiscard]] T number(std::uint64_t at) const;
  /// A number of 1 to 8 bytes.
  [[nodiscard]] std::uint64_t number(std::uint64_t at, std::size_t size) const;
  [[nodiscard]] std::string_view bytes(std::uint64_t at, std::uint64_t size) const;
  /// Counts the entries of a tree that are read: more than the file can hold run in circles.
  void count_block(std::size_t& blocks, std::uint64_t at) const;
  void require_signature(std::uint64_t at, std::string_view signature) const;

  void read_superblock();
  [[nodiscard]] std::vector<Hdf5Message> messages(Object object) const;
  void read_messages_1(Object object, std::vector<Hdf5Message>& found) const;
  void read_messages_2(Object object, std::vector<Hdf5Message>& found) const;

  void links_of_table(std::uint64_t tree, std::uint64_t heap, std::map<std::string, Object>& found) const;
  void link_of_message(std::uint64_t at, std::uint64_t size, std::map<std::string, Object>& found) const;
  /// Calls `visit` with place and size of every object that a tree lists in a heap; its records have the
  /// object's id behind `id_in_record` bytes.
  void each_in_heap(std::uint64_t heap, std::uint64_t tree, std::size_t id_in_record,
                    const std::function<void(std::uint64_t, std::uint64_t)>& visit) const;

  [[nodiscard]] Hdf5Datatype datatype(std::uint64_t at, std::uint64_t size, std::uint64_t& inner) const;
  [[nodiscard]] std::vector<std::uint64_t> dataspace(std::uint64_t at, std::uint64_t size) const;
  [[nodiscard]] std::vector<Filter> filters(std::uint64_t at, std::uint64_t size) const;
  void set_type(Values& values, const Hdf5Message& message) const;
  void set_shape(Values& values, std::vector<std::uint64_t> shape) const;
  /// Type and shape, and all of an array.
  [[nodiscard]] Values described(Object array) const;
  [[nodiscard]] Values values(Object array) const;
  [[nodiscard]] std::optional<Values> attribute(Object object, std::string_view name) const;
  /// An attribute's message, if it is of this name.
  [[nodiscard]] std::optional<Values> attribute_of_message(std::uint64_t at, std::uint64_t size,
                                                           std::string_view name) const;
  void read_layout(const Hdf5Message& layout, const std::vector<Filter>& filters, Values& values) const;
  void read_chunks(std::uint64_t tree, const Chunks& chunks, Values& values) const;
  [[nodiscard]] std::string unpacked_chunk(std::uint64_t at, std::uint64_t size, std::uint32_t mask,
                                           const Chunks& chunks) const;
  void put_chunk(const std::vector<std::uint64_t>& origin, const Chunks& chunks, const std::string& unpacked,
                 Values& values) const;

  [[nodiscard]] std::vector<std::int64_t> as_integers(const Values& values, Object at) const;
  [[nodiscard]] static std::vector<std::string> as_texts(const Values& values);

  Source source_;
  Object root_ = 0;
};

}  // namespace holdfast::io
