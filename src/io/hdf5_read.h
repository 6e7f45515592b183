// The part of HDF5 that meshes need, read from bytes in memory: groups, attributes, and arrays of numbers and
// texts. Nothing in a file is trusted: every address, size and depth is checked against the length of the
// file.
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

/// Whether bytes begin with HDF5's signature.
[[nodiscard]] bool is_hdf5(std::string_view bytes);

/// The type of values and their layout in the file.
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

/// An HDF5 file. An object is named by the address of its header. All functions throw FileError with the byte
/// if the file is damaged or uses a feature that is not supported.
class Hdf5File {
 public:
  using Object = std::uint64_t;

  explicit Hdf5File(const Source& source);

  [[nodiscard]] Object root() const { return root_; }
  /// The members of a group by name; empty for an array.
  [[nodiscard]] std::map<std::string, Object> links(Object group) const;
  /// The object at a path such as "/Mesh/points", relative to a group.
  [[nodiscard]] std::optional<Object> find(Object from, std::string_view path) const;

  /// The extent of an array in each direction, slowest first.
  [[nodiscard]] std::vector<std::uint64_t> shape(Object array) const;
  [[nodiscard]] bool holds_integers(Object array) const;
  /// The values of an array of numbers, of any type. Integers beyond 64 bits, and non-integers where integers
  /// are asked for, are refused.
  [[nodiscard]] std::vector<double> reals(Object array) const;
  [[nodiscard]] std::vector<std::int64_t> integers(Object array) const;
  /// Texts of fixed length, or arrays of bytes, without trailing zeros and blanks.
  [[nodiscard]] std::vector<std::string> texts(Object array) const;

  /// The first value of an attribute, if there is one with this name and kind.
  [[nodiscard]] std::optional<std::int64_t> integer_attribute(Object object, std::string_view name) const;
  [[nodiscard]] std::optional<std::string> text_attribute(Object object, std::string_view name) const;

  [[noreturn]] void fail(std::uint64_t at, const std::string& reason) const;
  [[nodiscard]] const Source& source() const { return source_; }

 private:
  struct Filter {
    std::uint16_t id;
    std::uint32_t parameter;
  };
  /// The type, shape and bytes of an array or attribute.
  struct Values {
    Hdf5Datatype type;
    std::vector<std::uint64_t> shape;
    std::uint64_t count = 1;
    std::string owned;       ///< decompressed bytes
    std::string_view bytes;  ///< `owned`, or bytes of the file
  };
  struct Chunks;

  template <typename T>
  [[nodiscard]] T number(std::uint64_t at) const;
  /// A number of 1 to 8 bytes.
  [[nodiscard]] std::uint64_t number(std::uint64_t at, std::size_t size) const;
  [[nodiscard]] std::string_view bytes(std::uint64_t at, std::uint64_t size) const;
  /// Counts the entries of a tree as they are read: more than the file has room for form a cycle.
  void count_block(std::size_t& blocks, std::uint64_t at) const;
  void require_signature(std::uint64_t at, std::string_view signature) const;

  void read_superblock();
  [[nodiscard]] std::vector<Hdf5Message> messages(Object object) const;
  void read_messages_1(Object object, std::vector<Hdf5Message>& found) const;
  void read_messages_2(Object object, std::vector<Hdf5Message>& found) const;

  void links_of_table(std::uint64_t tree, std::uint64_t heap, std::map<std::string, Object>& found) const;
  void link_of_message(std::uint64_t at, std::uint64_t size, std::map<std::string, Object>& found) const;
  /// Calls `visit` with the position and size of every object in a heap that a tree lists; the tree's records
  /// have the object's id after `id_in_record` bytes.
  void each_in_heap(std::uint64_t heap, std::uint64_t tree, std::size_t id_in_record,
                    const std::function<void(std::uint64_t, std::uint64_t)>& visit) const;

  [[nodiscard]] Hdf5Datatype datatype(std::uint64_t at, std::uint64_t size, std::uint64_t& inner) const;
  [[nodiscard]] std::vector<std::uint64_t> dataspace(std::uint64_t at, std::uint64_t size) const;
  [[nodiscard]] std::vector<Filter> filters(std::uint64_t at, std::uint64_t size) const;
  void set_type(Values& values, const Hdf5Message& message) const;
  void set_shape(Values& values, std::vector<std::uint64_t> shape) const;
  /// The type, shape and all values of an array.
  [[nodiscard]] Values described(Object array) const;
  [[nodiscard]] Values values(Object array) const;
  [[nodiscard]] std::optional<Values> attribute(Object object, std::string_view name) const;
  /// The values of an attribute's message, if the attribute has this name.
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
